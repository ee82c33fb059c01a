// Where the target is while nothing is known of its attitude: azimuth, elevation, range and their rates, of the centroid of its returns in
// full-field scans. The centroid is that of the surface which the sensor sees: nearer than the target's origin, and it wanders over the
// target as the target turns.
//
// One scan: the returns that the sensor can have measured; of these the group that is the target's (target_cluster.hpp); its mean, at the
// mean of the returns' own times, with the covariance of a mean of so many points of that spread. Several scans: a Kalman filter of the
// centroid's place and velocity in sensor axes, constant velocity disturbed by white accelerations of filter.acceleration_mps2 (Bar-Shalom,
// Li & Kirubarajan 2001, 6.3.2). The state is the explicit struct BearingState.
//
// Returns that are left out as strays may be the target's: those of a mast, or of a face seen at a grazing angle. They are fewer than one
// of kStrayShare around each place, and two radii away at most: a group of these would move the centroid by 2 * radius / kStrayShare. Half
// of that is a sigma of the place in each direction. It is the same in all scans, so that it is no part of the filter's state.
#pragma once

#include <cstdint>

#include "fsw/core/time.hpp"
#include "fsw/geometry/types.hpp"
#include "fsw/mission/mission.hpp"
#include "fsw/pose/tracking/target_cluster.hpp"
#include "fsw/sense/range_image.hpp"

namespace lasso {

enum class BearingReason : std::uint8_t {
  kValid = 0,
  kNoScan = 1,           // no samples: the scan was lost
  kOutOfOrder = 2,       // samples, or the scan after its predecessor, go back in time
  kSameScan = 3,         // this scan has been looked at already
  kNothingSeen = 4,      // no ray returned
  kNotFinite = 5,        // no return can be believed; the first is not a number
  kOutsideField = 6,     // no return can be believed; the first is not from the field of view
  kOutsideRange = 7,     // no return can be believed; the first is nearer or farther than the sensor measures
  kTooFewReturns = 8,    // fewer than bearing.returns_min, with or without background and strays
  kOneDirection = 9,     // all returns along one ray: the mirrors stand still
  kOnlyBackground = 10,  // no group of the target's size stands alone
  kJump = 11,            // far from where the scans before say that it is
};
const char* to_string(BearingReason reason);  // never null

struct BearingState {
  bool looked = false;   // a scan was looked at, whatever it showed
  TimeUs looked_us = 0;  // its reference time
  bool started = false;  // the members below hold
  TimeUs t_us = 0;       // at which place and velocity are stated
  Vec3 p_m = Vec3::Zero();
  Vec3 v_mps = Vec3::Zero();
  Mat6 covariance = Mat6::Zero();  // of (place, velocity), sensor axes
  std::uint32_t scans = 0;         // joined
  std::uint32_t jumps = 0;         // scans in a row that did not fit
};

// What one scan led to. Unless valid() only reason, scan_id, t_us and the counts say something: nothing old is repeated.
struct Bearing {
  BearingReason reason = BearingReason::kNoScan;
  std::uint32_t scan_id = 0;
  TimeUs t_us = 0;             // mean time of the returns used; the scan's reference time unless valid
  std::uint16_t returns = 0;   // rays that hit
  std::uint16_t credible = 0;  // of these, what the sensor can have measured
  std::uint16_t used = 0;      // of these, the target's
  std::uint32_t scans = 0;     // that the bearing rests on
  // Azimuth (positive right) and elevation (positive up) [rad], range [m], then their rates per second: azimuth = atan(x / z).
  Vec6 value = Vec6::Zero();
  Mat6 covariance = Mat6::Zero();

  bool valid() const { return reason == BearingReason::kValid; }
  double azimuth_rad() const { return value[0]; }
  double elevation_rad() const { return value[1]; }
  double range_m() const { return value[2]; }
  double closing_mps() const { return -value[5]; }
};

constexpr std::uint32_t kBearingJumpsMax = 3;  // scans in a row that do not fit: the target is elsewhere, the bearing starts anew
constexpr double kBearingGate = 30;            // of the normalised innovation squared, 3 degrees of freedom
constexpr double kOneDirection = 1e-6;         // returns within this of each other on the tangent plane lie in one direction

class BearingFinder {
 public:
  // One full-field scan. A scan that is not valid leaves place, velocity and covariance as they were, except that the last of
  // kBearingJumpsMax jumps in a row, or a scan bearing.memory_s after the last one joined, starts them anew. Bounds: keep_target_cluster's.
  Bearing find(const Mission& mission, const RangeImage& scan, BearingState& state);

 private:
  FieldReturns returns_;
};

namespace detail {
// What a place and a velocity look like from the sensor, and the derivative by (place, velocity). p.z > 0.
Vec6 bearing_of(const Vec3& p_m, const Vec3& v_mps);
Mat6 bearing_jacobian(const Vec3& p_m, const Vec3& v_mps);
}  // namespace detail

}  // namespace lasso
