#include "ft/campaign/linked_flight.hpp"

#include <vector>

#include "fsw/exec/link_pump.hpp"
#include "ft/campaign/flight.hpp"
#include "mdat/common/flight_image.hpp"
#include "mdat/run/simulation.hpp"
#include "ut/support/places.hpp"

namespace lasso::campaign {
namespace {

constexpr double kPoints = 256;  // of a scan
constexpr double kRange_m = 4;
constexpr const char* kScenario = "spin";
constexpr std::uint64_t kSeed = 7;

const mdat::CompiledMission& hubble() {
  static const mdat::CompiledMission mission = mdat::compile_mission(test::source_folder() / "cfg/missions/hubble_tenth.toml");
  return mission;
}

const mdat::Scenario& scenario() { return mdat::scenario_of(hubble().source, kScenario); }

MissionParameters parameters() {
  MissionParameters parameters = mdat::parameters_for(hubble().source, kScenario);
  parameters.points = kPoints;
  return parameters;
}

std::unique_ptr<sim::Trajectory> trajectory() {
  return mdat::make_trajectory(scenario(), kRange_m, mdat::kEpochUs, mdat::period_us(parameters()));
}

}  // namespace

struct LinkedFlight::Parts {
  Parts(ByteLink& link, Authenticator* authenticator)
      : motion(trajectory()),
        target(mdat::make_target(hubble().mesh)),
        scanner(*target, *motion, mdat::scanner_model(scenario(), parameters(), true), kSeed),
        component(std::make_unique<Component>(scanner)),
        pump(*component, link) {
    if (authenticator != nullptr) component->use_authenticator(*authenticator);
    component->accept_unsigned_images();  // of this program, which made it
    const std::vector<std::uint8_t> bytes = mdat::image_bytes(hubble(), parameters());
    image = mdat::aligned_copy(bytes);
    begin(*component, mdat::view(image, bytes.size()));
  }

  std::unique_ptr<sim::Trajectory> motion;
  std::unique_ptr<sim::RayCaster> target;
  sim::SimulatedScanner scanner;
  std::vector<std::uint64_t> image;
  std::unique_ptr<Component> component;
  LinkPump pump;
};

LinkedFlight::LinkedFlight(ByteLink& link, Authenticator* authenticator) : parts_(std::make_unique<Parts>(link, authenticator)) {}
LinkedFlight::~LinkedFlight() = default;

Pose LinkedFlight::first_T_sensor_target() { return trajectory()->at(mdat::kEpochUs).T_sensor_target; }
TimeUs LinkedFlight::first_us() { return mdat::kEpochUs; }

void LinkedFlight::run_frame() {
  for (std::uint32_t slot = 0; slot < kSlotsPerFrame; ++slot) {
    parts_->pump.receive(parts_->component->next_slot_us());
    run_slot(*parts_->component);
    parts_->pump.send();
  }
}

}  // namespace lasso::campaign
