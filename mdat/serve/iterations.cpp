#include "mdat/serve/iterations.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "fsw/pose/estimator.hpp"
#include "fsw/pose/prepare.hpp"
#include "fsw/pose/register.hpp"
#include "hal_sim/ray_caster.hpp"
#include "mdat/recording/scan_cloud.hpp"
#include "mdat/run/case.hpp"

namespace lasso::mdat::serve {
namespace {

constexpr double kLongestGap_s = 60;  // over which the filter of the frame before still says something
constexpr float kNoResidual = std::numeric_limits<float>::quiet_NaN();

// As the filter predicts: constant rates.
std::optional<StartPoint> start_of(const Recording& recording, std::size_t n, double t_s) {
  const std::optional<PoseTelemetry> before = n > 0 ? recording.told(n - 1) : std::nullopt;
  if (!before || before->t_measurement_us <= 0) return std::nullopt;
  const double dt_s = t_s - to_seconds(before->t_measurement_us);
  if (!(dt_s > 0 && dt_s < kLongestGap_s)) return std::nullopt;
  StartPoint start;
  start.rates = Twist{Vec3(before->filter_omega_radps), Vec3(before->filter_v_mps)};
  start.T_sensor_target = propagate(filtered_pose(*before), start.rates, dt_s);
  return start;
}

class Repeated {
 public:
  Repeated(const LoadedImage& image, std::uint8_t sensor) : mission_(image.mission()), estimator_(std::make_unique<Estimator>()) {
    mission_.parameters = parameters_of(image, sensor);
    limit_ = static_cast<int>(mission_.parameters.iterations_max);
  }

  // The first look ends after `limit` passes: the same ones, whatever the limit, so that each limit shows one more step.
  std::vector<Iteration> take(const RangeImage& scan, const StartPoint& start) {
    prepare_rays(mission_, scan, start, estimator_->workspace());
    std::vector<Iteration> steps;
    add(inverse(start.T_sensor_target), steps);
    for (int limit = 0; limit <= limit_; ++limit) {
      mission_.parameters.iterations_max = limit;
      const HitSolution solution = register_first(mission_, inverse(start.T_sensor_target), estimator_->workspace());
      if (solution.stop == StopReason::kTooFewPoints || solution.stop == StopReason::kSingular) break;
      add(solution.T_target_sensor, steps);
      if (solution.stop != StopReason::kIterationLimit) break;
    }
    return steps;
  }

 private:
  void add(const Pose& T_target_sensor, std::vector<Iteration>& steps) {
    Iteration step;
    step.T_sensor_target = inverse(T_target_sensor);
    if (!steps.empty()) {
      const Vec6 difference = pose_difference(step.T_sensor_target, steps.back().T_sensor_target);
      step.step_rad = difference.head<3>().norm();
      step.step_m = difference.tail<3>().norm();
    }
    const HitSolution now = weigh_hits(mission_, T_target_sensor, estimator_->workspace());
    step.inliers = now.inliers;
    step.rms_m = now.inliers > 0 ? std::sqrt(now.squared_residual_m2 / now.inliers) : 0;
    steps.push_back(step);
  }

  Mission mission_;
  std::unique_ptr<Estimator> estimator_;
  int limit_ = 0;
};

std::unique_ptr<sim::RayCaster> caster_of(const SurfaceTriangles& surface) {
  std::vector<Vec3> points;
  for (const auto& point : surface.points)
    points.emplace_back(static_cast<double>(point[0]), static_cast<double>(point[1]), static_cast<double>(point[2]));
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::size_t i = 0; i + 2 < surface.indices.size(); i += 3) {
    const std::array<std::uint32_t, 3> corners = {surface.indices[i], surface.indices[i + 1], surface.indices[i + 2]};
    const Vec3& a = points[corners[0]];
    const Vec3 normal = (points[corners[1]] - a).cross(points[corners[2]] - a);
    if (normal.squaredNorm() > 0) triangles.push_back(corners);
  }
  return triangles.empty() ? nullptr : sim::make_ray_caster(points, triangles);
}

}  // namespace

MissionParameters parameters_of(const LoadedImage& image, std::uint8_t sensor) {
  MissionParameters parameters = image.mission().parameters;
  if (sensor < image.mission().sensors.size()) static_cast<SensorParameters&>(parameters) = image.mission().sensors[sensor];
  return parameters;
}

std::optional<RangeImage> recorded_scan(const Recording& recording, std::size_t n) {
  const std::string message = recording.own() ? recording.message(n, "/scan") : "";
  const std::optional<CloudView> cloud = message.empty() ? std::nullopt : read_cloud(message);
  std::vector<RangeSample> samples;
  const auto t_us = static_cast<TimeUs>(recording.frames().at(n).time_ns / 1000);
  if (!cloud || !samples_of({{}, cloud->step, std::string(cloud->data)}, t_us, samples) || samples.size() > kMaxRays) return std::nullopt;
  RangeImage scan;
  for (RangeSample& sample : samples) {
    if (sample.state == RayState::kLost) sample.state = RayState::kInvalid;
    if (!scan.samples.push_back(sample)) return std::nullopt;
  }
  return scan;
}

std::vector<Iteration> iterations_of(const Recording& recording, std::size_t n) {
  const std::optional<PoseTelemetry> told = recording.told(n);
  if (!told || recording.image() == nullptr || told->part != 0) return {};
  if (static_cast<StopReason>(told->stop) == StopReason::kNotRun) return {};
  const std::optional<RangeImage> scan = recorded_scan(recording, n);
  const std::optional<StartPoint> start = start_of(recording, n, to_seconds(told->t_measurement_us));
  if (!scan || !start) return {};
  return Repeated(*recording.image(), told->sensor).take(*scan, *start);
}

std::vector<float> residuals_at(const Recording& recording, const RangeImage& scan, const Pose& T_sensor_target, const Twist& rates) {
  const std::optional<SurfaceTriangles> surface = read_surface(recording.first_message("/scene"));
  const std::unique_ptr<sim::RayCaster> caster = surface ? caster_of(*surface) : nullptr;
  std::vector<float> residuals;
  if (!caster) return residuals;
  const TimeUs t_us = scan.reference_time_us();
  for (const RangeSample& sample : scan.samples) {
    const Pose T_target_sensor = inverse(propagate(T_sensor_target, rates, to_seconds(sample.t_us - t_us)));
    const Vec3 direction(static_cast<double>(sample.direction[0]), static_cast<double>(sample.direction[1]),
                         static_cast<double>(sample.direction[2]));
    const bool returned = sample.state == RayState::kHit && direction.squaredNorm() > 0;
    const sim::RayHit hit = returned ? caster->cast(T_target_sensor.p, rotate(T_target_sensor.q, direction.normalized())) : sim::RayHit{};
    residuals.push_back(hit.hit ? static_cast<float>(static_cast<double>(sample.range_m) - hit.range_m) : kNoResidual);
  }
  return residuals;
}

}  // namespace lasso::mdat::serve
