// pil_rig MISSION SCENARIO FRAMES OUT [cut=BYTES] [noise] [store=ADDRESS] [whole] [memory=ADDRESS] [starts=N] [code=BYTES] [head=ADDRESS]
// [quiet=S] [limit=S] [points=N] [progress]: flies a scenario on the host, then on the board behind OUT/camera.sock, OUT/ground.sock and
// OUT/rig.sock, and compares their telemetry bit by bit. Says `ready` when the board may be started: the mission's image is then in
// OUT/image.3dli. Leaves OUT/host.ccsds, OUT/target.ccsds, OUT/starts.csv and OUT/slots.csv (the board's reports, words by name). cut: the
// camera's line ends after so many bytes. noise: the ground's begins with some. store: three starts try the store (store_story.hpp), the
// first image buffer being at ADDRESS. whole: what they load is as large as what flies. memory: where the board's begins, 0. starts: so
// many starts of the board are awaited, and the flight on the host left out. code: so much code the board watches, and the host beside it.
// head: the board has its head beside it, and shares memory with it at ADDRESS (docs/in-sensor.md), the host likewise; telemetry has
// to be that of a flight of the host with a camera at its line, too. quiet: seconds of the host for which nothing may move on the
// lines, 30. limit: seconds that all of it may take, 3600. points: rays of a scan, of which a mission's own may be too many for the board.
// progress: a line `frame` on standard error for each frame that is done, on the host and on the board, instead of a bar for people. Exit
// codes: 0 the same bits, 1 not, or the board failed, 2 usage or bad input.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <string>

#include "fsw/exec/component.hpp"
#include "ft/pil/boards.hpp"
#include "ft/pil/store_story.hpp"
#include "mdat/common/count.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/flight_image.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/progress_bar.hpp"
#include "mdat/link/decode.hpp"
#include "mdat/link/number.hpp"
#include "mdat/run/simulation.hpp"
#include "ut/support/box_image.hpp"

