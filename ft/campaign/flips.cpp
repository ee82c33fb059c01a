// flips MISSION FILE FLIPS SEED [FIRST]: one flight, repeated with one bit flipped in each repetition; writes a row for each into FILE
// (CSV). What is flipped, where and when depends on SEED and the trial's number alone: FLIPS = 1 and FIRST repeat one of them.
//
// The flight is flown once, and forks a child at each flip, which flips the bit, flies on and sends home its telemetry. Nothing protects
// the component's memory here: no error-correcting memory, no scrubber.
#include <fcntl.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <thread>

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
constexpr std::uint32_t kFrames = 24;       // of the flight
constexpr std::uint32_t kFirst = 6;         // frame in which the first flips happen, the track being settled
constexpr std::uint32_t kFlipFrames = 10;   // and the frames after it in which they do
constexpr rlim_t kChildSeconds = 10;        // of processor time: a flight takes less than a tenth of a second
constexpr std::size_t kSampleBytes = 29;    // of a sample, without padding
constexpr std::size_t kTrackBytes = 24576;  // the end of the component: its track, plans, counters and requests (fsw/exec/component.hpp)

enum class Region : std::uint8_t { kImage = 0, kMission = 1, kTrack = 2, kBuffers = 3, kSamples = 4 };
constexpr const char* kRegionNames[] = {"image", "mission", "track", "buffers", "samples"};
constexpr std::uint32_t kRegions = 5;

struct Flip {
  std::uint32_t trial = 0;
  Region region = Region::kImage;
  std::uint32_t frame = 0, slot = 0;
  std::size_t byte = 0;  // of the region; of the sample
  std::uint8_t bit = 0;
  std::size_t sample = 0;
};

// Passes the samples of a sensor on, one of them with a bit flipped.
class FlippingSensor final : public Sensor {
 public:
  explicit FlippingSensor(Sensor& sensor) : sensor_(sensor) {}
  void arm(const Flip& flip) { flip_ = &flip; }

  Status start(const ScanPlan& plan, TimeUs t_start_us) override {
    delivered_ = 0;
    return sensor_.start(plan, t_start_us);
  }
  SensorPoll poll(TimeUs now_us, Span<RangeSample> out) override {
    const SensorPoll poll = sensor_.poll(now_us, out);
    if (flip_ != nullptr && flip_->sample >= delivered_ && flip_->sample < delivered_ + poll.count) {
      reinterpret_cast<std::uint8_t*>(&out[flip_->sample - delivered_])[flip_->byte] ^= static_cast<std::uint8_t>(1U << flip_->bit);
      flip_ = nullptr;
    }
    delivered_ += poll.count;
    return poll;
  }
  void abort() override { sensor_.abort(); }
  void permit_laser(bool permitted) override { sensor_.permit_laser(permitted); }

 private:
  Sensor& sensor_;
  const Flip* flip_ = nullptr;
  std::size_t delivered_ = 0;
};

// The flight and its memory.
class Subject {
 public:
  explicit Subject(const char* mission_file)
      : mission_(mdat::compile_mission(mission_file)),
        scenario_(mdat::scenario_of(mission_.source, kScenario)),
        parameters_(mdat::parameters_for(mission_.source, kScenario)),
        trajectory_(mdat::make_trajectory(scenario_, kRange_m, mdat::kEpochUs, mdat::period_us(parameters_))),
        target_(mdat::make_target(mission_.mesh)),
        scanner_(*target_, *trajectory_, mdat::scanner_model(scenario_, parameters_, true), static_cast<std::uint64_t>(scenario_.seed)) {
    const std::vector<std::uint8_t> bytes = mdat::image_bytes(mission_, parameters_);
    image_ = Bytes(static_cast<std::uint8_t*>(arena_.take(bytes.size())), bytes.size());
    std::copy(bytes.begin(), bytes.end(), image_.begin());
    memory_ = Bytes(static_cast<std::uint8_t*>(arena_.take(required_memory())), required_memory());
    sensor_ = new (arena_.take(sizeof(FlippingSensor))) FlippingSensor(scanner_);
    component_ = create(memory_.data(), memory_.size(), *sensor_);
    if (component_ == nullptr) throw mdat::RunError("the component refuses its memory");
    begin(*component_, image_);
    start_tracking(*component_, trajectory_->at(mdat::kEpochUs).T_sensor_target);
  }

  Component& component() { return *component_; }
  const sim::Trajectory& truth() const { return *trajectory_; }

