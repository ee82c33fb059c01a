// What the frames of a scanner's line say: docs/icd/lcs.md, lidar.md and tridar.md. The driver and the simulated heads share these
// functions. A decoder answers kBadLength (payload too short or too long) or kBadValue (a code that is not defined), and leaves its message
// as it may be then.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/span.hpp"
#include "fsw/core/status.hpp"
#include "fsw/sense/scan_plan.hpp"
#include "hal_lcs/frame.hpp"

namespace lasso::lcs {

enum class Type : std::uint8_t {
  kSelfTest = 0x01,   // to the camera, without payload; what it finds is in its status
  kAskStatus = 0x02,  // without payload
  kLaser = 0x03,      // LaserCommand
  kAskTable = 0x04,   // without payload; answered, then told in parts
  kAim = 0x10,        // AimCommand: directions for the scan that runs
  kStart = 0x11,      // StartCommand
  kAbort = 0x12,      // without payload: ends a scan, and forgets aimed rays
  kAnswer = 0x81,     // from the camera: Answer, one for each command but kAim
  kStatus = 0x82,     // CameraStatus: asked for, and unasked after a boot
  kTable = 0x83,      // TablePart (table.hpp) of its calibration
  kSamples = 0x91,    // Samples
  kScanEnd = 0x92,    // ScanEnd
};

// The laser is lit by two commands, arm and fire, within kArmedUs; one is enough to put it out.
enum class LaserCommand : std::uint8_t { kInhibit = 0, kArm = 0x5A, kFire = 0xA5 };
constexpr DurationUs kArmedUs = 1'000'000;
constexpr DurationUs kUnheardUs = 2'000'000;  // without a right frame for so long, the camera puts its laser out by itself

enum class Result : std::uint8_t {
  kDone = 0,
  kUnknown = 1,    // no such command, or its payload has another length; a table that the head does not have
  kBusy = 2,       // a scan runs
  kInhibited = 3,  // the laser is
  kNotArmed = 4,   // fired without, or too late
  kBadPlan = 5,    // a pattern outside the camera's limits
  kFault = 6,      // the camera's self-test has found one
};

struct Answer {
  Type to = Type::kSelfTest;
  std::uint8_t sequence = 0;  // of the command's frame
  Result result = Result::kDone;
  std::uint32_t clock_us = 0;  // the camera's, when the command's last byte came; wraps
};

struct StartCommand {
  std::uint32_t delay_us = 0;  // from the command's last byte to the first sample
  std::uint16_t aimed = 0;     // rays that follow by kAim; they are in the middle of the scan, so that there is time
  ScanPlan plan;               // without its aimed rays; its points count them
};
// The command for a plan, without delay; the plan's aimed rays are counted, and pass by themselves.
StartCommand start_command(const ScanPlan& plan);

// The scan's tag, which comes back with its samples.
constexpr std::uint8_t tag_of(std::uint32_t scan_id) { return static_cast<std::uint8_t>(scan_id & 0xFFU); }

constexpr std::size_t kAimedPerFrame = 6;
struct AimCommand {
  std::uint16_t first = 0;
  std::size_t count = 0;  // 1..kAimedPerFrame
  AimedRay rays[kAimedPerFrame];
};

constexpr std::uint8_t kProtocolVersion = 2;  // docs/icd/lcs.md; no other is spoken

// What kind of head is at the other end.
enum class Device : std::uint8_t {
  kLaserCamera = 0,  // triangulates
  kLidar = 1,        // times its light
  kTridar = 2,       // both, each sample by one of them
  kUnknown = 0xFF,   // any other: a status that says so is of a foreign head, and not of none
};

struct CameraStatus {
  std::uint32_t serial = 0;  // of the camera: its calibration is for no other
  std::uint32_t boots = 0;
  std::uint32_t clock_us = 0;
  float temperature_degC = 0;
  bool laser_lit = false;
  bool scanning = false;
  std::uint8_t faults = 0;  // bit 0 mirror x, 1 mirror y, 2 detector, 3 laser, 4 memory
  std::uint8_t version = kProtocolVersion;
  Device device = Device::kLaserCamera;
};

enum class SampleKind : std::uint8_t {
  kReturn = 0,     // a spot, to be triangulated
  kNothing = 1,    // the detector saw no spot
  kSaturated = 2,  // the spot was too bright to be placed
  kNotAimed = 3,   // the ray's direction had not come in time
  kEcho = 4,       // a pulse that came back, timed
};

constexpr std::uint8_t kMaxIntensity = 15;

constexpr double kFlightStepUs = 1.0 / 2097152;     // 2^-21 us: 0.07 mm of range
constexpr double kMaxFlightUs = 8 - kFlightStepUs;  // 24 bits: 1199 m

// One sample as the head measures it.
struct RawSample {
  std::uint32_t clock_us = 0;  // the camera's; wraps
  double angle_x_rad = 0;      // of the mirrors; [-1, 1), steps of 2^-23
  double angle_y_rad = 0;
  double peak = 0;             // of the spot on the detector, half widths from its middle; [-1, 1), steps of 2^-23
  double flight_us = 0;        // of an echo, which has no peak: from pulse to return; [0, 8), steps of kFlightStepUs
  std::uint8_t intensity = 0;  // of kMaxIntensity
  SampleKind kind = SampleKind::kNothing;
};

constexpr std::size_t kSamplesPerFrame = 4;
constexpr DurationUs kMaxSampleOffsetUs = 65'535;  // of a sample from the first one of its frame
struct Samples {
  std::uint8_t tag = 0;
  std::uint16_t first = 0;  // index of the first one in its scan
  std::size_t count = 0;    // 1..kSamplesPerFrame, within kMaxSampleOffsetUs
  RawSample samples[kSamplesPerFrame];
};

struct ScanEnd {
  std::uint8_t tag = 0;
  std::uint16_t points = 0;  // samples sent
  bool whole = false;        // false: aborted, or stopped by a fault
};

// Each payload fits into a frame; a count that is not allowed is an invariant's failure.
FrameBytes encode(std::uint8_t sequence, Type without_payload);
FrameBytes encode(std::uint8_t sequence, LaserCommand message);
FrameBytes encode(std::uint8_t sequence, const AimCommand& message);
FrameBytes encode(std::uint8_t sequence, const StartCommand& message);
FrameBytes encode(std::uint8_t sequence, const Answer& message);
FrameBytes encode(std::uint8_t sequence, const CameraStatus& message);
FrameBytes encode(std::uint8_t sequence, const Samples& message);
FrameBytes encode(std::uint8_t sequence, const ScanEnd& message);

Status decode(const Frame& frame, LaserCommand& message);
Status decode(const Frame& frame, AimCommand& message);
Status decode(const Frame& frame, StartCommand& message);  // the plan is as it came: not validated
Status decode(const Frame& frame, Answer& message);
Status decode(const Frame& frame, CameraStatus& message);
Status decode(const Frame& frame, Samples& message);
Status decode(const Frame& frame, ScanEnd& message);

}  // namespace lasso::lcs