namespace lasso::pil {
namespace {

constexpr double kStoryPoints = 256, kOtherPoints = 250;
constexpr std::size_t kMissionIdAt = 19;  // the low byte of the header's mission id
constexpr std::uint8_t kOtherMission = 99;
constexpr const char* kWordNames =
    "magic,kind,time_high,time_low,camera_sent,ground_sent,slot,slot_ticks,estimate_ticks,late_ticks,idle_ticks,restarts,cause,vector,"
    "address,estimate_stack,acquire_stack,lost_bytes,memory,line_ticks,services_cut,lines_masked,packets_dropped,busy_late_ticks\n";

struct Options {
  std::string mission, scenario, out;
  std::uint32_t frames = 0, starts = 1;
  std::size_t code_bytes = 0;
  std::optional<std::uint64_t> cut;
  bool noise = false;
  std::uint32_t store = 0;            // where the first image buffer is; 0: it is not tried
  bool whole = false;                 // the image that is loaded is a mission's own
  std::uint32_t memory = 0;           // where the board's memory begins
  std::optional<std::uint32_t> head;  // address of the memory that the board shares with its head
  std::chrono::seconds quiet{30}, limit{3600};
  std::uint32_t points = 0;  // rays of a scan; 0: the mission's
  bool progress = false;
};

using mdat::count_of;
using Take = void (*)(const std::string& value, Options& options);
constexpr std::uint32_t kMostSeconds = 1'000'000;
std::chrono::seconds seconds_of(const std::string& name, const std::string& value) {
  return std::chrono::seconds(std::min(count_of<std::uint32_t>(name, value, 1), kMostSeconds));
}

void take(const std::string& word, Options& options) {
  static const std::map<std::string, Take> takes{
      {"cut", [](const std::string& value, Options& of) { of.cut = count_of<std::uint64_t>("cut", value); }},
      {"noise", [](const std::string&, Options& of) { of.noise = true; }},
      {"store", [](const std::string& value, Options& of) { of.store = count_of<std::uint32_t>("store", value); }},
      {"whole", [](const std::string&, Options& of) { of.whole = true; }},
      {"memory", [](const std::string& value, Options& of) { of.memory = count_of<std::uint32_t>("memory", value); }},
      {"starts", [](const std::string& value, Options& of) { of.starts = count_of<std::uint32_t>("starts", value, 1); }},
      {"code", [](const std::string& value, Options& of) { of.code_bytes = count_of<std::uint32_t>("code", value); }},
      {"head", [](const std::string& value, Options& of) { of.head = count_of<std::uint32_t>("head", value); }},
      {"quiet", [](const std::string& value, Options& of) { of.quiet = seconds_of("quiet", value); }},
      {"limit", [](const std::string& value, Options& of) { of.limit = seconds_of("limit", value); }},
      {"points", [](const std::string& value, Options& of) { of.points = count_of<std::uint32_t>("points", value, 1); }},
      {"progress", [](const std::string&, Options& of) { of.progress = true; }},
  };
  const std::size_t equals = word.find('=');
  const auto found = takes.find(word.substr(0, equals));
  if (found == takes.end()) throw mdat::InputError(word + ": no such option; without any words, the usage is told");
  found->second(equals == std::string::npos ? "" : word.substr(equals + 1), options);
}

Options parse(int argc, char** argv) {
  if (argc < 5)
    throw mdat::InputError(
        "usage: pil_rig MISSION SCENARIO FRAMES OUT [cut=BYTES] [noise] [store=ADDRESS] [whole] [memory=ADDRESS] [starts=N] [code=BYTES] "
        "[head=ADDRESS] [quiet=S] [limit=S] [points=N] [progress]");
  Options options;
  options.mission = argv[1];
  options.scenario = argv[2];
  options.frames = count_of<std::uint32_t>("FRAMES", argv[3]);
  options.out = argv[4];
  for (int i = 5; i < argc; ++i) take(argv[i], options);
  if (options.store != 0) options.starts = kStoryStarts;
  if (options.store != 0) options.frames = StoreStory::kLastFrames;
  return options;
}

std::string csv(const std::vector<Report>& reports) {
  std::string text = kWordNames;
  for (const Report& report : reports) {
    for (const std::uint32_t word : report.words) text += std::to_string(word) + ",";
    text.back() = '\n';
  }
  return text;
}

void write(const std::string& file, const Packet& bytes) {
  mdat::write_file(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

// What differs first, as a person can look for it; empty: nothing.
std::string difference(const Packet& host, const Packet& target) {
  const std::size_t both = std::min(host.size(), target.size());
  const auto at = static_cast<std::size_t>(
      std::mismatch(host.begin(), host.begin() + static_cast<std::ptrdiff_t>(both), target.begin()).first - host.begin());
  if (at == host.size() && at == target.size()) return {};
  const mdat::DecodedStream packets = mdat::decode_stream({host.data(), host.size()}, PacketType::kTelemetry);
  std::size_t number = 0;
  const char* name = "none";
  for (const mdat::DecodedPacket& packet : packets.packets) {
    if (packet.offset > at) break;
    name = packet.name();
    ++number;
  }
  return "byte " + std::to_string(at) + ", in packet " + std::to_string(number) + " of the host's (" + name + "); host " +
         std::to_string(host.size()) + " bytes, target " + std::to_string(target.size());
}

// Of a flight: for people, or for the program that has called.
class FlightProgress {
 public:
  FlightProgress(const std::string& label, std::uint32_t frames, bool lines) : bar_(label, frames, "frames"), lines_(lines) {}
  void show(std::uint32_t done) {
    if (!lines_) return bar_.show(done);
    for (; told_ < done; ++told_) (void)std::fputs("frame\n", stderr);
  }
  void finish() {
    if (!lines_) bar_.finish();
  }

 private:
  mdat::ProgressBar bar_;
  bool lines_;
  std::uint32_t told_ = 0;
};

void tell_ready() {
  std::puts("ready");
  (void)std::fflush(stdout);
}

// The last value of an item in all packets of a name; none.
std::optional<std::int64_t> last_of(const mdat::DecodedStream& stream, const std::string& packet, const std::string& item) {
  std::optional<std::int64_t> last;
  for (const mdat::DecodedPacket& one : stream.packets) {
    if (one.name() != packet) continue;
    for (const mdat::DecodedItem& decoded : one.items) {
      if (decoded.row->name == item) last = static_cast<std::int64_t>(mdat::value_of(decoded.values.at(0)));
    }
  }
  return last;
}

long long valid_poses(const mdat::DecodedStream& stream) {
  return static_cast<long long>(std::count_if(stream.packets.begin(), stream.packets.end(), [](const mdat::DecodedPacket& packet) {
    return packet.name() == std::string("pose") && last_of({{packet}, 0}, "pose", "valid").value_or(0) == 1;
  }));
}

// What telemetry says of a start: in its own words, for ft/pil/faults and ft/pil/run.py.
void tell(const Packet& telemetry) {
  const mdat::DecodedStream stream = mdat::decode_stream({telemetry.data(), telemetry.size()}, PacketType::kTelemetry);
  const auto count_of = [&](const std::string& name) {
    return static_cast<long long>(
        std::count_if(stream.packets.begin(), stream.packets.end(), [&](const auto& packet) { return packet.name() == name; }));
  };
  const auto last = [&](const char* packet, const char* item, std::int64_t none) {
    return static_cast<long long>(last_of(stream, packet, item).value_or(none));
  };
  std::printf(
      "telemetry: mode %lld, reset_cause %lld, %lld poses, %lld valid, last valid %lld, other bytes %zu, lost scans %lld, last loss %lld\n",
      last("pose", "mode", -1), last("health", "reset_cause", -1), count_of("pose"), valid_poses(stream), last("pose", "valid", -1),
      stream.other_bytes, last("sensor", "lost", 0), last("sensor", "last_loss", 0));
  std::printf("ground: %lld completed, %lld refused, %lld pongs, laser %lld, skipped bytes %lld\n", count_of("completed"),
              count_of("refused"), count_of("pong"), last("link", "laser_enabled", -1), last("link", "skipped_bytes", -1));
}

// Whether the board has said what `host`, a flight that `what` names, has; told to people.
int judge(const char* what, const Packet& host, const Packet& board) {
  const std::string wrong = difference(host, board);
  if (wrong.empty()) std::printf("same%s: %zu bytes of telemetry\n", what, host.size());
  if (!wrong.empty()) std::printf("differs%s: %s\n", what, wrong.c_str());
  return wrong.empty() ? mdat::kExitDone : mdat::kExitFailed;
}

int compare(const Options& options, const Packet& host, const TargetFlight& flight) {
  for (const Packet& telemetry : flight.telemetry) {
    tell(telemetry);
    if (options.store != 0) std::printf("%s\n", told_of_store(telemetry).c_str());
  }
  if (options.starts > 1) return mdat::kExitDone;
  return judge("", host, flight.telemetry.back());
}

// The image that the ground loads: of a box, small, and of another mission; or as the one that flies, with another parameter.
std::vector<std::uint8_t> image_to_load(const Options& options, const mdat::CompiledMission& mission, MissionParameters parameters) {
  if (options.whole) {
    parameters.points = kOtherPoints;
    return mdat::image_bytes(mission, parameters);
  }
  test::TestImage box = test::make_box_image(parameters, {{0, 0, 0}, {0.3, 0.2, 0.1}, 0.1, 0.2});
  box.data()[kMissionIdAt] = kOtherMission;
  test::repair_crcs(box);
  return {box.data(), box.data() + box.size};
}

// What the rig flies: fewer rays where the store is tried, which takes many frames, and images that are trusted at once.
WorldSetup setup_of(const Options& options, const mdat::CompiledMission& mission, const sim::RayCaster& target) {
  mdat::SimulationOptions simulation;
  simulation.scenario = options.scenario;
  WorldSetup setup{mdat::camera_case(mission, simulation, target), options.cut, options.noise};
  if (options.points != 0) setup.flight.parameters.points = options.points;
  if (options.store != 0) setup.flight.parameters.points = kStoryPoints;
  if (options.store != 0) setup.flight.parameters.image_trial_scans = 0;
  return setup;
}

std::optional<std::size_t> place_of_head(const Options& options) {
  if (!options.head) return std::nullopt;
  if (*options.head < options.memory) throw mdat::InputError("head: below the board's memory (memory=)");
  return *options.head - options.memory;
}

int run(const Options& options) {
  const Patience patience{options.quiet, std::chrono::steady_clock::now() + options.limit};
  const mdat::CompiledMission mission = mdat::compile_mission(options.mission);
  const auto target = mdat::make_target(mission.mesh);
  const WorldSetup setup = setup_of(options, mission, *target);
  const std::vector<std::uint8_t> image = mdat::image_bytes(mission, setup.flight.parameters);
  std::filesystem::create_directories(options.out);
  write(options.out + "/image.3dli", image);
  const std::uint32_t frames = options.frames + kPipelineFrames;
  std::optional<StoreStory> story;
  if (options.store != 0)
    story.emplace(image_to_load(options, mission, setup.flight.parameters), options.store, options.memory, options.out);
  const Ground ground = [&](std::uint32_t start, std::uint32_t slot, std::uint16_t& count) {
    return story ? story->commands(start, slot, count) : Packet{};
  };
  const auto fly_host = [&](Head head) {
    FlightProgress bar("fly on the host", frames, options.progress);
    const Packet said = fly_on_host(setup, {image, options.code_bytes}, head, frames, [&](std::uint32_t done) { bar.show(done); });
    bar.finish();
    return said;
  };
  const Packet host = options.starts == 1 ? fly_host(options.head ? Head::kBesideProcessor : Head::kAtLine) : Packet{};
  write(options.out + "/host.ccsds", host);
  FlightProgress bar("fly on the board", frames, options.progress);
  const TargetFlight flight = fly_on_target(
      setup, {options.out, frames, options.starts, patience, place_of_head(options)}, tell_ready,
      [&](std::uint32_t done) { bar.show(done); }, ground);
  bar.finish();
  if (story) std::printf("damaged word: %s\n", story->repaired() ? "repaired" : "as it was damaged");
  write(options.out + "/target.ccsds", flight.telemetry.back());
  mdat::write_file(options.out + "/starts.csv", csv(flight.starts));
  mdat::write_file(options.out + "/slots.csv", csv(flight.slots));
  const int same = compare(options, host, flight);
  if (!options.head) return same;
  return std::max(same, judge(", with a camera at a line", fly_host(Head::kAtLine), flight.telemetry.back()));
}

}  // namespace
}  // namespace lasso::pil

int main(int argc, char** argv) {
  try {
    return lasso::pil::run(lasso::pil::parse(argc, argv));
  } catch (const lasso::mdat::RunError& error) {
    std::fprintf(stderr, "pil: %s\n", error.what());
    return lasso::mdat::kExitFailed;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pil: %s\n", error.what());
    return lasso::mdat::kExitBadInput;
  }
}
