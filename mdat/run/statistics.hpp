// Errors of poses against the truth, and what is said about many of them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "fsw/geometry/se3.hpp"
#include "fsw/mode/modes.hpp"
#include "fsw/pose/scan/result.hpp"
#include "fsw/sense/sensor_chooser.hpp"
#include "mdat/run/bound.hpp"
#include "mdat/run/protection_level.hpp"
#include "mdat/run/time_to_alert.hpp"

namespace lasso::mdat {

constexpr double kLostTranslation_m = 0.050;
constexpr double kLostRotation_rad = 5 * kRadPerDeg;

// One estimate against the truth at the same time.
struct PoseError {
  Vec3 translation_m = Vec3::Zero();   // estimate - truth, sensor axes
  Vec3 yaw_pitch_roll = Vec3::Zero();  // rad, ZYX Euler angles of R_true^T R_estimated: roll is about the target's x axis
  double rotation_rad = 0;             // the whole angle
  double axial_m = 0;                  // of the translation, along the target's x axis

  bool lost() const { return translation_m.norm() > kLostTranslation_m || rotation_rad > kLostRotation_rad; }
};
PoseError pose_error(const Pose& estimate, const Pose& truth);

// Normalised estimation error squared of (rotation, translation) in sensor axes; 6 on average when `covariance` is honest. Infinite where
// the covariance is not positive definite.
double nees(const Pose& estimate, const Pose& truth, const Mat6& covariance);

// One frame of a run.
struct FrameError {
  std::uint32_t frame = 0;  // since its start
  double t_s = 0;           // since frame 0: of the scan's reference time, or, where nothing is reported, of the frame's begin
  double range_m = 0;       // the true one, of the target's origin
  TrackingMode mode = TrackingMode::kStandby;
  PoseReason reason = PoseReason::kNoScan;
  SensorNumber sensor = 0;
  std::uint8_t part = 0;  // 0: the whole
  std::uint16_t returns = 0, inliers = 0;
  double sigma_m = 0, sigma_rad = 0;  // of the registration: roots of the traces of its covariance
  ProtectionLevels level;             // of the registration
  bool told = false;                  // a packet says its mode and reason
  bool reported = false;              // a registration of this frame's scan is in the telemetry
  bool valid = false;                 // and it says that it can be trusted
  bool wrong = false;                 // and it, or the filter, cannot (verdict.hpp)
  PoseError registration, filtered;
  double nees = 0;
  PoseBound bound;
  double estimate_us = 0;
  double omega_error_radps = 0, v_error_mps = 0;  // of the filter's rates: norms

  bool lost() const { return !reported || registration.lost(); }
  bool misleads_about_position() const { return valid && registration.translation_m.norm() > level.position_m; }
  bool misleads_about_attitude() const { return valid && registration.rotation_rad > level.attitude_rad; }
};

struct MeanStd {
  double mean = 0, std = 0;
};

struct ErrorStatistics {
  MeanStd x_mm, y_mm, z_mm, yaw_deg, pitch_deg, roll_deg;
  MeanStd axial_mm;                // along the target's x axis
  double rms_mm = 0, rms_deg = 0;  // of the norms
};

struct TimeStatistics {
  double median_us = 0, p99_us = 0, max_us = 0;
};

// A run once its filter has settled, and how well it then knows the rates: over all frames that are reported, tracked or not.
struct SettledStatistics {
  std::size_t frames = 0, lost = 0, invalid = 0;  // as RunStatistics'
  double rms_degps = 0, rms_mmps = 0, worst_degps = 0, worst_mmps = 0;
};

constexpr std::size_t kSettlingFrames = 20;  // of a run, from its start on

struct RunStatistics {
  std::size_t frames = 0, lost = 0, invalid = 0, wrong = 0;
  ErrorStatistics registration, filtered;  // lost frames left out (each by its own error)
  double crlb_mm = 0, crlb_deg = 0;  // root of the mean trace, over frames that are not lost; not a number where one of them has no bound
  double nees = 0;                   // mean
  double omega_rms_degps = 0, v_rms_mmps = 0;
  SettledStatistics settled;  // of one run, or of several
  AlertTimes alert;           // the same
  ProtectionStatistics protection;
  TimeStatistics time;
};

MeanStd mean_std(const std::vector<double>& values);  // of the whole population (division by n); 0 of nothing
ErrorStatistics error_statistics(const std::vector<PoseError>& errors);
TimeStatistics time_statistics(std::vector<double> times_us);  // percentiles by nearest rank; the lower median
SettledStatistics settled_statistics(const std::vector<FrameError>& frames);
ProtectionStatistics protection_statistics(const std::vector<FrameError>& frames);
RunStatistics run_statistics(const std::vector<FrameError>& frames);  // without `settled` and `alert`: where a run began, the caller knows

// Times to alert of a run that ended at `end_s`.
AlertTimes alert_times(const std::vector<FrameError>& run, double end_s);

// The frames of a run after the first kSettlingFrames.
std::vector<FrameError> settled_frames(const std::vector<FrameError>& run);

}  // namespace lasso::mdat
