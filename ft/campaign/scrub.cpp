// scrub MISSION FILE FLIPS SEED [FIRST]: one flight with all that protects memory at work, repeated with one bit flipped in each
// repetition; writes a row for each into FILE (CSV). What is flipped, where and when depends on SEED and the trial's number alone: FLIPS =
// 1 and FIRST repeat one of them.
//
// The flight is flown once, and forks a child at each flip, which flips the bit, and flies on until the component reports it, or the
// longest time has passed in which it has to. Areas: both images, the views made of the active one, the changed parameters in their two
// copies, the mode in its three, and code.
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "fsw/core/voted.hpp"
#include "fsw/link/command_rows.hpp"
#include "fsw/link/events.hpp"
#include "ft/campaign/arena.hpp"
#include "ft/campaign/draws.hpp"
#include "ft/campaign/main_of.hpp"
#include "ft/campaign/verdict.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/flight_image.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::campaign {
namespace {

constexpr const char* kScenario = "spin";
constexpr double kRange_m = 4;
constexpr double kPoints = 256;           // of a scan
constexpr std::uint32_t kFirst = 6;       // frame in which the first flips happen, the track being settled
constexpr std::uint32_t kFlipFrames = 5;  // and the frames after it in which they do
constexpr std::uint32_t kLongest = 50;    // frames from a flip to its finding: the period of the requirement, 10 s
constexpr rlim_t kChildSeconds = 30;      // of processor time: a flight takes less than a second
constexpr std::size_t kCodeBytes = 200000;
constexpr double kChanged = 33;  // the value of a parameter that is changed in flight

enum class Area : std::uint8_t { kImage = 0, kOther = 1, kViews = 2, kParameters = 3, kMode = 4, kCode = 5 };
constexpr const char* kAreaNames[] = {"image", "other", "views", "parameters", "mode", "code"};
constexpr std::uint32_t kAreas = 6;

struct Flip {
  std::uint32_t trial = 0;
  Area area = Area::kImage;
  std::uint32_t frame = 0, slot = 0;
  std::size_t byte = 0;  // of the area
  std::uint8_t bit = 0;
  std::uint32_t slots() const { return frame * kSlotsPerFrame + slot; }
};

// What a child sends home.
struct Finding {
  std::uint32_t frames = 0;  // from the flip until it was reported; 0: it was not
  std::uint32_t wrong = 0;   // valid poses that are wrong, until then
  std::uint32_t poses = 0, invalid = 0;
};

// The store of a board, in the memory of the flight.
class ArenaStore final : public Store {
 public:
  ArenaStore(Arena& arena, std::size_t image_bytes) {
    for (std::size_t i = 0; i < kStoreAreas; ++i) {
      const std::size_t size = i < 2 ? image_bytes + kHeaderRoom : 65536;
      areas_[i] = Bytes(static_cast<std::uint8_t*>(arena.take(size)), size);
    }
  }
  std::size_t size(StoreArea area) const override { return areas_[static_cast<std::size_t>(area)].size(); }
  Status read(StoreArea area, std::size_t offset, Bytes out) override {
    if (offset > size(area) || out.size() > size(area) - offset) return Status::kBadIndex;
    std::memcpy(out.data(), areas_[static_cast<std::size_t>(area)].data() + offset, out.size());
    return Status::kOk;
  }
  Status write(StoreArea area, std::size_t offset, ConstBytes data) override {
    if (offset > size(area) || data.size() > size(area) - offset) return Status::kBadIndex;
    std::memcpy(areas_[static_cast<std::size_t>(area)].data() + offset, data.data(), data.size());
    return Status::kOk;
  }

