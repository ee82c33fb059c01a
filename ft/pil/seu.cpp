// pil_seu MISSION FOLDER PLACES FLIPS SEED [FIRST]: flies the board behind FOLDER's sockets once without a flip, then again and again from
// a state of that flight with one bit flipped. Says `start` when an emulator is to be started (the mission's image is then in
// FOLDER/image.3dli), `golden ...` when the flight without flips is done, and a `row` for each flip (ft/pil/seu.py). What is flipped, where
// and when depends on SEED and the flip's number alone. Exit codes: 0 all flips done, 1 the board failed without a flip, 2 usage.
#include <cstdio>
#include <exception>
#include <filesystem>

#include "bsp/bare/ram_store.hpp"
#include "ft/pil/seu_flight.hpp"
#include "mdat/common/count.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/flight_image.hpp"
#include "mdat/common/output.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::pil {
namespace {

constexpr const char* kScenario = "spin";
constexpr double kPoints = 256;  // of a scan, as in the host's campaign of the scrub

void say(const std::string& line) {
  std::puts(line.c_str());
  (void)std::fflush(stdout);
}

WorldSetup setup_of(const mdat::CompiledMission& mission, const sim::RayCaster& target) {
  mdat::SimulationOptions simulation;
  simulation.scenario = kScenario;
  WorldSetup setup{mdat::camera_case(mission, simulation, target), {}, false};
  setup.flight.parameters.points = kPoints;
  return setup;
}

std::string row_of(const Flip& flip, const Trial& trial) {
  char text[240];
  (void)std::snprintf(text, sizeof text, "row %u,%s,%u,%u,%s,%u,%08x,%s,%u,%u,%u,%u,%u", flip.trial,
                      kRegionNames[static_cast<std::size_t>(flip.region)], flip.frame, flip.slot, trial.where.c_str(), trial.bit,
                      trial.instruction, trial.outcome.c_str(), trial.told_after, trial.wrong, trial.invalid, trial.frames,
                      trial.first_wrong);
  return text;
}

// What is in use of the store: the parameters and the log, which change; the image's area, and the header of the other one.
void add_store(Places& places, std::size_t image_bytes) {
  const auto place = [&](std::size_t offset, std::size_t bytes) {
    return std::vector<Range>{{places.at("store").at(0).address + static_cast<std::uint32_t>(offset), static_cast<std::uint32_t>(bytes)}};
  };
  const std::size_t small = bare::RamStore::region_bytes(0) - 2 * kStoredHeaderBytes;
  places["log"] = place(0, small);
  places["stored_image"] = place(small, stored_area_bytes(StoreArea::kImage0, image_bytes));
  places["stored_header"] = place(small + stored_area_bytes(StoreArea::kImage0, bare::kMissionBytes), kStoredHeaderBytes);
}

void run(const std::string& mission_file, const std::string& folder, const Places& places, std::uint32_t flips, std::uint64_t seed,
         std::uint32_t first) {
  const mdat::CompiledMission mission = mdat::compile_mission(mission_file);
  const auto target = mdat::make_target(mission.mesh);
  const WorldSetup setup = setup_of(mission, *target);
  const std::vector<std::uint8_t> image = mdat::image_bytes(mission, setup.flight.parameters);
  mdat::write_file(folder + "/image.3dli", {reinterpret_cast<const char*>(image.data()), image.size()});
  Places with_image = places;
  with_image["image"] = {{places.at("image").at(0).address, static_cast<std::uint32_t>(image.size())}};
  add_store(with_image, image.size());
  SeuFlight flight(setup, folder, with_image, [] { say("start"); });
  flight.fly_golden();
  say("golden " + std::to_string(kGoldenFrames) + " frames, " + std::to_string(flight.unsteady_bytes()) +
      " bytes of memory that differ between flights");
  for (std::uint32_t trial = first; trial < first + flips; ++trial) {
    const Flip flip = draw_flip(seed, trial, with_image.at("code").at(0));
    say(row_of(flip, flight.fly(flip)));
  }
}

}  // namespace
}  // namespace lasso::pil

int main(int argc, char** argv) {
  if (argc < 6) {
    (void)std::fprintf(stderr, "usage: pil_seu MISSION FOLDER PLACES FLIPS SEED [FIRST]\n");
    return 2;
  }
  try {
    using lasso::mdat::count_of;
    lasso::pil::run(argv[1], argv[2], lasso::pil::read_places(argv[3]), count_of<std::uint32_t>("FLIPS", argv[4]),
                    count_of<std::uint64_t>("SEED", argv[5]), argc > 6 ? count_of<std::uint32_t>("FIRST", argv[6]) : 0);
  } catch (const lasso::mdat::InputError& error) {
    (void)std::fprintf(stderr, "pil_seu: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    (void)std::fprintf(stderr, "pil_seu: %s\n", error.what());
    return 1;
  }
  return 0;
}
