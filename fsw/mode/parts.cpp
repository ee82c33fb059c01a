#include "fsw/mode/parts.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/symmetric6.hpp"
#include "fsw/pose/registration/integrity.hpp"
#include "fsw/pose/silhouette/information_forecast.hpp"

namespace lasso {
namespace {

// With x a step of the target's pose in sensor axes, (rotation, translation of the origin), M(lever) x is that of a point `lever` (sensor
// axes) away from the origin; M(-lever) is the way back.
Mat6 moved_by(const Vec3& lever) {
  Mat6 M = Mat6::Identity();
  M.bottomLeftCorner<3, 3>() = -skew(lever);
  return M;
}

Vec3 lever_of(const Part& part, const Pose& T_sensor_target) { return rotate(T_sensor_target.q, part.T_target_part.p); }

// Squared sigmas between the poses of two parts that disagree: of six sigmas and six degrees of freedom, 1 of 360,000 right pairs is
// farther apart (chi squared).
constexpr double kInconsistent = 6 * 6;
// For which a part is left out: afterwards the poses that contradicted it are not fresh any more.
constexpr std::uint32_t kRestScans = kFreshScans;

std::uint32_t end_of_rest(std::uint32_t scan_id) { return scan_id + 1 + kRestScans; }

bool is_fresh(const PartRecord& record, std::uint32_t scan_id) { return record.measured && scan_id - record.scan_id <= kFreshScans; }

// Squared distance of the two parts' poses in sigmas; 0 where their covariance has no meaning.
double distance2(const PartRecord& a, const PartRecord& b) {
  const Vec6 difference = a.off - b.off;
  Vec6 weighted;
  return solve6(unpack(a.covariance) + unpack(b.covariance), difference, weighted) == Status::kOk ? difference.dot(weighted) : 0;
}

// Who disagrees with whom.
struct Comparison {
  bool disagree[kMaxParts][kMaxParts] = {};
  int votes[kMaxParts] = {};         // against the part
  double farthest2[kMaxParts] = {};  // sigmas^2
};

void note_disagreement(std::size_t a, std::size_t b, double d2, Comparison& comparison) {
  comparison.disagree[a][b] = comparison.disagree[b][a] = true;
  for (const std::size_t i : {a, b}) {
    ++comparison.votes[i];
    if (d2 > comparison.farthest2[i]) comparison.farthest2[i] = d2;
  }
}

Comparison compare(const Parts& parts, const PartsState& state, std::uint32_t scan_id) {
  Comparison result;
  for (std::size_t a = 0; a < parts.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      if (!is_fresh(state.of[a], scan_id) || !is_fresh(state.of[b], scan_id)) continue;
      const double d2 = distance2(state.of[a], state.of[b]);
      if (d2 > kInconsistent) note_disagreement(a, b, d2, result);
    }
  }
  return result;
}

// Is part a less consistent than b?
bool is_less_consistent(const Parts& parts, const Comparison& comparison, std::size_t a, std::size_t b) {
  if (comparison.votes[a] != comparison.votes[b]) return comparison.votes[a] > comparison.votes[b];
  return parts[a].priority < parts[b].priority;
}

// The scanned part stands first, so that among equals it is the inconsistent one.
std::size_t find_inconsistent(const Parts& parts, const Comparison& comparison, std::size_t scanned) {
  std::size_t inconsistent = scanned;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (is_less_consistent(parts, comparison, i, inconsistent)) inconsistent = i;
  }
  return inconsistent;
}

void reinstate(const Parts& parts, const Comparison& comparison, std::size_t inconsistent, PartsState& state) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    PartRecord& record = state.of[i];
    if (!comparison.disagree[i][inconsistent] || comparison.votes[i] != 1 || !record.reported) continue;
    record.reported = false;
    record.rests_until = 0;
  }
}

