// How wrong a pose of a symmetric target is: the least over the true pose and those that look the same.
#pragma once

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/se3.hpp"
#include "mdat/missiondb/exact_symmetry.hpp"

namespace lasso::mdat {

struct SymmetricError {
  double squared = 0;  // normalised error squared, the least of all images; where the covariance is honest 6 in the mean (see below)
  double translation_m = 0, rotation_rad = 0;  // of the target's origin, and the whole angle, against the image that is turned least
};

// `covariance` of (rotation, translation) in sensor axes. A round target's axis has any angle about it: the least is found to a hundredth
// of a degree within 20 deg of the angle that fits best, and 5 directions are left: 5 in the mean. Of a sphere only the centre's place
// counts: 3. Where images lie within the covariance of each other the least of them is less than 6.
SymmetricError symmetric_error(const Pose& estimate, const Pose& truth, const Mat6& covariance, const ExactSymmetry& symmetry);

// Farther off than 1 deg or 1.5 % of the target's size, and by more than 5 of its own sigma.
constexpr double kWrongSquared = 25;
constexpr double kWrongShare = 0.015;
constexpr double kWrongTurn_rad = 1 * kRadPerDeg;
bool is_far(const SymmetricError& error, double size_m);
bool is_wrong(const SymmetricError& error, double size_m);

}  // namespace lasso::mdat
