#include "mdat/run/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fsw/geometry/symmetric6.hpp"

namespace lasso::mdat {
namespace {

template <class Items, class Function>
MeanStd mean_std_of(const Items& items, double scale, const Function& value) {
  std::vector<double> values;
  values.reserve(items.size());
  for (const auto& item : items) values.push_back(scale * value(item));
  return mean_std(values);
}

// Of nothing, nothing is known: not a number, null in results.json.
double mean(double sum, std::size_t n) { return n == 0 ? std::numeric_limits<double>::quiet_NaN() : sum / static_cast<double>(n); }
double root_mean(double sum, std::size_t n) { return std::sqrt(mean(sum, n)); }

double nearest_rank(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return 0;
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted[std::max<std::size_t>(rank, 1) - 1];
}

LevelStatistics level_statistics(std::vector<double> levels, std::size_t misleading) {
  LevelStatistics result;
  result.misleading = misleading;
  if (levels.empty()) return result;
  std::sort(levels.begin(), levels.end());
  result.median = nearest_rank(levels, 0.5);
  result.worst = levels.back();
  return result;
}

struct Sums {
  std::size_t tracked = 0, valid = 0, bounded = 0;
  double bound_m2 = 0, bound_rad2 = 0, nees = 0, omega2 = 0, v2 = 0;