bool sees(const Part& part, const Pose& T_sensor_part) {
  const Vec3 to_sensor = inverse(T_sensor_part).p - part.mission.center_m;
  const double range_m = square_root(to_sensor.squaredNorm());
  return range_m >= part.range_min_m && range_m <= part.range_max_m && part.view.dot(to_sensor) >= part.cone_cosine * range_m;
}

// Is the prediction so certain that the part lies within its registration's gate?
bool is_placed(const Part& part, const FilterState& predicted) {
  const Mat6 C = part_covariance(part, predicted);
  const double radius_m = part.mission.radius_m;
  const double gate_m = part.mission.parameters.gate_first_m;
  return radius_m * radius_m * C.topLeftCorner<3, 3>().trace() + C.bottomRightCorner<3, 3>().trace() < gate_m * gate_m;
}

// What a scan of the part will tell of the target's pose, sensor axes.
InformationForecast look_at(const Part& part, const Pose& T_sensor_target) {
  const Pose T_part_sensor = inverse(T_sensor_target * part.T_target_part);
  const View<FlightNumber> view = make_view(part.mission, T_part_sensor);
  InformationForecast forecast =
      forecast_information(part.mission, view, visible_outline(part.mission, view), part.mission.parameters.points);
  const Mat3 R = to_matrix(T_part_sensor.q);
  Mat6 to_part_axes = Mat6::Zero();
  to_part_axes.topLeftCorner<3, 3>() = R;
  to_part_axes.bottomRightCorner<3, 3>() = R;
  const Mat6 J = to_part_axes * moved_by(lever_of(part, T_sensor_target));
  forecast.information = J.transpose() * forecast.information * J;
  return forecast;
}

// The least certain direction: w.x is the displacement along it that a step x of the pose makes, in metres.
Vec6 weakest(const Mission& mission, const Mat6& C) {
  Vec6 direction = axes_at_radius(C, mission.radius_m).vectors.col(5);
  direction.head<3>() *= mission.radius_m;
  return direction;
}

struct Choice {
  PartNumber part = kWhole;
  bool waited = false;     // for kLongestWait scans
  std::uint32_t wait = 0;  // scans
  double gain = 0;
};

bool is_better(const Choice& a, const Choice& b) {
  if (b.part == kWhole) return true;
  if (a.waited != b.waited) return a.waited;
  return a.waited ? a.wait > b.wait : a.gain > b.gain;
}

// What is known after the scan in flight, and the direction that it leaves least certain.
struct Need {
  Mat6 information = Mat6::Zero();
  Mat6 covariance = Mat6::Zero();
  Vec6 w = Vec6::Zero();
};

// False where the prediction has no information. An inverse that fails leaves what was there before: the scan in flight then tells nothing.
bool find_need(const Mission& mission, const Parts& parts, const NextScan& next, Need& need) {
  if (!next.predicted.initialised) return false;
  need.covariance = next.predicted.covariance.topLeftCorner<6, 6>();
  if (invert6(need.covariance, need.information) != Status::kOk) return false;
  if (next.in_flight != kWhole) need.information += look_at(parts[next.in_flight - 1U], next.predicted.T_sensor_target).information;
  static_cast<void>(invert6(need.information, need.covariance));
  need.w = weakest(mission, need.covariance);
  return true;
}

// The share that the information takes off the variance of the least certain direction; 0 where the inverse fails.
double gain_of(const Need& need, const Mat6& information) {
  Mat6 after = need.covariance;
  static_cast<void>(invert6(need.information + information, after));
  return 1 - need.w.dot(after * need.w) / need.w.dot(need.covariance * need.w);
}

}  // namespace

PackedCovariance pack(const Mat6& covariance) {
  PackedCovariance packed;
  int term = 0;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) packed.terms[term++] = static_cast<float>(covariance(row, column));
  }
  return packed;
}

Mat6 unpack(const PackedCovariance& packed) {
  Mat6 covariance;
  const float* term = packed.terms;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) covariance(row, column) = covariance(column, row) = static_cast<double>(*term++);
  }
  return covariance;
}

