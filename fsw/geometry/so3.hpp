// Rotations. Quaternions are Hamilton, scalar last; q and -q are one rotation, and no function flips a sign silently.
#pragma once

#include "fsw/geometry/types.hpp"

namespace lasso {

Mat3 skew(const Vec3& v);                // skew(v) * w = v x w
Quat exp_so3(const Vec3& rotation_rad);  // rotation vector to unit quaternion
Vec3 log_so3(const Quat& q);             // unit quaternion to rotation vector, |result| <= pi
Quat normalized(const Quat& q);          // unit length; a zero quaternion gives identity
Mat3 to_matrix(const Quat& q);           // q of unit length
Quat to_quaternion(const Mat3& R);       // R orthonormal, right-handed (Shepperd's method)
Vec3 rotate(const Quat& q, const Vec3& v);
// ZYX Euler angles (yaw, pitch, roll) with R = Rz(yaw) Ry(pitch) Rx(roll); pitch in [-pi/2, pi/2], where yaw is 0 at its ends.
Vec3 euler_zyx(const Mat3& R);

}  // namespace lasso