 private:
  static constexpr std::size_t kHeaderRoom = 64;
  Bytes areas_[kStoreAreas];
};

Bytes writable(ConstBytes bytes) {
  return {const_cast<std::uint8_t*>(bytes.data()), bytes.size()};
}  // NOLINT(cppcoreguidelines-pro-type-const-cast): to be damaged

// The flight and its memory.
class Subject {
 public:
  explicit Subject(const char* mission_file)
      : mission_(mdat::compile_mission(mission_file)),
        scenario_(mdat::scenario_of(mission_.source, kScenario)),
        parameters_(with_points(mdat::parameters_for(mission_.source, kScenario))),
        trajectory_(mdat::make_trajectory(scenario_, kRange_m, mdat::kEpochUs, mdat::period_us(parameters_))),
        target_(mdat::make_target(mission_.mesh)),
        scanner_(*target_, *trajectory_, mdat::scanner_model(scenario_, parameters_, true), static_cast<std::uint64_t>(scenario_.seed)) {
    std::vector<std::uint8_t> bytes = mdat::image_bytes(mission_, parameters_);
    ArenaStore* store = new (arena_.take(sizeof(ArenaStore))) ArenaStore(arena_, bytes.size());
    BoardMemory memory;
    for (Bytes& buffer : memory.image_buffers) buffer = Bytes(static_cast<std::uint8_t*>(arena_.take(bytes.size())), bytes.size());
    const Bytes code(static_cast<std::uint8_t*>(arena_.take(kCodeBytes)), kCodeBytes);
    memory.code = code;
    memory.store = store;
    std::copy(bytes.begin(), bytes.end(), memory.image_buffers[0].begin());
    memory_ = Bytes(static_cast<std::uint8_t*>(arena_.take(required_memory())), required_memory());
    component_ = create(memory_.data(), memory_.size(), scanner_);
    if (component_ == nullptr || component_->use_memory(memory) != Status::kOk) throw mdat::RunError("the component refuses its memory");
    begin(*component_, memory.image_buffers[0]);
    load_other(bytes);
    start_tracking(*component_, trajectory_->at(component_->next_slot_us()).T_sensor_target);
    change_parameter();
  }

  // Once the track is settled, before the first area(): where the component keeps the copies.
  void locate_copies() {
    parameter_copies_ = parameter_copies();
    mode_copies_ = mode_copies();
  }

  Component& component() { return *component_; }
  const sim::Trajectory& truth() const { return *trajectory_; }

  Bytes area(Area area) const {
    const ImageKeeper& images = component_->images();
    if (area == Area::kImage) return writable(images.active().sealed_image());
    if (area == Area::kOther) return writable(images.other().sealed_image());
    if (area == Area::kViews) return writable(images.active().sealed_views());
    if (area == Area::kCode) return writable(images.code());
    return area == Area::kParameters ? parameter_copies_ : mode_copies_;
  }

 private:
  static MissionParameters with_points(MissionParameters parameters) {
    parameters.points = kPoints;
    return parameters;
  }

  // The same image, sent again into the other buffer.
  void load_other(const std::vector<std::uint8_t>& bytes) {
    const ConstBytes image(bytes.data(), bytes.size());
    const std::uint32_t crc = ByteReader(image.subspan(image.size() - 4, 4)).u32();
    const bool taken = component_->open_image(static_cast<std::uint32_t>(image.size()), crc) == ImageRefusal::kNone &&
                       component_->put_image(0, image) == ImageRefusal::kNone && component_->check_image() == ImageRefusal::kNone;
    for (int slot = 0; taken && slot < 100000 && component_->images().other().state() != ImageState::kReady; ++slot) {
      run_slot(*component_);
      static_cast<void>(take_telemetry(*component_));
    }
    if (component_->images().other().state() != ImageState::kReady) throw mdat::RunError("the component refuses a second image");
    while (!component_->next_slot_is_boundary()) run_slot(*component_);
  }

  // By command, so that the copies are what a command makes of them.
  void change_parameter() {
    ParameterCommand command{parameter_rows()[row_of("tracking.coast_frames")].id, kChanged};
    const PacketRow& row = command_rows::row_of(CommandKind::kSetParameter);
    std::uint8_t packet[kMaxCommandBytes];
    ByteWriter writer{Bytes(packet)};
    begin_command({kApid, 0, 0, row.service, row.subservice, 0}, writer);
    codec_of(command_rows::kSetParameter).write(command, writer);
    if (!component_->receive_packet({packet, finish_packet(writer, Bytes(packet))}, component_->next_slot_us()))
      throw mdat::RunError("no command");
  }
  static std::size_t row_of(const char* key) {
    std::size_t row = 0;
    while (std::strcmp(parameter_rows()[row].key, key) != 0) ++row;
    return row;
  }

