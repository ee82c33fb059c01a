// The Cramer-Rao bound of a scan: the least variance that any unbiased estimate from its ranges can have.
#pragma once

#include <functional>
#include <span>

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/se3.hpp"
#include "fsw/sense/range_image.hpp"
#include "hal_sim/ray_caster.hpp"

namespace lasso::mdat {

constexpr double kBoundIncidenceMax_rad = 85 * kRadPerDeg;

struct PoseBound {
  bool defined = false;       // false: the scan leaves a direction open
  double translation_m2 = 0;  // trace of the bound's translation part (of the target's origin)
  double rotation_rad2 = 0;   // trace of its rotation part
};

// Fisher information of the hits' ranges at the true pose: each surface known (the plane of the triangle that the reported ray meets),
// directions exact, noise along the ray of standard deviation sigma_m(depth along the boresight), incidence up to kBoundIncidenceMax_rad.
// A range changes by (n.(v + w x p))/(n.u) when the target moves by v and turns by w about its origin; p is the point from that origin.
// The estimator takes rays up to estimation.incidence_max_deg (86 by preset), so that its errors may be a little below this bound.
PoseBound pose_bound(const sim::RayCaster& target, const Pose& T_sensor_target, std::span<const RangeSample> scan,
                     const std::function<double(double)>& sigma_m);

}  // namespace lasso::mdat
