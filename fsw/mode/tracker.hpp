// Tracking: one scan after another, from the prediction through registration and filter to the next mode. All state is the explicit
// struct TrackState; a step takes one and gives the next, so that a step whose result comes too late can be forgotten whole.
#pragma once

#include <cstdint>

#include "fsw/core/status.hpp"
#include "fsw/core/time.hpp"
#include "fsw/geometry/se3.hpp"
#include "fsw/mission/mission.hpp"
#include "fsw/mode/modes.hpp"
#include "fsw/pose/estimator.hpp"
#include "fsw/pose/filter.hpp"
#include "fsw/pose/result.hpp"
#include "fsw/sense/range_image.hpp"

namespace lasso {

struct TrackState {
  TrackingMode mode = TrackingMode::kStandby;
  std::uint16_t missed = 0;  // scans without a valid pose since the last one
  FilterState filter;
};

// What one scan led to. `after.filter` is stated at the registration's time.
struct TrackStep {
  TrackState after;
  Registration registration;
};

// Takes up a track at t_us from a pose and rates stated at stated_us, in whatever mode `state` is: kStarting. kNotFinite, kBadValue
// (quaternion not of unit length, stated more than kMaxPredictionUs from t_us): `state` is then as it was.
Status start_track(const Mission& mission, const Pose& T_sensor_target, const Twist& rates, TimeUs stated_us, TimeUs t_us,
                   TrackState& state);

// One scan: predict, register, join to the filter, next mode. The first valid registration starts the filter anew, since the pose given
// at the start may be far off; so does one that the filter cannot take. One that the prediction of a filter with 5 scans excludes
// (tracking.innovation_max) is kImplausible and joins nothing. A prediction less certain than the registration's gate is a rough start.
// Bounds: as Estimator::estimate.
TrackStep track_scan(const Mission& mission, Estimator& estimator, const RangeImage& scan, const TrackState& before);

// A frame without an estimate (kNoScan, kOverrun): the filter predicts to t_us, the mode coasts.
TrackStep track_without_scan(const Mission& mission, PoseReason reason, std::uint32_t scan_id, TimeUs t_us, const TrackState& before);

// A frame without a track: kNoTrack, the last pose with its own time, state unchanged.
TrackStep no_track(std::uint32_t scan_id, const TrackState& before);

}  // namespace lasso
