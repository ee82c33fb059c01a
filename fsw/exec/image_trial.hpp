// An image that has just become active is on trial: of so many scans so many have to give valid poses.
#pragma once

#include <cstdint>

#include "fsw/mode/modes.hpp"
#include "fsw/pose/scan/result.hpp"

namespace lasso {

enum class TrialVerdict : std::uint8_t { kNone = 0, kOpen = 1, kPassed = 2, kFailed = 3 };

class ImageTrial {
 public:
  // Without scans there is nothing to show.
  void begin(std::uint32_t scans, std::uint32_t valid_min) {
    scans_ = scans;
    valid_min_ = valid_min < scans ? valid_min : scans;
    seen_ = 0;
    valid_ = 0;
    lost_ = false;
    under_way_ = true;
  }
  // What a frame gave. Scans that were lost say nothing about the image, nor do those of which no pose is expected, or whose pose
  // waits for the check of a start, or is refused by it.
  void note(const Registration& registration, TrackingMode mode) {
    const ModeProperties& of_mode = properties(mode);
    const PoseReason reason = registration.reason;
    if (reason == PoseReason::kUnchecked || reason == PoseReason::kContradicted) return;
    if (reason == PoseReason::kNoScan || of_mode.full_field || of_mode.searches) return;
    ++seen_;
    if (registration.valid()) ++valid_;
  }
  // The image has the calibration of another sensor.
  void note_foreign() { ++seen_; }
  // The track is lost: of a target that was seen with this image, it is the image that lost it.
  void note_lost() { lost_ = lost_ || seen_ > 0; }
  TrialVerdict verdict() const {
    if (!under_way_) return TrialVerdict::kNone;
    if (valid_ >= valid_min_) return TrialVerdict::kPassed;
    return seen_ >= scans_ || lost_ ? TrialVerdict::kFailed : TrialVerdict::kOpen;
  }
  void end() { under_way_ = false; }

 private:
  bool under_way_ = false;
  bool lost_ = false;
  std::uint32_t scans_ = 0, valid_min_ = 0;
  std::uint32_t seen_ = 0, valid_ = 0;
};

}  // namespace lasso
