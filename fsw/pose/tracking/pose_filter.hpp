// The filter of pose and rates: a multiplicative extended Kalman filter that joins the registrations of single scans. It gives the filtered
// pose, the rates, and the prediction from which the next registration starts.
//
// The state is the explicit struct FilterState; nothing else is kept. Its error is, in sensor axes,
//   (rotation [rad], translation of the target's origin [m], angular velocity [rad/s], velocity of the origin [m/s]),
// with estimate.q = exp(rotation) * truth.q and all others estimate - truth: the rotation and translation of pose_difference(). The
// quaternion itself is never filtered, so that it keeps its length and its sign (Markley & Crassidis 2014, chapter 6, for this family).
//
// Motion model: constant angular velocity and constant velocity of the origin in sensor axes, disturbed by accelerations that are constant
// over each step, independent between steps, and of the given sigmas (discrete white-noise acceleration). The measurement is a registration
// of one scan, independent of the prediction (never one into which the prediction entered as a prior). A direction that the scan does not
// show has a large variance in it and coasts on the prediction.
//
// What a scan's rays have in common (a calibration that is off, say) does not average out. Such errors are consider states c, of variance 1
// each: they are not estimated, but their covariance with the state's error is carried along (Schmidt 1966; Woodbury & Junkins 2010). They
// are a first-order Gauss-Markov process, with its own memory. Without memory they are fresh noise of each scan.
//
// Every function leaves the state as it was unless it returns kOk. Fixed size, no loops beyond the matrices' sizes (12).
#pragma once

#include <cstdint>

#include "fsw/core/status.hpp"
#include "fsw/core/time.hpp"
#include "fsw/geometry/se3.hpp"
#include "fsw/geometry/types.hpp"

namespace lasso {

using Mat12 = Eigen::Matrix<double, 12, 12>;

constexpr DurationUs kMaxPredictionUs = 1'000'000'000;  // longest step of the filter
constexpr double kMaxStepRotationRad = 1e4;             // most rotation of one step: far beyond any use, inside sin_cos's domain
constexpr double kNoGate = 0;
constexpr double kLeastInnovationRatio = 1.0 / 64;  // of a variance: an eighth of the claimed sigma

struct FilterState {
  // By call: unrolled wherever a state is copied, its numbers took 6 kB of the flight image.
  FilterState();
  FilterState(const FilterState& other);
  FilterState& operator=(const FilterState& other);

  TimeUs t_us = 0;  // at which pose, rates and covariance are stated
  Pose T_sensor_target;
  Twist rates;
  Mat12 covariance = Mat12::Zero();  // order: rotation, translation, angular velocity, velocity
  // How far predictions were off, over the variance that they claimed: rotation and translation, axis by axis, [kLeastInnovationRatio, 1].
  // It rises at once and falls slowly. The filter does not use it.
  Vec6 innovation_ratio = Vec6::Ones();
  CommonErrors common_pose = CommonErrors::Zero();   // covariance of the pose's error with the common errors, column by column
  CommonErrors common_rates = CommonErrors::Zero();  // of the rates' error
  bool initialised = false;
  std::uint32_t accepted = 0;  // measurements since the start
  std::uint32_t rejected = 0;  // by the gate
};

struct FilterStart {
  TimeUs t_us = 0;
  Pose T_sensor_target;
  Twist rates;
  Mat6 pose_covariance = Mat6::Zero();  // (rotation, translation), as a registration gives it
  double sigma_omega_radps = 0;         // each axis, > 0
  double sigma_v_mps = 0;               // each axis, > 0
};

// A free body that turns about no principal axis changes its angular velocity by at most half of omega^2 (a rod, or a disc), and not at all
// at rest: precession's share of omega^2 adds to the other.
struct FilterNoise {
  double acceleration_mps2 = 0;            // 1 sigma, each axis, >= 0
  double angular_acceleration_radps2 = 0;  // 1 sigma, each axis, >= 0
  double precession = 0;                   // 1 sigma, each axis, of omega^2, >= 0
  double common_memory_s = 0;              // in which the correlation of common errors falls to 1/e, >= 0
};

// A registration: pose at t_us with the covariance of (rotation in sensor axes [rad], translation of the origin [m]).
struct PoseMeasurement {
  TimeUs t_us = 0;
  Pose T_sensor_target;
  Mat6 covariance = Mat6::Zero();
  CommonErrors common =
      CommonErrors::Zero();  // what each common error of 1 sigma does to the pose, column by column; `covariance` holds it, too
};

struct FilterUpdate {
  Status status = Status::kOk;
  bool accepted = false;  // false with kOk: the gate kept it out
  double nis = 0;         // normalised innovation squared: chi^2 with 6 degrees of freedom when the filter is honest
};

struct PredictedPose {
  Pose T_sensor_target;
  Twist rates;
};

// Starts, or starts again, from a pose. kNotFinite; kBadValue: quaternion not of unit length, a sigma not above 0, a covariance that is not
// symmetric with positive variances and correlations within [-1, 1].
Status start_filter(FilterState& state, const FilterStart& from);

// Moves the state to t_us >= state.t_us. kNoData: not started; kBadOrder: time goes back; kBadValue: step longer than kMaxPredictionUs or
// kMaxStepRotationRad, or negative sigmas; kNotFinite: sigmas, or a covariance that has grown out of all bounds.
Status predict_filter(FilterState& state, TimeUs t_us, const FilterNoise& noise);

// Joins a measurement to the state, at the state's own time (predict first). With gate > 0 a measurement whose nis exceeds it is counted as
// rejected and changes nothing else (22.46: one in a thousand of the honest ones). kNoData: not started; kBadOrder: another time;
// kNotFinite, kBadValue: pose, covariance (as for start_filter) or gate; kNotFinite: a nis that overflows; kSingular: innovation covariance
// without an inverse.
// Covariance by Joseph's form: symmetric and positive for any gain (Bucy & Joseph 1968).
FilterUpdate update_filter(FilterState& state, const PoseMeasurement& measured, double gate_nis);

// Pose and rates at t_us >= state.t_us, the state untouched. Answers as predict_filter; `predicted` is written with kOk only.
Status predict_pose(const FilterState& state, TimeUs t_us, PredictedPose& predicted);

// How an error of the state grows over dt to first order: error(t + dt) = F error(t). The attitude's own error turns with the target; an
// error of the angular velocity enters through the left Jacobian of the step's rotation (Barfoot 2017, 7.1.5).
Mat12 error_transition(const Vec3& omega_radps, double dt_s);

// Of another sensor's scans: their common errors are none of those before. The covariance stays.
void forget_common_errors(FilterState& state);

// The covariance of the pose for given common errors: P - X X^T, with X = common_pose. A scan has about the errors of the one before, where
// they last: by this the prediction differs from what it will measure.
Mat6 relative_covariance(const FilterState& state);

// How far the rates may be off (1 sigma), as the velocity along any axis of a point that far from the target's origin: mean of the axes.
double rate_sigma(double radius_m, const FilterState& state);

// Are its numbers some: a pose that is finite, variances that are not negative, common errors that explain no more than them? A state that
// has gone astray by itself still is; only scans tell that.
bool is_sound(const FilterState& state);

}  // namespace lasso
