// The only door to Eigen for the flight component: fixed-size double types, never vectorised (same bits on every target).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace lasso {

using Vec3 = Eigen::Matrix<double, 3, 1>;
using Mat3 = Eigen::Matrix<double, 3, 3>;
using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using Quat = Eigen::Quaternion<double>;  // Hamilton, scalar last in memory

}  // namespace lasso