  Bytes region(Region region) {
    const auto at = static_cast<std::size_t>(reinterpret_cast<const std::uint8_t*>(&component_->mission()) - memory_.data());
    const std::size_t after = at + sizeof(Mission), end = memory_.size() - kTrackBytes;
    if (region == Region::kImage) return image_;
    if (region == Region::kMission) return memory_.subspan(at, sizeof(Mission));
    return region == Region::kTrack ? memory_.subspan(end, kTrackBytes) : memory_.subspan(after, end - after);
  }

  // The track must be where the campaign takes it to be: the position that was published last is among its bytes.
  void check_track(const PoseTelemetry& last) {
    const Bytes track = region(Region::kTrack);
    const auto* sought = reinterpret_cast<const std::uint8_t*>(last.filter_p_sensor_target_m);
    if (std::search(track.begin(), track.end(), sought, sought + sizeof last.filter_p_sensor_target_m) == track.end()) {
      throw mdat::RunError("the track is not among the component's last bytes: see kTrackBytes in ft/campaign/flips.cpp");
    }
  }

  void apply(const Flip& flip) {
    if (flip.region == Region::kSamples) return sensor_->arm(flip);
    region(flip.region)[flip.byte] ^= static_cast<std::uint8_t>(1U << flip.bit);
  }

 private:
  Arena arena_;
  mdat::CompiledMission mission_;
  const mdat::Scenario& scenario_;
  MissionParameters parameters_;
  std::unique_ptr<sim::Trajectory> trajectory_;
  std::unique_ptr<sim::RayCaster> target_;
  sim::SimulatedScanner scanner_;
  Bytes image_, memory_;
  FlippingSensor* sensor_ = nullptr;
  Component* component_ = nullptr;
};

Flip draw_flip(std::uint64_t seed, std::uint32_t trial, Subject& subject) {
  sim::Random random = trial_stream(seed, trial);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random.uniform() * static_cast<double>(n)); };
  Flip flip;
  flip.trial = trial;
  flip.region = static_cast<Region>(trial % kRegions);
  const bool in_sample = flip.region == Region::kSamples;
  flip.frame = kFirst + static_cast<std::uint32_t>(below(kFlipFrames));
  flip.slot = in_sample ? 0 : static_cast<std::uint32_t>(below(kSlotsPerFrame));
  flip.byte = below(in_sample ? kSampleBytes : subject.region(flip.region).size());
  flip.bit = static_cast<std::uint8_t>(below(8));
  flip.sample = below(static_cast<std::size_t>(subject.component().mission().parameters.points));
  return flip;
}

// A place in the flight: all slots before it have run.
struct Place {
  std::uint32_t frame = 0, slot = 0;
  std::uint32_t slots() const { return frame * kSlotsPerFrame + slot; }
};

// Runs slots until `to`, and writes the telemetry of each frame that ends on the way.
template <class Sink>
void fly(Component& component, Place& at, Place to, const Sink& sink) {
  while (at.slots() < to.slots()) {
    run_slot(component);
    if (++at.slot < kSlotsPerFrame) continue;
    at = {at.frame + 1, 0};
    sink(take_telemetry(component));
  }
}

// A child that flies on by itself.
struct Child {
  pid_t pid = -1;
  int pipe = -1;
  const Flip* flip = nullptr;
};

