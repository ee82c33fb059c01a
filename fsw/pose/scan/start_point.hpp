// Where an estimate starts.
#pragma once

#include "fsw/geometry/se3.hpp"

namespace lasso {

// The prediction for the scan's reference time.
struct StartPoint {
  Pose T_sensor_target;
  Twist rates;  // for moving the points to the reference time (estimation.deskew)
  bool wide =
      false;  // a rough start (20 deg, a quarter of the model's size): where the near registration fails, centroid, far field and slides
  double rate_sigma_mps = 0;  // how far the rates may be off, as a velocity at the model's radius along any axis (1 sigma)
  bool partial = false;       // the model is a part of what is scanned: a return that meets none of it does not count against the pose
  bool tracked = false;       // predicted by a track: a pose far from it may be wrong (minimise_weak_axis). A start alone says less
};

}  // namespace lasso
