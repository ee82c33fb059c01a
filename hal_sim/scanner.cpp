#include "hal_sim/scanner.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "fsw/geometry/so3.hpp"
#include "fsw/sense/pattern.hpp"

namespace lasso::sim {
namespace {

// Two unit vectors across `u` (unit, z > 0) and across each other: the image's right and down for a ray along the boresight.
struct Across {
  Vec3 right;
  Vec3 down;
};
Across across(const Vec3& u) {
  const Vec3 right = Vec3::UnitY().cross(u).normalized();
  return {right, u.cross(right)};
}

RangeSample sample_of(const Vec3& direction, TimeUs t_us, RayState state, double range_m) {
  RangeSample sample;
  for (int axis = 0; axis < 3; ++axis) sample.direction[axis] = static_cast<float>(direction[axis]);
  sample.range_m = state == RayState::kHit ? static_cast<float>(range_m) : 0.0F;
  sample.t_us = t_us;
  sample.state = state;
  return sample;
}

// The direction that the sample will carry, in double: measuring along it makes the reported point exact.
Vec3 as_reported(const Vec3& direction) { return direction.cast<float>().cast<double>().normalized(); }

// What a ray from the sensor meets of a surface; the normal is in sensor axes.
RayHit cast_at(const RayCaster& surface, const Pose& T_sensor_surface, const Vec3& direction) {
  const Pose T_surface_sensor = inverse(T_sensor_surface);
  RayHit hit = surface.cast(T_surface_sensor.p, rotate(T_surface_sensor.q, direction));
  if (hit.hit) hit.normal = rotate(T_sensor_surface.q, hit.normal);
  return hit;
}

double quantised_m(double range_m, double step_m) { return step_m > 0 ? std::floor(range_m / step_m + 0.5) * step_m : range_m; }

}  // namespace

struct RaySimulator::Beam {
  Pose T_sensor_target;
  std::vector<Pose> T_sensor_others;
  Vec3 direction;  // along which the scanner truly looks
  RayDraws draws;
  CommonErrors common;
};

RaySimulator::RaySimulator(const RayCaster& target, const Trajectory& trajectory, const ScannerModel& model, std::uint64_t seed,
                           OtherBodies others)
    : target_(target),
      trajectory_(trajectory),
      others_(std::move(others)),
      model_(model),
      seed_(seed),
      common_(seed, model.common_memory_s) {
  sim::validate(model);
  cos_dropout_incidence_ = model.dropout_incidence_rad < kPi / 2 ? sin_cos(model.dropout_incidence_rad).cos : -1;
}

CommonErrors RaySimulator::common_errors(std::uint32_t scan_id, TimeUs t_us) const {
  return has_common_errors(model_) ? common_.at(scan_id, t_us) : CommonErrors{};
}

RayHit RaySimulator::cast(const Beam& beam, const Vec3& direction) const {
  RayHit nearest = cast_at(target_, beam.T_sensor_target, direction);
  for (std::size_t i = 0; i < others_.size(); ++i) {
    const RayHit hit = cast_at(*others_[i].surface, beam.T_sensor_others[i], direction);
    if (hit.hit && (!nearest.hit || hit.range_m < nearest.range_m)) nearest = hit;
  }
  return nearest;
}

RangeSample RaySimulator::measure(std::uint32_t scan_id, std::uint32_t ray, const Vec3& direction, TimeUs t_us) const {
  const Vec3 nominal = as_reported(direction);
  const CommonErrors common = common_errors(scan_id, t_us);
  // The reported ray is turned by the error against the one that is measured.
  const Vec3 pointed = rotate(exp_so3(-model_.common_sigma_rad * common.turn), nominal);
  Beam beam{trajectory_.pose_at(t_us), {}, pointed, draw(seed_, scan_id, ray), common};
  for (const OtherBody& other : others_) beam.T_sensor_others.push_back(other.motion->pose_at(t_us));
  if (beam.draws.outlier < model_.outlier_probability) {
    const double farthest_m = std::min(1.5 * beam.T_sensor_target.p.norm(), model_.range_max_m);
    const double range_m = model_.range_min_m + beam.draws.outlier_place * std::max(0.0, farthest_m - model_.range_min_m);
    return sample_of(direction, t_us, RayState::kHit, range_m);
  }
  const Across axes = across(pointed);
  const double sigma_rad = model_.sigma_angle_rad;
  if (sigma_rad > 0) {
    beam.direction = (pointed + sigma_rad * (beam.draws.tilt_x * axes.right + beam.draws.tilt_y * axes.down)).normalized();
  }
  const RayHit hit = cast(beam, beam.direction);
  const bool dark = t_us >= model_.dark_from_us && t_us < model_.dark_until_us;
  if (!hit.hit || dark || lost(hit, beam)) return sample_of(direction, t_us, RayState::kMiss, 0);
  if (hit.range_m < model_.range_min_m) return sample_of(direction, t_us, RayState::kInvalid, 0);
  const double range_m = noisy_range_m(hit, beam);
  return sample_of(direction, t_us, range_m > 0 ? RayState::kHit : RayState::kInvalid, range_m);
}

bool RaySimulator::lost(const RayHit& hit, const Beam& beam) const {
  const bool grazing = std::abs(hit.normal.dot(beam.direction)) < cos_dropout_incidence_;
  return hit.range_m > model_.range_max_m || grazing || beam.draws.dropout < model_.dropout_probability;
}

// A beam of finite width that lies partly on another surface returns a range between the two: the "phantom" points at range edges.
// Four rays at the footprint's rim look for a surface that leaves the plane of the hit by more than the footprint's radius. Where the
// rim sees empty space the hit stands, as the returned light all comes from it.
double RaySimulator::mixed_range_m(const RayHit& hit, const Beam& beam) const {
  const Vec3 point = hit.range_m * beam.direction;
  const Across axes = across(beam.direction);
  const double radius_m = footprint_m(model_, hit.range_m);
  double other_m = hit.range_m;
  for (const Vec3& offset : {axes.right, Vec3(-axes.right), axes.down, Vec3(-axes.down)}) {
    const Vec3 direction = (point + radius_m * offset).normalized();
    const RayHit rim = cast(beam, direction);
    if (!rim.hit || std::abs(hit.normal.dot(rim.range_m * direction - point)) <= radius_m) continue;
    if (std::abs(rim.range_m - hit.range_m) > std::abs(other_m - hit.range_m)) other_m = rim.range_m;
  }
  return hit.range_m + beam.draws.mixing_weight * (other_m - hit.range_m);
}

double RaySimulator::noisy_range_m(const RayHit& hit, const Beam& beam) const {
  const bool mixing = footprint_m(model_, hit.range_m) > 0 && beam.draws.mixing < model_.edge_mixing_probability;
  const double range_m = mixing ? mixed_range_m(hit, beam) : hit.range_m;
  const double sigma_m = range_sigma_m(model_, range_m * beam.direction.z());
  const double common_m = (model_.common_sigma_m + model_.common_sigma_k_per_m * range_m * range_m) * beam.common.range;
  return quantised_m(range_m + sigma_m * beam.draws.range + common_m, model_.range_step_m);
}

SimulatedScanner::SimulatedScanner(const RayCaster& target, const Trajectory& trajectory, const ScannerModel& model, std::uint64_t seed,
                                   OtherBodies others)
    : rays_(target, trajectory, model, seed, std::move(others)),
      tan_half_x_(tangent(model.fov_half_x_rad)),
      tan_half_y_(tangent(model.fov_half_y_rad)) {}

// A plan that touches the limit is inside: the planner caps its extents at the same limit, and may differ in the last bits.
bool SimulatedScanner::within_field_of_view(const ScanPlan& plan) const {
  constexpr double kRounding = 1e-6;
  const auto within = [&](double x, double y) { return std::abs(x) <= tan_half_x_ + kRounding && std::abs(y) <= tan_half_y_ + kRounding; };
  return within(std::abs(plan.center_x) + plan.half_x, std::abs(plan.center_y) + plan.half_y) &&
         std::all_of(plan.aimed.begin(), plan.aimed.end(),
                     [&](const AimedRay& ray) { return within(static_cast<double>(ray.x), static_cast<double>(ray.y)); });
}

Status SimulatedScanner::start(const ScanPlan& plan, TimeUs t_start_us) {
  if (running_) return Status::kBusy;
  if (lasso::validate(plan) != Status::kOk || !within_field_of_view(plan)) return Status::kBadValue;
  plan_ = plan;
  t_start_us_ = t_start_us;
  next_ = 0;
  running_ = true;
  return Status::kOk;
}

SensorPoll SimulatedScanner::poll(TimeUs now_us, Span<RangeSample> out) {
  SensorPoll result;
  if (!running_) {
    result.status = Status::kNoData;
    return result;
  }
  while (result.count < out.size() && next_ < plan_.points) {
    const TimeUs t_us = t_start_us_ + pattern_time_us(plan_, next_);
    if (t_us > now_us) break;
    out[result.count] = rays_.measure(plan_.scan_id, next_, pattern_direction(plan_, next_), t_us);
    ++result.count;
    ++next_;
  }
  result.complete = next_ == plan_.points;
  running_ = !result.complete;
  return result;
}

}  // namespace lasso::sim