[[noreturn]] void fly_child(Subject& subject, const Flip* flip, Place at, int pipe) {
  const rlimit limit{kChildSeconds, kChildSeconds + 1}, no_core{0, 0};
  (void)setrlimit(RLIMIT_CPU, &limit);
  (void)setrlimit(RLIMIT_CORE, &no_core);
  (void)dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
  if (flip != nullptr) subject.apply(*flip);
  try {
    fly(subject.component(), at, {kFrames, 0}, [&](const std::vector<std::uint8_t>& bytes) {
      if (write(pipe, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) std::_Exit(2);
    });
  } catch (const std::exception&) {
    std::_Exit(1);
  }
  std::_Exit(0);
}

Child start_child(Subject& subject, const Flip* flip, Place at) {
  int ends[2];
  if (pipe(ends) != 0) throw mdat::RunError("no pipe to a child");
  Child child{fork(), ends[0], flip};
  if (child.pid < 0) throw mdat::RunError("a child cannot be forked");
  if (child.pid == 0) fly_child(subject, flip, at, ends[1]);
  (void)close(ends[1]);
  return child;
}

// All that the child wrote, which is less than a pipe holds; then how it ended.
std::vector<std::uint8_t> read_all(int pipe) {
  std::vector<std::uint8_t> bytes;
  std::uint8_t buffer[4096];
  for (ssize_t n = read(pipe, buffer, sizeof buffer); n > 0; n = read(pipe, buffer, sizeof buffer))
    bytes.insert(bytes.end(), buffer, buffer + n);
  (void)close(pipe);
  return bytes;
}

class Campaign {
 public:
  explicit Campaign(const char* mission_file) : subject_(mission_file) {}

  std::string run(std::uint32_t flips, std::uint64_t seed, std::uint32_t first) {
    fly_golden();
    std::vector<Flip> plan;
    for (std::uint32_t i = 0; i < flips; ++i) plan.push_back(draw_flip(seed, first + i, subject_));
    std::sort(plan.begin(), plan.end(), [](const Flip& a, const Flip& b) {
      const std::uint32_t slot_a = Place{a.frame, a.slot}.slots(), slot_b = Place{b.frame, b.slot}.slots();
      return slot_a != slot_b ? slot_a < slot_b : a.trial < b.trial;
    });
    rows_.resize(flips);
    first_ = first;
    for (const Flip& flip : plan) launch(flip);
    while (!children_.empty()) collect();
    std::string text = "trial,region,frame,slot,byte,bit,sample,outcome\n";
    for (const std::string& line : rows_) text += line;
    return text;
  }

 private:
  // The same flight without a flip, by a child, so that the parent can begin at its begin.
  void fly_golden() {
    const Child child = start_child(subject_, nullptr, at_);
    golden_ = read_all(child.pipe);
    if (end_of(child.pid) != End::kDone) throw mdat::RunError("the flight without a flip does not end");
    const Decoded decoded = decode(view(golden_));
    const bool sound = decoded.broken == 0 && decoded.poses.size() + kPipelineFrames == kFrames;
    const bool valid = std::all_of(decoded.poses.begin(), decoded.poses.end(), [](const PoseTelemetry& pose) { return pose.valid != 0; });
    if (!sound || !valid || outcome(view(golden_), {}, subject_.truth(), End::kDone) == Outcome::kSilent) {
      throw mdat::RunError("the flight without a flip has poses that are missing, invalid or wrong");
    }
  }

  void launch(const Flip& flip) {
    fly(subject_.component(), at_, {flip.frame, flip.slot}, [&](const std::vector<std::uint8_t>& bytes) {
      so_far_.insert(so_far_.end(), bytes.begin(), bytes.end());
      const Decoded decoded = decode(view(bytes));
      if (!decoded.poses.empty()) subject_.check_track(decoded.poses.back());
    });
    if (children_.size() >= std::max(1U, std::thread::hardware_concurrency())) collect();
    children_.push_back(start_child(subject_, &flip, at_));
    before_.push_back(so_far_.size());
  }

  // The oldest child's row.
  void collect() {
    const Child child = children_.front();
    std::vector<std::uint8_t> telemetry(golden_.begin(), golden_.begin() + static_cast<std::ptrdiff_t>(before_.front()));
    const std::vector<std::uint8_t> rest = read_all(child.pipe);
    telemetry.insert(telemetry.end(), rest.begin(), rest.end());
    const Outcome what = outcome(view(telemetry), view(golden_), subject_.truth(), end_of(child.pid));
    const Flip& flip = *child.flip;
    char text[160];
    (void)std::snprintf(text, sizeof text, "%u,%s,%u,%u,%zu,%u,%zu,%s\n", flip.trial, kRegionNames[static_cast<std::size_t>(flip.region)],
                        flip.frame, flip.slot, flip.byte, flip.bit, flip.sample, kOutcomeNames[static_cast<std::size_t>(what)]);
    rows_[flip.trial - first_] = text;
    children_.erase(children_.begin());
    before_.erase(before_.begin());
  }

  static ConstBytes view(const std::vector<std::uint8_t>& bytes) { return {bytes.data(), bytes.size()}; }

  Subject subject_;
  Place at_;
  std::vector<std::uint8_t> golden_, so_far_;
  std::vector<Child> children_;
  std::vector<std::size_t> before_;  // bytes that were sent before each child's flip
  std::vector<std::string> rows_;
  std::uint32_t first_ = 0;
};

}  // namespace
}  // namespace lasso::campaign

int main(int argc, char** argv) {
  return lasso::campaign::main_of({"flips", "FLIPS", "FIRST"}, argc, argv,
                                  [](const char* mission, std::uint32_t flips, std::uint64_t seed, std::uint32_t first) {
                                    return lasso::campaign::Campaign(mission).run(flips, seed, first);
                                  });
}