  // Found by what they must say. Both copies lie one behind the other.
  Bytes parameter_copies() const {
    ParameterArea like;
    const ParameterRefusal refusal = like.set(row_of("tracking.coast_frames"), kChanged, component_->images().active().image_parameters());
    if (refusal != ParameterRefusal::kNone) throw mdat::RunError("the parameter cannot be changed");
    return find({like.copy(0).data(), 2 * like.copy(0).size()}, "changed parameters");
  }
  Bytes mode_copies() const {
    const Voted<TrackingMode> like(TrackingMode::kTracking);
    return find({reinterpret_cast<const std::uint8_t*>(&like), sizeof like}, "copies of the mode");
  }
  Bytes find(ConstBytes pattern, const char* what) const {
    auto* found = std::search(memory_.begin(), memory_.end(), pattern.begin(), pattern.end());
    if (found == memory_.end()) throw mdat::RunError(std::string("the component's memory has no ") + what);
    return {found, pattern.size()};
  }

  Arena arena_;
  mdat::CompiledMission mission_;
  const mdat::Scenario& scenario_;
  MissionParameters parameters_;
  std::unique_ptr<sim::Trajectory> trajectory_;
  std::unique_ptr<sim::RayCaster> target_;
  sim::SimulatedScanner scanner_;
  Bytes memory_;
  Component* component_ = nullptr;
  Bytes parameter_copies_, mode_copies_;
};

Flip draw_flip(std::uint64_t seed, std::uint32_t trial, const std::size_t (&sizes)[kAreas]) {
  sim::Random random = trial_stream(seed, trial);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random.uniform() * static_cast<double>(n)); };
  Flip flip;
  flip.trial = trial;
  flip.area = static_cast<Area>(trial % kAreas);
  flip.frame = kFirst + static_cast<std::uint32_t>(below(kFlipFrames));
  flip.slot = static_cast<std::uint32_t>(below(kSlotsPerFrame));
  flip.byte = below(sizes[static_cast<std::size_t>(flip.area)]);
  flip.bit = static_cast<std::uint8_t>(below(8));
  return flip;
}

bool tells(ConstBytes packet) {
  if (packet[7] != kServiceEvent || packet[8] > static_cast<std::uint8_t>(Severity::kHigh)) return false;
  const auto event = static_cast<EventId>(packet[kPacketHeaderBytes] << 8 | packet[kPacketHeaderBytes + 1]);
  return event == EventId::kMemoryCorrupt || event == EventId::kFaultConfirmed || event == EventId::kParametersRepaired ||
         event == EventId::kParametersLost;
}

bool any_tells(ConstBytes stream) {
  bool any = false;
  while (const std::size_t size = packet_size(stream)) {
    if (size > stream.size()) break;
    any = any || tells(stream.first(size));
    stream = stream.subspan(size, stream.size() - size);
  }
  return any;
}

// Flies on from a flip, in slot `slot` of a frame.
Finding fly_on(Subject& subject, std::uint32_t slot) {
  Finding finding;
  for (std::uint32_t frame = 1; frame <= kLongest; ++frame) {
    for (; slot < kSlotsPerFrame; ++slot) run_slot(subject.component());
    slot = 0;
    const std::vector<std::uint8_t> bytes = take_telemetry(subject.component());
    const ConstBytes stream(bytes.data(), bytes.size());
    for (const PoseTelemetry& pose : decode(stream).poses) {
      ++finding.poses;
      finding.invalid += pose.valid == 0 ? 1U : 0U;
      finding.wrong += judge_valid(pose, subject.truth().at(pose.t_measurement_us).T_sensor_target) == PoseVerdict::kWrong ? 1U : 0U;
    }
    if (!any_tells(stream)) continue;
    finding.frames = frame;
    break;
  }
  return finding;
}

