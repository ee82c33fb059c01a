// The pose of a frame on the target, stated in a frame on what carries the sensors.
#pragma once

#include "fsw/link/named_pose_report.hpp"
#include "fsw/mission/named_frame.hpp"
#include "fsw/pose/scan/result.hpp"
#include "fsw/pose/tracking/pose_filter.hpp"

namespace lasso {

// Covariance of T_in_of and its rates from that of T_sensor_target and its rates: (rotation, translation of the origin, angular velocity,
// velocity of the origin), errors as FilterState's, to first order. Of the origin of `of` speak position and velocity, in the axes of `in`.
Mat12 covariance_in(const NamedFrame& frame, const Pose& T_sensor_target, const Vec3& omega_radps, const Mat12& covariance);

// Rates of T_in_of: of the origin of `of`, in the axes of `in`, which stand still against the sensor.
Twist rates_in(const NamedFrame& frame, const Pose& T_sensor_target, const Twist& rates);

// Registration and filter of one scan. Which frame, and of how many, is left to the caller.
NamedPoseTelemetry make_named_pose_report(const NamedFrame& frame, const Registration& registration, const FilterState& filter);

}  // namespace lasso
