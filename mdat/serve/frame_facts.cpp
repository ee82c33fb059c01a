#include "mdat/serve/frame_facts.hpp"

#include <cmath>
#include <iterator>
#include <limits>

#include "fsw/pose/scan/result.hpp"
#include "mdat/run/case.hpp"
#include "mdat/run/verdict.hpp"

namespace lasso::mdat::serve {
namespace {

constexpr double kMm = 1e3, kDeg = 1 / kRadPerDeg;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

double error_of(const std::optional<PoseError>& error, double (*of)(const PoseError&)) { return error ? of(*error) : kUnknown; }

double sigma(const FrameFacts& facts, int first, double scale) {
  if (!facts.registered) return kUnknown;
  double trace = 0;
  for (int i = first; i < first + 3; ++i) trace += facts.covariance(i, i);
  return scale * std::sqrt(trace);
}

double filter_sigma(const float (&sigmas)[kPoseSigmas], std::size_t first, double scale) {
  double squared = 0;
  for (std::size_t i = first; i < first + 3; ++i) squared += static_cast<double>(sigmas[i]) * static_cast<double>(sigmas[i]);
  return scale * std::sqrt(squared);
}

double true_position(const FrameFacts& facts, int axis) { return facts.truth ? facts.truth->p[axis] : kUnknown; }

using Registered = const PoseError&;

struct Fact {
  const char *id, *label, *unit, *topic, *group;
  double (*of)(const FrameFacts&);
};
// clang-format off
constexpr Fact kFacts[] = {
  {"error.position", "position error of the registration", "mm", "/truth", "accuracy", [](const FrameFacts& f) { return error_of(f.registration, [](Registered e) { return kMm * e.translation_m.norm(); }); }},
  {"error.angle", "angle error of the registration", "deg", "/truth", "accuracy", [](const FrameFacts& f) { return error_of(f.registration, [](Registered e) { return kDeg * e.rotation_rad; }); }},
  {"error.normalised_squared", "normalised error squared of the registration (NEES): 6 in the mean, if its covariance is honest", "1", "/truth", "accuracy", [](const FrameFacts& f) { return f.registration ? f.normalised_squared : kUnknown; }},
  {"error.x", "position error of the registration, x to the right", "mm", "/truth", "accuracy", [](const FrameFacts& f) { return error_of(f.registration, [](Registered e) { return kMm * e.translation_m[0]; }); }},
  {"error.y", "position error of the registration, y downwards", "mm", "/truth", "accuracy", [](const FrameFacts& f) { return error_of(f.registration, [](Registered e) { return kMm * e.translation_m[1]; }); }},
  {"error.z", "position error of the registration, z along the boresight", "mm", "/truth", "accuracy", [](const FrameFacts& f) { return error_of(f.registration, [](Registered e) { return kMm * e.translation_m[2]; }); }},
  {"error.yaw", "angle error of the registration, yaw about the target's z", "deg", "/truth", "accuracy", [](const FrameFacts& f) { return error_of(f.registration, [](Registered e) { return kDeg * e.yaw_pitch_roll[0]; }); }},
  {"error.pitch", "angle error of the registration, pitch about the target's y", "deg", "/truth", "accuracy", [](const FrameFacts& f) { return error_of(f.registration, [](Registered e) { return kDeg * e.yaw_pitch_roll[1]; }); }},
  {"error.roll", "angle error of the registration, roll about the target's x", "deg", "/truth", "accuracy", [](const FrameFacts& f) { return error_of(f.registration, [](Registered e) { return kDeg * e.yaw_pitch_roll[2]; }); }},
  {"error.filtered_position", "position error of the filter", "mm", "/truth", "accuracy", [](const FrameFacts& f) { return error_of(f.filtered, [](Registered e) { return kMm * e.translation_m.norm(); }); }},
  {"error.filtered_angle", "angle error of the filter", "deg", "/truth", "accuracy", [](const FrameFacts& f) { return error_of(f.filtered, [](Registered e) { return kDeg * e.rotation_rad; }); }},
  {"error.wrong", "valid, and wrong: off by more than 5 sigma, and by more than 20 mm or 1 deg", "1", "/truth", "accuracy", [](const FrameFacts& f) { return f.wrong ? (*f.wrong ? 1.0 : 0.0) : kUnknown; }},
  {"sigma.position", "sigma of the registration's position (root of the trace)", "mm", "/packets", "uncertainty", [](const FrameFacts& f) { return sigma(f, 3, kMm); }},
  {"sigma.angle", "sigma of the registration's attitude (root of the trace)", "deg", "/packets", "uncertainty", [](const FrameFacts& f) { return sigma(f, 0, kDeg); }},
  {"sigma.filtered_position", "sigma of the filter's position (root of the trace)", "mm", "/packets", "uncertainty", [](const FrameFacts& f) { return filter_sigma(f.told.filter_sigma_pose, 3, kMm); }},
  {"sigma.filtered_angle", "sigma of the filter's attitude (root of the trace)", "deg", "/packets", "uncertainty", [](const FrameFacts& f) { return filter_sigma(f.told.filter_sigma_pose, 0, kDeg); }},
  {"sigma.weakest", "largest sigma of any direction, rotation times the model's radius", "mm", "/packets", "uncertainty", [](const FrameFacts& f) { return kMm * static_cast<double>(f.told.weakest_sigma_m); }},
  {"residual.rms", "rms of the range residuals of the inliers", "mm", "/packets", "registration", [](const FrameFacts& f) { return f.registered ? kMm * static_cast<double>(f.told.rms_m) : kUnknown; }},
  {"range.estimate", "range of the target's origin, filtered", "m", "/packets", "range", [](const FrameFacts& f) { return Vec3(f.told.filter_p_sensor_target_m).norm(); }},
  {"range.true", "range of the target's origin, true", "m", "/truth", "range", [](const FrameFacts& f) { return f.truth ? f.truth->p.norm() : kUnknown; }},
  {"rate.angular", "angular rate, filtered: norm", "deg/s", "/packets", "rates", [](const FrameFacts& f) { return kDeg * Vec3(f.told.filter_omega_radps).norm(); }},
  {"rate.linear", "velocity of the target's origin, filtered: norm", "mm/s", "/packets", "rates", [](const FrameFacts& f) { return kMm * Vec3(f.told.filter_v_mps).norm(); }},
  {"truth.x", "true position of the target's origin, x to the right", "m", "/truth", "pose", [](const FrameFacts& f) { return true_position(f, 0); }},
  {"truth.y", "true position of the target's origin, y downwards", "m", "/truth", "pose", [](const FrameFacts& f) { return true_position(f, 1); }},
  {"truth.z", "true position of the target's origin, z along the boresight", "m", "/truth", "pose", [](const FrameFacts& f) { return true_position(f, 2); }},
  {"truth.qx", "true attitude, quaternion x", "1", "/truth", "pose", [](const FrameFacts& f) { return f.truth ? f.truth->q.x() : kUnknown; }},
  {"truth.qy", "true attitude, quaternion y", "1", "/truth", "pose", [](const FrameFacts& f) { return f.truth ? f.truth->q.y() : kUnknown; }},
  {"truth.qz", "true attitude, quaternion z", "1", "/truth", "pose", [](const FrameFacts& f) { return f.truth ? f.truth->q.z() : kUnknown; }},
  {"truth.qw", "true attitude, quaternion w", "1", "/truth", "pose", [](const FrameFacts& f) { return f.truth ? f.truth->q.w() : kUnknown; }},
};
// clang-format on

}  // namespace

FrameFacts::FrameFacts(const PoseTelemetry& pose, const std::optional<Pose>& true_pose)
    : told(pose), truth(true_pose), covariance(registration_covariance(pose)) {
  registered = static_cast<StopReason>(pose.stop) != StopReason::kNotRun;
  if (!truth) return;
  filtered = pose_error(filtered_pose(pose), *truth);
  wrong = judge_valid(pose, *truth) == PoseVerdict::kWrong;
  if (!registered) return;
  registration = pose_error(registration_pose(pose), *truth);
  normalised_squared = nees(registration_pose(pose), *truth, covariance);
}

std::vector<Value> fact_values(std::size_t table) {
  std::vector<Value> values;
  for (const Fact& fact : kFacts) values.push_back({fact.id, fact.label, fact.unit, fact.topic, fact.group, table, values.size(), nullptr});
  return values;
}

void add_facts(double time_s, const FrameFacts& facts, ValueTable& table) {
  if (table.columns.empty()) table.columns.resize(std::size(kFacts));
  table.time_s.push_back(time_s);
  for (std::size_t i = 0; i < std::size(kFacts); ++i) table.columns[i].push_back(static_cast<float>(kFacts[i].of(facts)));
}

}  // namespace lasso::mdat::serve
