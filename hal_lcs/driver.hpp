// A head on a line, laser camera, LIDAR or TriDAR, behind the Sensor interface: plans become commands on the line, frames become samples,
// and every loss has its cause and its counter. It never waits: an interrupt (or a pump) fills and empties the line's rings, and each call
// works on what is there.
//
// A scan is started by one command. The answer to it ties the camera's clock to the component's: the camera had the command's last byte one
// transmission time after it was handed over. Samples that a damaged frame took along come as kInvalid and `lost`, so
// that a sample's index stays that of its ray.
#pragma once

#include <cstdint>

#include "fsw/core/voted.hpp"
#include "fsw/sense/sensor.hpp"
#include "hal_lcs/byte_ring.hpp"
#include "hal_lcs/clock_tie.hpp"
#include "hal_lcs/frame.hpp"
#include "hal_lcs/frame_reader.hpp"
#include "hal_lcs/messages.hpp"
#include "hal_lcs/optics.hpp"

namespace lasso::lcs {

constexpr std::size_t kLineBytes = 8192;         // each way: 20 ms of the fastest line
constexpr DurationUs kStartDelayUs = 1'000;      // from a start to the first sample; what is sent before it takes less at 1 Mbit/s
constexpr DurationUs kAnswerTimeoutUs = 50'000;  // the answer to a start
constexpr double kMirrorTolerance = 0.01;        // of a mirror from its plan, on the tangent plane
constexpr std::uint32_t kOffPlanFrames = 16;     // as many make a scan of another pattern

struct Line {
  ByteRing<kLineBytes> from_camera;
  ByteRing<kLineBytes> to_camera;
  double bits_per_s = 4e6;  // ten for each byte
};

// Why a scan was lost.
enum class Loss : std::uint8_t {
  kInhibited = 0,  // the laser is: nobody has permitted it, or the camera says so; kMissing
  kLineFull = 1,   // commands do not leave; kOverCapacity
  kSilent = 2,     // no answer to the start; kTimeout
  kRefused = 3,    // by the camera (Health::refused); kBusy, or kBadValue
  kBooted = 4,     // the camera has started anew; kBadOrder
  kForeign = 5,    // another head than the calibration's, another kind or protocol, or it has never said which; kBadVersion
  kStopped = 6,    // the camera ended it early; kTruncated
  kOffPlan = 7,    // the mirrors do not follow the plan; kOffPlan
};
constexpr std::size_t kLosses = 8;
constexpr std::size_t kResults = 8;
constexpr std::size_t kFates = 7;

struct Health {
  std::uint32_t sequence_gaps = 0;  // before a frame: others never came, or came damaged
  std::uint32_t repeated = 0;       // frames with the sequence of the one before
  std::uint32_t bad_messages = 0;   // frames that are right, and say nothing that is defined
  std::uint32_t strayed = 0;        // samples of another scan, answers to no question, repeated samples
  std::uint32_t samples_lost = 0;   // that no frame brought
  std::uint32_t bad_times = 0;      // samples before their predecessor, or far from their plan
  std::uint32_t off_plan = 0;       // frames whose first sample's mirrors are
  std::uint32_t clock_jumps = 0;
  std::uint32_t boots = 0;               // seen by the driver
  std::uint32_t fates[kFates] = {};      // samples, by Fate
  std::uint32_t refused[kResults] = {};  // starts, by Result
  std::uint32_t scans_lost[kLosses] = {};
};

class Driver final : public Sensor {
 public:
  // `optics` are valid (an invariant); the line outlives the driver.
  Driver(Line& line, const Optics& optics);

  // The laser's permission, which an armed command gives and any safe mode takes; there is none at first. Without it an inhibit is put on
  // the line with each call (of any function) until the camera confirms it, and again when it says that it is lit; on a line that holds
  // other bytes it follows them, at most kLineBytes. It is kept in three copies, voted and repaired at each start.
  void permit_laser(bool permitted) override;

  void use_calibration(const TriangulationCalibration* calibration) override;

  // kBusy while a scan runs; validate(plan)'s reason; kMissing without permission; kOverCapacity when the line takes no more. t_start_us
  // is now: the first sample is taken kStartDelayUs later, or as soon as the camera has the command if the line holds it up for longer.
  Status start(const ScanPlan& plan, TimeUs t_start_us) override;
  // Bound: kLineBytes bytes, out.size() samples.
  SensorPoll poll(TimeUs now_us, Span<RangeSample> out) override;
  void abort() override;
  SensorCounters counters() const override;

  const Health& health() const { return health_; }
  const FrameDecoder::Counters& line_counters() const { return reader_.counters(); }
  const CameraStatus& camera() const { return camera_; }  // as it last said, dark after an inhibit; serial 0: never

 private:
  enum class State : std::uint8_t { kIdle, kStarting, kScanning, kEnded };
  struct Scan {
    ScanPlan plan;
    std::uint8_t tag = 0;
    std::uint8_t start_sequence = 0;
    TimeUs t_start_us = 0;
    DurationUs command_us = 0;  // from t_start_us to the start command's last byte ...
    DurationUs first_us = 0;    // ... and to the first sample
    TimeUs last_us = 0;         // of the last sample
    std::uint32_t next = 0;     // sample to hand over
    std::uint32_t off_plan = 0;
    bool end_seen = false;
    Samples pending;  // received, from `taken` on not handed over
    std::size_t taken = 0;
  };

  bool may_be_dark(TimeUs now_us) const { return now_us - spoken_us_ > kUnheardUs / 2; }
  bool under_way() const { return state_ == State::kStarting || state_ == State::kScanning; }
  bool has_room(std::size_t bytes) const;
  void send(const FrameBytes& frame);
  bool laser_permitted() const;
  void inhibit();
  void send_start(const ScanPlan& plan, TimeUs t_start_us);
  void send_start_command(const ScanPlan& plan);
  void keep_lit(TimeUs now_us);
  void send_aim(Span<const AimedRay> aimed);
  Status refuse(Loss loss, Status reason);
  void lose(Loss loss, Status reason);
  void stop_camera();
  void listen();
  bool known_head() const;
  void begin();
  void take_refusal(Result result);
  void receive(const Frame& frame);
  void take(const Answer& answer);
  void take(const CameraStatus& status);
  void take(const Samples& samples);
  void take(const ScanEnd& end);
  void check_plan(const Samples& samples);
  void next_sample(RangeSample& sample);
  void convert(const RawSample& raw, RangeSample& sample);
  std::size_t hand_over(Span<RangeSample> out, std::size_t count);

  Line& line_;
  Optics made_;    // as it was made
  Optics optics_;  // as they are believed
  FrameReader<kLineBytes> reader_;
  Health health_;
  CameraStatus camera_;
  Voted<std::uint8_t> laser_{0};  // 1: permitted
  bool inhibit_due_ = true;       // the camera has not confirmed that it is dark
  std::uint8_t inhibit_sequence_ = 0;
  std::uint8_t sent_ = 0;      // frames, modulo 256
  TimeUs spoken_us_ = 0;       // when the camera was last told something that keeps its laser lit
  std::uint8_t expected_ = 0;  // sequence of the next frame
  bool heard_ = false;         // any frame
  ClockTie tie_;
  State state_ = State::kIdle;
  Status loss_ = Status::kOk;
  Scan scan_;
};

}  // namespace lasso::lcs
