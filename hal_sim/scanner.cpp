#include "hal_sim/scanner.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "fsw/geometry/so3.hpp"
#include "fsw/sense/pattern.hpp"

namespace lasso::sim {
namespace {

constexpr std::uint64_t kCloudStream = 0x636c6f7564U;  // not that of the other draws

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

// Whether noise that looks like a return at `alarm_m` is told in place of a return; it hardly exceeds the threshold.
bool is_told(Returns returns, double alarm_m, const Echo& echo) {
  if (returns == Returns::kStrongest) return false;
  return returns == Returns::kLast ? alarm_m > echo.range_m : alarm_m < echo.range_m;
}

// Of what is not said to reflect more or less, what the reference reflects.
Echo echo_of(const DetectorModel& detector, const RayHit& hit, const Vec3& direction, double share) {
  const double cosine = std::abs(hit.normal.dot(direction));
  const double back = hit.reflection == nullptr ? cosine * detector.reference_reflectance : backscatter(*hit.reflection, cosine);
  const double electrons = is_simulated(detector) ? signal_electrons(detector, back, hit.range_m) : 1 / (hit.range_m * hit.range_m);
  return {hit.range_m, hit.range_m * direction.z(), share * electrons};
}

// The clouds about a ray.
struct Clouds {
  const OtherBodies& others;
  const std::vector<Pose>& T_sensor_others;
  const Vec3& direction;
};

// Optical depth of all clouds up to that range.
double cloud_depth(const Clouds& clouds, double range_m) {
  double sum = 0;
  for (std::size_t i = 0; i < clouds.others.size(); ++i) {
    if (clouds.others[i].volume == nullptr) continue;
    const Pose T_volume_sensor = inverse(clouds.T_sensor_others[i]);
    sum += optical_depth(*clouds.others[i].volume, T_volume_sensor.p, rotate(T_volume_sensor.q, clouds.direction), range_m);
  }
  return sum;
}

// Where in a cloud, nearer than `range_m`, the light is scattered: the first of the depths that are drawn, by Beer and Lambert. What
// returns from there without loss on the way; range 0: nothing is scattered.
Echo scattered(const Clouds& clouds, double range_m, const DetectorModel& detector, Random& random) {
  Echo echo;
  for (std::size_t i = 0; i < clouds.others.size(); ++i) {
    if (clouds.others[i].volume == nullptr) continue;
    const ScatterVolume& volume = *clouds.others[i].volume;
    const Pose T_volume_sensor = inverse(clouds.T_sensor_others[i]);
    const Vec3 direction = rotate(T_volume_sensor.q, clouds.direction);
    const double place_m = range_of_depth(volume, T_volume_sensor.p, direction, -natural_logarithm(1 - random.uniform()));
    if (place_m <= 0 || place_m >= range_m || (echo.range_m > 0 && place_m >= echo.range_m)) continue;
    const double z_m = place_m * clouds.direction.z();
    const double back = volume_backscatter(volume, T_volume_sensor.p + place_m * direction, width_m(detector, z_m));
    echo = {place_m, z_m, is_simulated(detector) ? signal_electrons(detector, back, place_m) : 0, true};
  }
  return echo;
}

double quantised_m(double range_m, double step_m) { return step_m > 0 ? std::floor(range_m / step_m + 0.5) * step_m : range_m; }

}  // namespace

struct RaySimulator::Beam {
  Pose T_sensor_target;
  std::vector<Pose> T_sensor_others;
  Vec3 direction;  // along which the scanner truly looks
  RayDraws draws;
  CommonErrors common;
  TimeUs t_us;
  std::uint32_t scan_id, ray;
};

RaySimulator::RaySimulator(const RayCaster& target, const Trajectory& trajectory, const ScannerModel& model, std::uint64_t seed,
                           OtherBodies others)
    : target_(target),
      trajectory_(trajectory),
      others_(std::move(others)),
      model_(model),
      seed_(seed),
      common_(seed, model.common_memory_s),
      scatters_(std::any_of(others_.begin(), others_.end(), [](const OtherBody& other) { return other.volume != nullptr; })),
      detects_(scatters_ || is_simulated(model.detector) || model.detector.returns != Returns::kMixed),
      alarms_(model.detector, model.range_min_m, model.range_max_m) {
  sim::validate(model);
  cos_dropout_incidence_ = model.dropout_incidence_rad < kPi / 2 ? sin_cos(model.dropout_incidence_rad).cos : -1;
}

CommonErrors RaySimulator::common_errors(std::uint32_t scan_id, TimeUs t_us) const {
  return has_common_errors(model_) ? common_.at(scan_id, t_us) : CommonErrors{};
}

RayHit RaySimulator::cast(const Beam& beam, const Vec3& direction) const {
  RayHit nearest = cast_at(target_, beam.T_sensor_target, direction);
  for (std::size_t i = 0; i < others_.size(); ++i) {
    if (others_[i].surface == nullptr) continue;
    const RayHit hit = cast_at(*others_[i].surface, beam.T_sensor_others[i], direction);
    if (hit.hit && (!nearest.hit || hit.range_m < nearest.range_m)) nearest = hit;
  }
  return nearest;
}

bool RaySimulator::is_blocked(const Beam& beam, const Vec3& from_m, const Vec3& direction) const {
  const auto blocks = [&](const RayCaster& surface, const Pose& T_sensor_surface) {
    const Pose T_surface_sensor = inverse(T_sensor_surface);
    return surface.is_blocked(T_surface_sensor * from_m, rotate(T_surface_sensor.q, direction));
  };
  if (blocks(target_, beam.T_sensor_target)) return true;
  for (std::size_t i = 0; i < others_.size(); ++i) {
    if (others_[i].surface != nullptr && blocks(*others_[i].surface, beam.T_sensor_others[i])) return true;
  }
  return false;
}

RangeSample RaySimulator::measure(std::uint32_t scan_id, std::uint32_t ray, const Vec3& direction, TimeUs t_us) const {
  const Vec3 nominal = as_reported(direction);
  const CommonErrors common = common_errors(scan_id, t_us);
  // The reported ray is turned by the error against the one that is measured.
  const Vec3 pointed = rotate(exp_so3(-model_.common_sigma_rad * common.turn), nominal);
  Beam beam{trajectory_.pose_at(t_us), {}, pointed, draw(seed_, scan_id, ray), common, t_us, scan_id, ray};
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
  const bool dark = t_us >= model_.dark_from_us && t_us < model_.dark_until_us;
  const RayHit hit = cast(beam, beam.direction);
  if (dark || (!hit.hit && !detects_)) return sample_of(direction, t_us, RayState::kMiss, 0);
  const double background = has_sunlight(model_.detector) ? background_electrons(hit, beam) : 0;
  const Detection found = detects_ ? detected(hit, background, draw_detector(seed_, scan_id, ray), beam) : surface_alone(hit, beam);
  if (found.state != RayState::kHit) return sample_of(direction, t_us, found.state, 0);
  const double range_m = noisy_range_m(found.echo, background, beam);
  return sample_of(direction, t_us, range_m > 0 ? RayState::kHit : RayState::kInvalid, range_m);
}

bool RaySimulator::lost(const RayHit& hit, const Beam& beam) const {
  const bool grazing = std::abs(hit.normal.dot(beam.direction)) < cos_dropout_incidence_;
  return hit.range_m > model_.range_max_m || grazing || beam.draws.dropout < model_.dropout_probability;
}

bool RaySimulator::mixes(const RayHit& hit, const Beam& beam) const {
  return footprint_m(model_, hit.range_m) > 0 && beam.draws.mixing < model_.edge_mixing_probability;
}

// A beam of finite width may lie partly on another surface. Four rays at the footprint's rim look for a surface that leaves the plane of
// the hit by more than the footprint's radius; the farthest from the hit counts. Where the rim sees empty space the hit stands, as the
// returned light all comes from it.
RayHit RaySimulator::rim_hit(const RayHit& hit, const Beam& beam) const {
  const Vec3 point = hit.range_m * beam.direction;
  const Across axes = across(beam.direction);
  const double radius_m = footprint_m(model_, hit.range_m);
  RayHit other = hit;
  for (const Vec3& offset : {axes.right, Vec3(-axes.right), axes.down, Vec3(-axes.down)}) {
    const Vec3 direction = (point + radius_m * offset).normalized();
    const RayHit rim = cast(beam, direction);
    if (!rim.hit || std::abs(hit.normal.dot(rim.range_m * direction - point)) <= radius_m) continue;
    if (std::abs(rim.range_m - hit.range_m) > std::abs(other.range_m - hit.range_m)) other = rim;
  }
  return other;
}

// Without a detector: mixed ranges lie anywhere between the two surfaces, the "phantom" points at range edges.
Detection RaySimulator::surface_alone(const RayHit& hit, const Beam& beam) const {
  if (lost(hit, beam)) return {};
  if (hit.range_m < model_.range_min_m) return {RayState::kInvalid, {}};
  const double other_m = mixes(hit, beam) ? rim_hit(hit, beam).range_m : hit.range_m;
  const double range_m = hit.range_m + beam.draws.mixing_weight * (other_m - hit.range_m);
  return {RayState::kHit, {range_m, range_m * beam.direction.z(), 0}};
}

Echoes RaySimulator::echoes_of(const RayHit& hit, const Beam& beam) const {
  Echoes echoes;
  if (!hit.hit || lost(hit, beam)) return echoes;
  const RayHit other = mixes(hit, beam) ? rim_hit(hit, beam) : hit;
  const double share = other.range_m == hit.range_m ? 0 : beam.draws.mixing_weight;
  echoes.add(echo_of(model_.detector, hit, beam.direction, 1 - share));
  if (share > 0) echoes.add(echo_of(model_.detector, other, beam.direction, share));
  return echoes;
}

// Sunlight that the surface scatters into the receiver's field, and what the optics scatter where the Sun shines into them.
double RaySimulator::background_electrons(const RayHit& hit, const Beam& beam) const {
  const Sunlight sun = model_.detector.sun->at(beam.t_us);
  if (sun.share == 0) return 0;
  double radiance_per_sr = 0;
  if (hit.hit) {
    const double side = hit.normal.dot(beam.direction) > 0 ? -1 : 1;
    const Vec3 from_m = hit.range_m * beam.direction + 1e-5 * hit.range_m * side * hit.normal;
    const LaserReflection surface = hit.reflection == nullptr ? LaserReflection{model_.detector.reference_reflectance} : *hit.reflection;
    radiance_per_sr = sim::radiance_per_sr(surface, hit.normal, sun.direction, -beam.direction);
    if (radiance_per_sr > 0 && is_blocked(beam, from_m, sun.direction)) radiance_per_sr = 0;
  }
  const double glare_per_sr = glare_radiance_per_sr(model_.detector, sun.direction.dot(beam.direction));
  if (glare_per_sr > 0 && !is_blocked(beam, Vec3::Zero(), sun.direction)) radiance_per_sr += glare_per_sr;
  return sun.share * sun_electrons(model_.detector, radiance_per_sr);
}

// Without a detector that counts: what becomes of a photon that would return from the surface. It is scattered on its way out, and told
// from there; or on its way back, and lost; or it returns, with probability exp(-2 depth).
Detection RaySimulator::by_single_photons(const RayHit& hit, const Beam& beam, Random& random) const {
  const Clouds clouds{others_, beam.T_sensor_others, beam.direction};
  const double surface_m = hit.hit ? hit.range_m : model_.range_max_m;
  const Echo echo = scattered(clouds, surface_m, model_.detector, random);
  if (echo.range_m > 0) return {echo.range_m < model_.range_min_m ? RayState::kInvalid : RayState::kHit, echo};
  if (!hit.hit || -natural_logarithm(1 - random.uniform()) < cloud_depth(clouds, surface_m)) return {};
  return model_.detector.returns == Returns::kMixed ? surface_alone(hit, beam) : detect(model_.detector, echoes_of(hit, beam), 0, {});
}

Detection RaySimulator::detected(const RayHit& hit, double background, const DetectorDraws& draws, const Beam& beam) const {
  Echoes echoes = echoes_of(hit, beam);
  if (scatters_) {
    Random random = ray_stream(seed_ ^ kCloudStream, beam.scan_id, beam.ray);
    if (!is_simulated(model_.detector)) return by_single_photons(hit, beam, random);
    const Clouds clouds{others_, beam.T_sensor_others, beam.direction};
    for (std::size_t i = 0; i < echoes.size(); ++i) echoes[i].electrons *= exponential(-2 * cloud_depth(clouds, echoes[i].range_m));
    Echo cloud = scattered(clouds, hit.hit ? hit.range_m : model_.range_max_m, model_.detector, random);
    cloud.electrons *= exponential(-2 * cloud_depth(clouds, cloud.range_m));
    if (cloud.range_m > 0) echoes.add(cloud);
  }
  Detection found = detect(model_.detector, echoes, background, draws);
  const double alarm_m = alarms_.range_m(background, draws);
  const bool told =
      found.state == RayState::kMiss || (found.state == RayState::kHit && is_told(model_.detector.returns, alarm_m, found.echo));
  if (alarm_m > 0 && told) return {RayState::kHit, {alarm_m, alarm_m * beam.direction.z(), model_.detector.threshold_electrons}};
  if (found.state == RayState::kHit && found.echo.range_m < model_.range_min_m) found.state = RayState::kInvalid;
  return found;
}

double RaySimulator::noisy_range_m(const Echo& echo, double background, const Beam& beam) const {
  const double own_m = range_sigma_m(model_, echo.z_m);
  const double light_m = detector_sigma_m(model_.detector, echo, background);
  const double sigma_m = light_m == 0 ? own_m : std::sqrt(own_m * own_m + light_m * light_m);
  const double range_m = echo.range_m;
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
