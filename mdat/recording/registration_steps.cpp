#include "mdat/recording/registration_steps.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "fsw/pose/estimator/estimator.hpp"
#include "fsw/pose/registration/registration.hpp"
#include "fsw/pose/scan/prepare.hpp"
#include "mdat/mcap/bytes.hpp"
#include "mdat/run/case.hpp"

namespace lasso::mdat {
namespace {

constexpr double kLongestGap_s = 60;  // over which the filter of the frame before still says something

// As the filter predicts: constant rates.
std::optional<StartPoint> start_of(const PoseTelemetry& before, const PoseTelemetry& told) {
  if (before.t_measurement_us <= 0) return std::nullopt;
  const double dt_s = to_seconds(told.t_measurement_us) - to_seconds(before.t_measurement_us);
  if (!(dt_s > 0 && dt_s < kLongestGap_s)) return std::nullopt;
  StartPoint start;
  start.rates = Twist{Vec3(before.filter_omega_radps), Vec3(before.filter_v_mps)};
  start.T_sensor_target = propagate(filtered_pose(before), start.rates, dt_s);
  return start;
}

class Repeated {
 public:
  Repeated(const LoadedImage& image, std::uint8_t sensor) : mission_(image.mission()), estimator_(std::make_unique<Estimator>()) {
    mission_.parameters = parameters_of(image, sensor);
    limit_ = static_cast<int>(mission_.parameters.iterations_max);
  }

  // The first look ends after `limit` passes: the same ones, whatever the limit, so that each limit shows one more step.
  std::vector<RegistrationStep> take(const RangeImage& scan, const StartPoint& start) {
    prepare_rays(mission_, scan, start, estimator_->workspace());
    std::vector<RegistrationStep> steps;
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
  void add(const Pose& T_target_sensor, std::vector<RegistrationStep>& steps) {
    RegistrationStep step;
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

std::vector<ros::PointField> steps_fields(std::size_t columns) {
  std::vector<ros::PointField> fields = {
      {"x", 0, ros::FieldType::kFloat32}, {"y", 4, ros::FieldType::kFloat32}, {"z", 8, ros::FieldType::kFloat32}};
  for (std::size_t i = 0; i < columns; ++i)
    fields.push_back({"residual_" + std::to_string(i), static_cast<std::uint32_t>(12 + 4 * i), ros::FieldType::kFloat32});
  return fields;
}

}  // namespace

MissionParameters parameters_of(const LoadedImage& image, std::uint8_t sensor) {
  MissionParameters parameters = image.mission().parameters;
  if (sensor < image.mission().sensors.size()) static_cast<SensorParameters&>(parameters) = image.mission().sensors[sensor];
  return parameters;
}

bool to_range_image(const std::vector<RangeSample>& samples, RangeImage& scan) {
  if (samples.size() > kMaxRays) return false;
  for (RangeSample sample : samples) {
    if (sample.state == RayState::kLost) sample.state = RayState::kInvalid;
    if (!scan.samples.push_back(sample)) return false;
  }
  return true;
}

std::vector<RegistrationStep> registration_steps(const LoadedImage& image, const PoseTelemetry& before, const PoseTelemetry& told,
                                                 const RangeImage& scan) {
  if (told.part != 0 || static_cast<StopReason>(told.stop) == StopReason::kNotRun) return {};
  const std::optional<StartPoint> start = start_of(before, told);
  return start ? Repeated(image, told.sensor).take(scan, *start) : std::vector<RegistrationStep>();
}

ros::PointCloud steps_cloud(const ScanView& scan, const std::vector<RegistrationStep>& steps, std::size_t columns,
                            const sim::RayCaster& model) {
  ros::PointCloud cloud{steps_fields(columns), static_cast<std::uint32_t>(12 + 4 * columns), {}};
  std::vector<std::vector<float>> residuals_m;
  for (std::size_t i = 0; i < std::min(steps.size(), columns); ++i)
    residuals_m.push_back(residuals_of({scan.samples, scan.t_us, steps[i].T_sensor_target, scan.rates}, model));
  for (std::size_t ray = 0; ray < scan.samples.size(); ++ray) {
    const RangeSample& sample = scan.samples[ray];
    if (sample.state != RayState::kHit) continue;
    for (const float component : sample.direction) mcap::put(sample.range_m * component, cloud.data);
    for (std::size_t i = 0; i < columns; ++i)
      mcap::put(i < residuals_m.size() ? residuals_m[i][ray] : std::numeric_limits<float>::quiet_NaN(), cloud.data);
  }
  return cloud;
}

}  // namespace lasso::mdat
