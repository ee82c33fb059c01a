// A stereo head by its measured errors, in milliseconds a scan: no picture is rendered, and none is matched.
#pragma once

#include <memory>
#include <optional>

#include "fsw/sense/range_image.hpp"
#include "mdat/stereo/matcher.hpp"
#include "mdat/stereo/pair_sight.hpp"
#include "mdat/stereo/stereo_fit.hpp"

namespace lasso::mdat {

// How much of errors neighbours have in common, as shares of the variance of a normal number: over some pixels, over a part of the target,
// over the whole view. The rest of a distribution is measured (stereo_fit.hpp); these are chosen so that errors of poses are those of
// rendered pairs.
struct FittedCommon {
  double near_px = 2.5, part_px = 80;
  double part_share = 0.33, view_share = 0.09;
  double kept_share = 0.67;  // of the variance, from frame to frame of a view that stays
  double view_rad = 0.09;    // turn of the target after which errors are others
};

// Pairs of one head, one after the other. Exposures follow the light as those of StereoCamera.
class FittedStereo {
 public:
  FittedStereo(StereoHead head, std::uint64_t seed, const StereoFit& fit = preset_fit(), const FittedCommon& common = {});

  // The next pair is that of this view, which outlives it, with matches between these depths.
  void take(const StereoView& view, const MatchDepths& depths);
  // What a ray finds in the pair, as stereo_sample (stereo_sensor.hpp).
  RangeSample sample(const Vec3& direction, TimeUs t_us) const;
  double exposure_s() const { return exposure_s_; }

 private:
  double kept_field(std::uint64_t purpose, double column, double row, double blur_px) const;
  double measured_px(const PixelSight& sight, int column, int row) const;

  StereoHead head_;
  std::uint64_t seed_, frame_ = 0;
  const StereoFit& fit_;
  FittedCommon common_;
  std::unique_ptr<PairSight> sight_;
  std::optional<Quat> attitude_;
  MatchDepths depths_;
  double turned_rad_ = 0, exposure_s_ = 0, next_exposure_s_ = 0;
};

}  // namespace lasso::mdat