  void add(const FrameError& frame) {
    ++tracked;
    if (frame.valid) {
      ++valid;  // what is refused is nobody's to trust
      nees += frame.nees;
    }
    omega2 += frame.omega_error_radps * frame.omega_error_radps;
    v2 += frame.v_error_mps * frame.v_error_mps;
    if (!frame.bound.defined) return;
    ++bounded;
    bound_m2 += frame.bound.translation_m2;
    bound_rad2 += frame.bound.rotation_rad2;
  }
};

}  // namespace

PoseError pose_error(const Pose& estimate, const Pose& truth) {
  const Vec6 difference = pose_difference(estimate, truth);
  PoseError error;
  error.translation_m = difference.tail<3>();
  error.rotation_rad = difference.head<3>().norm();
  error.axial_m = rotate(truth.q, Vec3::UnitX()).dot(error.translation_m);
  error.yaw_pitch_roll = euler_zyx(to_matrix(truth.q).transpose() * to_matrix(estimate.q));
  return error;
}

double nees(const Pose& estimate, const Pose& truth, const Mat6& covariance) {
  const Vec6 difference = pose_difference(estimate, truth);
  const Vec6 sigma = covariance.diagonal().cwiseMax(0).cwiseSqrt();
  if (!(sigma.minCoeff() > 0)) return std::numeric_limits<double>::infinity();
  const Vec6 scale = sigma.cwiseInverse();  // metres and radians side by side
  const Mat6 correlation = scale.asDiagonal() * covariance * scale.asDiagonal();
  const Vec6 scaled = scale.cwiseProduct(difference);
  Vec6 solution;
  if (solve6(correlation, scaled, solution) != Status::kOk) return std::numeric_limits<double>::infinity();
  return scaled.dot(solution);
}

MeanStd mean_std(const std::vector<double>& values) {
  if (values.empty()) return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  const double n = static_cast<double>(values.size());
  double sum = 0;
  for (const double value : values) sum += value;
  MeanStd result{sum / n, 0};
  double squares = 0;
  for (const double value : values) squares += (value - result.mean) * (value - result.mean);
  result.std = std::sqrt(squares / n);
  return result;
}

ErrorStatistics error_statistics(const std::vector<PoseError>& errors) {
  constexpr double kMm = 1e3, kDeg = 1 / kRadPerDeg;
  ErrorStatistics result;
  MeanStd* const lengths[] = {&result.x_mm, &result.y_mm, &result.z_mm};
  MeanStd* const angles[] = {&result.yaw_deg, &result.pitch_deg, &result.roll_deg};
  for (int i = 0; i < 3; ++i) {
    *lengths[i] = mean_std_of(errors, kMm, [i](const PoseError& e) { return e.translation_m[i]; });
    *angles[i] = mean_std_of(errors, kDeg, [i](const PoseError& e) { return e.yaw_pitch_roll[i]; });
  }
  result.axial_mm = mean_std_of(errors, kMm, [](const PoseError& e) { return e.axial_m; });
  double squares_m2 = 0, squares_rad2 = 0;
  for (const PoseError& error : errors) {
    squares_m2 += error.translation_m.squaredNorm();
    squares_rad2 += error.rotation_rad * error.rotation_rad;
  }
  result.rms_mm = kMm * root_mean(squares_m2, errors.size());
  result.rms_deg = kDeg * root_mean(squares_rad2, errors.size());
  return result;
}

TimeStatistics time_statistics(std::vector<double> times_us) {
  std::sort(times_us.begin(), times_us.end());
  return {nearest_rank(times_us, 0.5), nearest_rank(times_us, 0.99), nearest_rank(times_us, 1)};
}

SettledStatistics settled_statistics(const std::vector<FrameError>& frames) {
  SettledStatistics result;
  double omega2 = 0, v2 = 0;
  std::size_t reported = 0;
  for (const FrameError& frame : frames) {
    ++result.frames;
    result.lost += frame.lost() ? 1U : 0U;
    result.invalid += frame.valid ? 0U : 1U;
    if (!frame.reported) continue;
    ++reported;
    omega2 += frame.omega_error_radps * frame.omega_error_radps;
    v2 += frame.v_error_mps * frame.v_error_mps;
    result.worst_degps = std::max(result.worst_degps, frame.omega_error_radps / kRadPerDeg);
    result.worst_mmps = std::max(result.worst_mmps, 1e3 * frame.v_error_mps);
  }
  result.rms_degps = root_mean(omega2, reported) / kRadPerDeg;
  result.rms_mmps = 1e3 * root_mean(v2, reported);
  return result;
}

ProtectionStatistics protection_statistics(const std::vector<FrameError>& frames) {
  ProtectionStatistics result;
  std::vector<double> position_mm, attitude_deg;
  std::size_t about_position = 0, about_attitude = 0;
  for (const FrameError& frame : frames) {
    if (!frame.valid) continue;
    ++result.poses;
    position_mm.push_back(1e3 * frame.level.position_m);
    attitude_deg.push_back(frame.level.attitude_rad / kRadPerDeg);
    about_position += frame.misleads_about_position() ? 1U : 0U;
    about_attitude += frame.misleads_about_attitude() ? 1U : 0U;
    result.misleading += frame.misleads_about_position() || frame.misleads_about_attitude() ? 1U : 0U;
  }
  result.position_mm = level_statistics(std::move(position_mm), about_position);
  result.attitude_deg = level_statistics(std::move(attitude_deg), about_attitude);
  return result;
}

AlertTimes alert_times(const std::vector<FrameError>& run, double end_s) {
  std::vector<JudgedFrame> judged;
  judged.reserve(run.size());
  for (const FrameError& frame : run) judged.push_back({frame.t_s, frame.wrong});
  AlertTimes times;
  times.add(wrong_episodes(judged, end_s));
  return times;
}

std::vector<FrameError> settled_frames(const std::vector<FrameError>& run) {
  return {run.begin() + static_cast<std::ptrdiff_t>(std::min(kSettlingFrames, run.size())), run.end()};
}

RunStatistics run_statistics(const std::vector<FrameError>& frames) {
  RunStatistics result;
  Sums sums;
  std::vector<PoseError> registrations, filtered;
  std::vector<double> times_us;
  for (const FrameError& frame : frames) {
    ++result.frames;
    result.lost += frame.lost() ? 1U : 0U;
    result.invalid += frame.valid ? 0U : 1U;
    result.wrong += frame.wrong ? 1U : 0U;
    if (frame.reported && !frame.filtered.lost()) filtered.push_back(frame.filtered);
    if (frame.reported) times_us.push_back(frame.estimate_us);
    if (frame.lost()) continue;
    registrations.push_back(frame.registration);
    sums.add(frame);
  }
  result.registration = error_statistics(registrations);
  result.filtered = error_statistics(filtered);
  const std::size_t bounded = sums.bounded == sums.tracked ? sums.bounded : 0;  // errors of frames without a bound stand over no other's
  result.crlb_mm = 1e3 * root_mean(sums.bound_m2, bounded);
  result.crlb_deg = root_mean(sums.bound_rad2, bounded) / kRadPerDeg;
  result.nees = mean(sums.nees, sums.valid);
  result.omega_rms_degps = root_mean(sums.omega2, sums.tracked) / kRadPerDeg;
  result.v_rms_mmps = 1e3 * root_mean(sums.v2, sums.tracked);
  result.protection = protection_statistics(frames);
  result.time = time_statistics(std::move(times_us));
  return result;
}

}  // namespace lasso::mdat
