// The acquisition of one scan: starts it, collects its samples call by call, and says at the frame boundary what it is worth. Besides it
// only its caller, AcquisitionTask (fsw/exec/acquisition_task.hpp), calls a sensor. It owns its state and nothing else: the image being
// filled belongs to the caller (who keeps two of them) and must be the same one from start() to finish().
#pragma once

#include <cstdint>

#include "cfg/capacities.hpp"
#include "fsw/core/status.hpp"
#include "fsw/core/time.hpp"
#include "fsw/mission/mission.hpp"
#include "fsw/sense/range_image.hpp"
#include "fsw/sense/scan_plan.hpp"
#include "fsw/sense/sensor.hpp"

namespace lasso {

// Why a sample was not believed. It is kept as an invalid ray, so that the count of rays stays true.
enum class BadSample : std::uint8_t {
  kState = 0,      // no such state
  kNotFinite = 1,  // NaN or infinity, of a hit's sigma factor, too
  kDirection = 2,  // length not within about 1e-3 of 1 (its square within 2e-3)
  kRange = 3,      // hit: range not within [0, kMaxRangeM], or its sigma factor not within [1, kMaxSigmaFactor]
  kTime = 4,       // before its predecessor or the scan's start, later than now, or after the start by more than kLongestScan_us
};
constexpr std::size_t kBadSampleKinds = 5;
// The states of a sample that an image holds: all but kLost.
bool is_known(RayState state);
// Could a hit or a miss be, its time apart? Otherwise the reason: kNotFinite, kDirection or kRange.
bool is_sound(const RangeSample& sample, BadSample& reason);
constexpr DurationUs kLongestScan_us = FlightNumber::kLongestScan_us;  // from its start to its last sample
constexpr double kMaxRangeM = 1e5;
constexpr std::uint32_t kUsablePercent = 80;  // of the samples that the sensor has for the plan

// Why a scan cannot be estimated from: what an operator looks for first.
enum class ScanLoss : std::uint8_t {
  kNone = 0,         // it was not lost
  kInhibited = 1,    // the sensor's light is: kMissing
  kNoRoom = 2,       // the sensor takes no more commands: kOverCapacity
  kSilent = 3,       // the sensor does not answer, or has nothing: kTimeout, kNoData
  kBusy = 4,         // an earlier scan runs
  kRefused = 5,      // the plan is outside the sensor's limits: kBadValue
  kRestarted = 6,    // the sensor has started anew: kBadOrder
  kForeign = 7,      // another sensor than the calibration's, or of another protocol: kBadVersion
  kStopped = 8,      // the sensor ended it early: kTruncated
  kOffPlan = 9,      // the sensor scans something else
  kOther = 10,       // the sensor gave another reason
  kUnfinished = 11,  // the frame's boundary came first, and too few samples are there
  kThin = 12,        // complete, but too few of its samples are well formed
  kStuck = 13,       // its rays went nearly one way: the mirrors stand still (fsw/exec/scan_faults.hpp)
  kFrozen = 14,      // its samples are those of the scan before, which was planned otherwise (fsw/exec/scan_faults.hpp)
};
constexpr std::size_t kScanLosses = 15;
ScanLoss loss_of(Status reason);  // that a sensor gave

struct ScanVerdict {
  std::uint32_t scan_id = 0;
  bool complete = false;            // the sensor handed over the scan's last sample
  bool usable = false;              // may be estimated from; otherwise the image is empty
  Status reason = Status::kNoData;  // kOk: complete and usable. Otherwise why not (see finish)
  ScanLoss loss = ScanLoss::kNone;  // of a scan that was started, or refused, and is not usable
  std::uint16_t count = 0;          // samples taken into the image: hits + misses + invalid
  std::uint16_t hits = 0;
  std::uint16_t misses = 0;
  std::uint16_t invalid = 0;                // declared so by the sensor, lost or bad
  std::uint16_t lost = 0;                   // on the way from the sensor: not well formed
  std::uint32_t bad[kBadSampleKinds] = {};  // by BadSample; each bad sample counts once, under its first reason
  std::uint32_t overflow = 0;               // samples for which the image had no room
};

class Acquisition {
 public:
  // Arms the sensor for the plan and empties the image. kBusy while a scan is under way; validate()'s reason for a plan that is not
  // valid; the sensor's reason when it refuses. What a refused start was refused for is also what finish() then reports. After kBusy
  // nothing has changed.
  Status start(Sensor& sensor, const ScanPlan& plan, TimeUs t_start_us, RangeImage& image);

  // One poll of at most kMaxSamplesPerPoll samples, each validated and stored. Does nothing unless a scan is under way, and after the
  // scan's end. A sample whose time is wrong is stored with its predecessor's time: the image stays in time order.
  void step(Sensor& sensor, TimeUs now_us, RangeImage& image);

  // The frame boundary: ends the scan and judges it. An unfinished one is aborted at the sensor. The verdict's reason is
  //   kOk       complete, and at least kUsablePercent of the samples asked for are well formed (hits, misses, or declared invalid): usable
  //   kTimeout  not complete in time; usable when at least kUsablePercent of the points are there, well formed
  //   kBadValue complete, but fewer well-formed samples than that: not usable
  //   kNoData   no scan was started, or the sensor had nothing: its loss says which
  //   other     the sensor lost the scan, or refused it, for this reason: not usable
  // The image of a scan that is not usable is emptied: never half-used.
  ScanVerdict finish(Sensor& sensor, RangeImage& image);

  bool under_way() const { return state_ == State::kRunning; }  // more steps are needed

 private:
  enum class State : std::uint8_t { kIdle, kRunning, kComplete, kLost };  // lost: for the verdict's reason

  void take(const RangeSample& sample, TimeUs now_us, RangeImage& image);
  bool check(const RangeSample& sample, TimeUs now_us, BadSample& reason) const;
  bool store(const RangeSample& sample, RangeImage& image);
  void judge();
  void lose(Sensor& sensor, Status reason);

  State state_ = State::kIdle;
  std::uint16_t points_ = 0;       // asked for: Sensor::samples_of
  std::uint32_t well_formed_ = 0;  // samples in the image that were believed
  TimeUs t_start_us_ = 0;          // of the scan
  TimeUs last_t_us_ = 0;           // of the last believed sample; the start before the first
  ScanVerdict verdict_;
  RangeSample polled_[kMaxSamplesPerPoll];
};

}  // namespace lasso
