#include "hal_sim/flash_lidar.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "fsw/geometry/so3.hpp"
#include "fsw/sense/pattern.hpp"

namespace lasso::sim {
namespace {

constexpr double kNormalMean = 50;
constexpr double kNoEcho = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kDeadStream = 0xDEADF1A5;  // no scan has this number before 27 years at 5 Hz

void check_flash(const char* name, double value, double minimum, double maximum) {
  if (value >= minimum && value <= maximum) return;  // false for NaN
  std::ostringstream message;
  message << "flash LIDAR: " << name << " is " << value << ", expected " << minimum << " to " << maximum;
  throw std::invalid_argument(message.str());
}

RangeSample pixel_towards(const Vec3& direction, RayState state) {
  RangeSample sample;
  for (int axis = 0; axis < 3; ++axis) sample.direction[axis] = static_cast<float>(direction[axis]);
  sample.state = state;
  return sample;
}

RangeSample hit_at(const RangeSample& pixel, double range_m) {
  RangeSample sample = pixel;
  sample.state = RayState::kHit;
  sample.range_m = static_cast<float>(range_m);
  return sample;
}

}  // namespace

void validate(const FlashModel& model) {
  check_flash("columns", model.columns, 8, kMaxPixelsASide);
  check_flash("rows", model.rows, 8, kMaxPixelsASide);
  check_flash("photons_at_10m", model.photons_at_10m, 1e-3, 1e12);
  check_flash("background", model.background, 0, 100);
  check_flash("threshold", model.threshold, 1, 1000);
  check_flash("pulse_m", model.pulse_m, 1e-4, 100);
  check_flash("jitter_m", model.jitter_m, 0, 10);
  check_flash("dead_share", model.dead_share, 0, 0.5);
  check_flash("reflectance", model.reflectance, 0, 1);
  check_flash("stated_sigma0_m", model.stated_sigma0_m, 1e-9, 1e3);
}

double expected_photons(const FlashModel& model, double range_m, double cos_incidence) {
  return model.photons_at_10m * (100 / (range_m * range_m)) * (model.reflectance / kFlashReflectance) * cos_incidence;
}

// One minus the sum of the first terms, each from the one before.
double detection_probability(double mean, int threshold) {
  double term = exponential(-mean), below = 0;
  for (int count = 0; count < threshold; ++count) {
    below += term;
    term *= mean / (count + 1);
  }
  return std::max(0.0, 1 - below);
}

double range_sigma_m(const FlashModel& model, double photons, double counts) {
  const double share = photons / (photons + model.background);
  const double one_m2 = share * model.pulse_m * model.pulse_m + (1 - share) * model.bin_m() * model.bin_m() / 12;
  return std::sqrt(model.jitter_m * model.jitter_m + one_m2 / counts);
}

double poisson(Random& random, double mean) {
  if (mean >= kNormalMean) return std::max(0.0, std::floor(mean + std::sqrt(mean) * random.gaussian() + 0.5));
  const double least = exponential(-mean);
  double product = random.uniform(), count = 0;
  for (; product > least; ++count) product *= random.uniform();
  return count;
}

FlashLidar::FlashLidar(const RayCaster& target, const Trajectory& trajectory, const ScannerModel& scanner, const FlashModel& model,
                       std::uint64_t seed, OtherBodies others)
    : target_(target),
      trajectory_(trajectory),
      others_(std::move(others)),
      scanner_(scanner),
      model_(model),
      seed_(seed),
      common_(seed, scanner.common_memory_s),
      tan_half_x_(tangent(scanner.fov_half_x_rad)),
      tan_half_y_(tangent(scanner.fov_half_y_rad)),
      cos_dropout_incidence_(scanner.dropout_incidence_rad < kPi / 2 ? sin_cos(scanner.dropout_incidence_rad).cos : -1),
      false_probability_(detection_probability(model.background, model.threshold)) {
  sim::validate(scanner);
  sim::validate(model);
}

PixelPitch FlashLidar::pitch() const { return {2 * tan_half_x_ / model_.columns, 2 * tan_half_y_ / model_.rows}; }

// A plan that touches the limit is inside: the planner caps its extents at the same limit, and may differ in the last bits.
bool FlashLidar::within_field_of_view(const ScanPlan& plan) const {
  constexpr double kRounding = 1e-6;
  return std::abs(plan.center_x) + plan.half_x <= tan_half_x_ + kRounding &&
         std::abs(plan.center_y) + plan.half_y <= tan_half_y_ + kRounding;
}

Status FlashLidar::start(const ScanPlan& plan, TimeUs t_start_us) {
  if (running_) return Status::kBusy;
  if (lasso::validate(plan) != Status::kOk || !within_field_of_view(plan)) return Status::kBadValue;
  plan_ = plan;
  next_ = 0;
  running_ = true;
  take_frame(t_start_us);
  return Status::kOk;
}

void FlashLidar::take_frame(TimeUs t_us) {
  t_us_ = t_us;
  frame_ = {inverse(trajectory_.pose_at(t_us)), {}, {}};
  for (const OtherBody& other : others_) frame_.T_others_sensor.push_back(inverse(other.motion->pose_at(t_us)));
  if (has_common_errors(scanner_)) frame_.common = common_.at(plan_.scan_id, t_us);
}

PixelPoll FlashLidar::poll(TimeUs now_us, Span<RangeSample> out) {
  PixelPoll result;
  result.t_us = t_us_;
  if (!running_) result.status = Status::kNoData;
  if (!running_ || now_us < t_us_) return result;
  const int pixels = model_.columns * model_.rows;
  for (; result.count < out.size() && next_ < pixels; ++next_) {
    const int column = next_ % model_.columns, row = next_ / model_.columns;
    const double x = tan_half_x_ * ((2.0 * column + 1) / model_.columns - 1), y = tan_half_y_ * ((2.0 * row + 1) / model_.rows - 1);
    if (std::abs(x - plan_.center_x) > plan_.half_x || std::abs(y - plan_.center_y) > plan_.half_y) continue;
    out[result.count++] = measure(column, row);
  }
  result.complete = next_ == pixels;
  running_ = !result.complete;
  return result;
}

// The unit vector through a place of the pixel grid, whole numbers and a half for the middles of pixels.
Vec3 FlashLidar::through(double column, double row) const {
  return Vec3(tan_half_x_ * (2 * column / model_.columns - 1), tan_half_y_ * (2 * row / model_.rows - 1), 1).normalized();
}

double FlashLidar::photons_of(const Echo& echo) const {
  if (!model_.materials || echo.material == nullptr) return expected_photons(model_, echo.range_m, echo.cos_incidence);
  return model_.photons_at_10m * (100 / (echo.range_m * echo.range_m)) * backscatter(*echo.material, echo.cos_incidence) /
         kFlashReflectance;
}

FlashLidar::Echo FlashLidar::echo_of(const Vec3& direction) const {
  const Vec3 truly = rotate(exp_so3(-scanner_.common_sigma_rad * frame_.common.turn), direction);
  const auto cast = [&](const RayCaster& surface, const Pose& T_surface_sensor) {
    const Vec3 ray = rotate(T_surface_sensor.q, truly);
    const RayHit hit = surface.cast(T_surface_sensor.p, ray);
    return hit.hit ? Echo{hit.range_m, std::abs(hit.normal.dot(ray)), 0, hit.reflection} : Echo{kNoEcho, 0, 0, nullptr};
  };
  Echo nearest = cast(target_, frame_.T_target_sensor);
  for (std::size_t i = 0; i < others_.size(); ++i) {
    const Echo echo = cast(*others_[i].surface, frame_.T_others_sensor[i]);
    if (echo.range_m < nearest.range_m) nearest = echo;
  }
  if (nearest.range_m > scanner_.range_max_m || nearest.cos_incidence < cos_dropout_incidence_) nearest = {kNoEcho, 0, 0, nullptr};
  if (nearest.range_m < kNoEcho) nearest.photons = photons_of(nearest);
  return nearest;
}

FlashLidar::Echo FlashLidar::echo_of_pixel(int column, int row) const {
  if (model_.ideal) return echo_of(through(column + 0.5, row + 0.5));
  Echo quarters[4], strongest{kNoEcho, 0, 0, nullptr};
  for (int i = 0; i < 4; ++i) {
    quarters[i] = echo_of(through(column + (i % 2 == 0 ? 0.25 : 0.75), row + (i < 2 ? 0.25 : 0.75)));
    quarters[i].photons /= 4;
    if (quarters[i].photons > strongest.photons) strongest = quarters[i];
  }
  if (strongest.photons == 0) return strongest;
  Echo sum;
  for (const Echo& quarter : quarters) {
    if (quarter.photons == 0 || std::abs(quarter.range_m - strongest.range_m) > model_.bin_m()) continue;
    sum.photons += quarter.photons;
    sum.range_m += quarter.photons * quarter.range_m;
  }
  sum.range_m /= sum.photons;
  return sum;
}

RangeSample FlashLidar::measure(int column, int row) const {
  const auto pixel = static_cast<std::uint32_t>(row * model_.columns + column);
  RangeSample sample = pixel_towards(through(column + 0.5, row + 0.5), RayState::kMiss);
  const Echo echo = echo_of_pixel(column, row);
  const bool dark = t_us_ >= scanner_.dark_from_us && t_us_ < scanner_.dark_until_us;
  if (!model_.ideal && ray_stream(seed_, kDeadStream, pixel).uniform() < model_.dead_share) {
    sample.state = RayState::kInvalid;
    return sample;
  }
  if (dark) return sample;
  Random random = ray_stream(seed_, plan_.scan_id, pixel);
  return measured(sample, echo, random);
}

// Where counts of the background pass for a return, in bins that nothing of the target is in: their number before the first one is
// distributed geometrically. Infinite beyond the farthest range.
double FlashLidar::false_range_m(double quiet, double place) const {
  if (false_probability_ <= 0) return kNoEcho;
  const double bins = std::floor(natural_logarithm(1 - quiet) / natural_logarithm(1 - std::min(0.5, false_probability_)));
  const double range_m = scanner_.range_min_m + (bins + place) * model_.bin_m();
  return range_m < scanner_.range_max_m ? range_m : kNoEcho;
}

// The first of what is detected: an echo, or counts of the background that pass for one.
RangeSample FlashLidar::measured(const RangeSample& pixel, const Echo& echo, Random& random) const {
  const double outlier = random.uniform(), place = random.uniform(), dropout = random.uniform(), quiet = random.uniform();
  if (outlier < scanner_.outlier_probability)
    return hit_at(pixel, scanner_.range_min_m + place * (scanner_.range_max_m - scanner_.range_min_m));
  const double counts = model_.ideal ? kNoEcho : poisson(random, echo.photons + model_.background);
  const bool seen = echo.range_m < kNoEcho && counts >= model_.threshold && dropout >= scanner_.dropout_probability;
  const double true_m = seen ? echo.range_m : kNoEcho, false_m = model_.ideal ? kNoEcho : false_range_m(quiet, place);
  if (false_m < true_m) return hit_at(pixel, false_m);
  if (!seen) return pixel;
  if (true_m >= scanner_.range_min_m) return timed(pixel, echo, counts, random);
  RangeSample saturated = pixel;
  saturated.state = RayState::kInvalid;
  return saturated;
}

RangeSample FlashLidar::timed(const RangeSample& pixel, const Echo& echo, double counts, Random& random) const {
  const double range_m = echo.range_m;
  const double common_m = (scanner_.common_sigma_m + scanner_.common_sigma_k_per_m * range_m * range_m) * frame_.common.range;
  if (model_.ideal) return hit_at(pixel, range_m + common_m);
  const double sigma_m = model_.noise_factor * range_sigma_m(model_, echo.photons, counts);
  RangeSample hit = hit_at(pixel, std::max(0.0, range_m + common_m + sigma_m * random.gaussian()));
  const double z_m = range_m * static_cast<double>(pixel.direction[2]), far_m = model_.stated_sigma_k_per_m * z_m * z_m;
  const double stated_m = std::sqrt(model_.stated_sigma0_m * model_.stated_sigma0_m + far_m * far_m);
  hit.sigma_factor = static_cast<float>(std::clamp(sigma_m / stated_m, 1.0, kMaxSigmaFactor));
  return hit;
}

}  // namespace lasso::sim
