// Other minima of the cost along an axis of the pose. A hull of flat sides has one a side, and one scan may not tell which is the right
// one. Each is sharp by itself: the information of the registration knows of its own alone. Costs and axes are those of profile.hpp.
#pragma once

#include "fsw/pose/registration/profile.hpp"

namespace lasso {

// Poses that explain a scan about as well as the best one: at a cost that is not higher by kRise.
struct Minima {
  Pose T_target_sensor;        // of the minima that do, the one nearest to the prediction along the axis
  bool is_elsewhere = false;   // it is not the one that was given
  bool are_apart = false;      // one is more than five sigmas off: the scan does not tell the place along the axis
  Mat6 spread = Mat6::Zero();  // what is not known of (rotation, translation) for all that, target axes: to be added to the covariance
};

// Looks at six places each way, a 30th of the radius apart, each fitted to the hits by a pass with the axis held. On either side the
// profile descends from the lowest of those that lie lower than their neighbours, unless that costs more, by kRise, than the costlier of
// the two first places: a minimum that explains the scan and is as sharp as the beginning lies within half of a place of one that costs
// less. It descends from the last place, too, if that costs less than the one before it by more than one return may cost. The last places
// count as well, as what lies beyond them is not looked at. What is apart may be one of many places round the body: the pose is anywhere
// within three radii (kUnobservableSigma) along the ways there, which tell how all else changes with the place. A minimum that is not apart
// adds its squared way. `from` is a minimum, and `sigma_m` that of the axis. Bound: 24 passes, and 3 x 20 for descents.
Minima find_minima(const Mission& mission, const CostedPose& from, double sigma_m, const Pose& predicted_T_target_sensor, Profile& profile);

}  // namespace lasso