Mat6 part_covariance(const Part& part, const FilterState& filter) {
  const Mat6 M = moved_by(lever_of(part, filter.T_sensor_target));
  return M * relative_covariance(filter) * M.transpose();
}

bool rests(const PartRecord& record, std::uint32_t scan_id) { return scan_id < record.rests_until; }

Registration register_part(const Mission& mission, const Part& part, Estimator& estimator, const RangeImage& scan,
                           const FilterState& predicted) {
  StartPoint start;
  start.T_sensor_target = predicted.T_sensor_target * part.T_target_part;
  start.rates.omega_radps = predicted.rates.omega_radps;
  start.rates.v_mps = predicted.rates.v_mps + predicted.rates.omega_radps.cross(lever_of(part, predicted.T_sensor_target));
  start.rate_sigma_mps = rate_sigma(mission.radius_m, predicted);
  start.partial = true;
  Registration result = estimator.estimate(part.mission, scan, start);
  result.T_sensor_target = result.T_sensor_target * inverse(part.T_target_part);
  const Mat6 back = moved_by(-lever_of(part, result.T_sensor_target));
  result.covariance = back * result.covariance * back.transpose();
  result.common = back * result.common;
  if (result.weakest_sigma_m > 0) find_weak_directions(mission, result);  // they were found in the part's frame
  return result;
}

void refuse_part(std::uint32_t scan_id, PartRecord& record) {
  record.measured = false;
  record.rests_until = end_of_rest(scan_id);
}

PoseReason compare_parts(const Parts& parts, const Registration& registration, const FilterState& predicted, PartsState& state,
                         PartsReport& report) {
  const std::size_t scanned = report.scanned - 1U;
  const std::uint32_t scan_id = registration.scan_id;
  const std::uint32_t rests_until = end_of_rest(scan_id);
  PartRecord& record = state.of[scanned];
  if (!registration.valid()) {
    record.rests_until = rests_until;
    return registration.reason;
  }
  record.measured = true;
  record.reported = false;
  record.scan_id = scan_id;
  record.off = pose_difference(registration.T_sensor_target, predicted.T_sensor_target);
  const Mat6 own = registration.covariance - registration.common * registration.common.transpose();
  record.covariance = pack(own + relative_covariance(predicted));
  const Comparison comparison = compare(parts, state, scan_id);
  const std::size_t inconsistent = find_inconsistent(parts, comparison, scanned);
  if (comparison.votes[inconsistent] == 0) return PoseReason::kValid;
  reinstate(parts, comparison, inconsistent, state);
  if (!state.of[inconsistent].reported) {
    report.inconsistent = static_cast<PartNumber>(inconsistent + 1);
    report.inconsistency_sigmas = square_root(comparison.farthest2[inconsistent]);
    state.of[inconsistent].reported = true;
    state.of[inconsistent].rests_until = rests_until;
  }
  return inconsistent == scanned ? PoseReason::kPartDisagrees : PoseReason::kValid;
}

PartNumber choose_part(const Mission& mission, const Parts& parts, const NextScan& next, PartsState& state) {
  Need need;
  if (!find_need(mission, parts, next, need)) return kWhole;
  Choice best;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const PartRecord& record = state.of[i];
    const Part& part = parts[i];
    if (rests(record, next.scan_id) || !is_placed(part, next.predicted)) continue;
    if (!sees(part, next.predicted.T_sensor_target * part.T_target_part)) continue;
    const InformationForecast forecast = look_at(part, next.predicted.T_sensor_target);
    if (forecast.met < kLeastMet) continue;
    Choice choice;
    choice.part = static_cast<PartNumber>(i + 1);
    choice.wait = next.scan_id - record.last_asked_id;
    choice.waited = choice.wait > kLongestWait;
    choice.gain = part.priority * gain_of(need, forecast.information);
    if (is_better(choice, best)) best = choice;
  }
  if (best.part != kWhole) state.of[best.part - 1U].last_asked_id = next.scan_id;
  return best.part;
}

}  // namespace lasso
