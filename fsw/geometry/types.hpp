// The only door to Eigen for the flight component: fixed-size double types, never vectorised (same bits on every target).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace lasso {

using Vec3 = Eigen::Matrix<double, 3, 1>;
using Mat3 = Eigen::Matrix<double, 3, 3>;
using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using CommonErrors = Eigen::Matrix<double, 6, 4>;  // of a pose: what each error that a scan has in common does to it
using Quat = Eigen::Quaternion<double>;            // Hamilton, scalar last in memory

// Three numbers of any type.
template <class V>
inline Vec3 to_vec3(const V* v) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

}  // namespace lasso