[[noreturn]] void fly_child(Subject& subject, const Flip* flip, std::uint32_t slot, int pipe) {
  const rlimit limit{kChildSeconds, kChildSeconds + 1}, no_core{0, 0};
  (void)setrlimit(RLIMIT_CPU, &limit);
  (void)setrlimit(RLIMIT_CORE, &no_core);
  (void)dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
  if (flip != nullptr) subject.area(flip->area)[flip->byte] ^= static_cast<std::uint8_t>(1U << flip->bit);
  const Finding finding = fly_on(subject, slot);
  std::_Exit(write(pipe, &finding, sizeof finding) == static_cast<ssize_t>(sizeof finding) ? 0 : 2);
}

struct Result {
  Finding finding;
  End end = End::kDone;
};

Result fly(Subject& subject, const Flip* flip, std::uint32_t slot) {
  int ends[2];
  if (pipe(ends) != 0) throw mdat::RunError("no pipe to a child");
  const pid_t pid = fork();
  if (pid < 0) throw mdat::RunError("a child cannot be forked");
  if (pid == 0) fly_child(subject, flip, slot, ends[1]);
  (void)close(ends[1]);
  Result result;
  const bool read_all = read(ends[0], &result.finding, sizeof result.finding) == static_cast<ssize_t>(sizeof result.finding);
  (void)close(ends[0]);
  result.end = end_of(pid);
  if (result.end == End::kDone && !read_all) throw mdat::RunError("a child sends nothing home");
  return result;
}

// A component that stops is started again by its board, which reports it.
const char* outcome_of(const Result& result) {
  if (result.end != End::kDone) return result.end == End::kHang ? "hang" : result.end == End::kInvariant ? "invariant" : "crash";
  if (result.finding.frames > 0) return result.finding.wrong > 0 ? "told_wrong" : "detected";
  return result.finding.wrong > 0 ? "silent" : "missed";
}

std::string row_of(const Flip& flip, const Result& result) {
  char text[160];
  (void)std::snprintf(text, sizeof text, "%u,%s,%u,%u,%zu,%u,%s,%u,%u\n", flip.trial, kAreaNames[static_cast<std::size_t>(flip.area)],
                      flip.frame, flip.slot, flip.byte, flip.bit, outcome_of(result), result.finding.frames, result.finding.wrong);
  return text;
}

std::string run(const char* mission_file, std::uint32_t flips, std::uint64_t seed, std::uint32_t first) {
  Subject subject(mission_file);
  std::uint32_t at = 0;  // slots that have run
  const auto fly_to = [&](std::uint32_t slots) {
    for (; at < slots; ++at) {
      run_slot(subject.component());
      if (at % kSlotsPerFrame == kSlotsPerFrame - 1) static_cast<void>(take_telemetry(subject.component()));
    }
  };
  fly_to(kFirst * kSlotsPerFrame);
  const Result golden = fly(subject, nullptr, 0);
  const bool sound = golden.end == End::kDone && golden.finding.frames == 0 && golden.finding.poses == kLongest;
  if (!sound || golden.finding.wrong + golden.finding.invalid > 0)
    throw mdat::RunError("the flight without a flip has poses that are missing, invalid or wrong, or reports a fault");
  subject.locate_copies();
  std::size_t sizes[kAreas];
  for (std::uint32_t i = 0; i < kAreas; ++i) sizes[i] = subject.area(static_cast<Area>(i)).size();
  std::vector<Flip> plan;
  for (std::uint32_t i = 0; i < flips; ++i) plan.push_back(draw_flip(seed, first + i, sizes));
  std::sort(plan.begin(), plan.end(),
            [](const Flip& a, const Flip& b) { return a.slots() != b.slots() ? a.slots() < b.slots() : a.trial < b.trial; });
  std::vector<std::string> rows(flips);
  for (const Flip& flip : plan) {
    fly_to(flip.slots());
    rows[flip.trial - first] = row_of(flip, fly(subject, &flip, flip.slot));
  }
  std::string text = "trial,area,frame,slot,byte,bit,outcome,frames,wrong\n";
  for (const std::string& row : rows) text += row;
  return text;
}

}  // namespace
}  // namespace lasso::campaign

int main(int argc, char** argv) { return lasso::campaign::main_of({"scrub", "FLIPS", "FIRST"}, argc, argv, lasso::campaign::run); }
