#include "mdat/stereo/stereo_sensor.hpp"

#include <cmath>
#include <memory>

#include "fsw/sense/pattern.hpp"
#include "mdat/run/simulated_scenario.hpp"

namespace lasso::mdat {
namespace {

RangeSample sample_along(const Vec3& direction, TimeUs t_us, RayState state, double range_m) {
  RangeSample sample;
  for (int axis = 0; axis < 3; ++axis) sample.direction[axis] = static_cast<float>(direction[axis]);
  sample.range_m = static_cast<float>(range_m);
  sample.t_us = t_us;
  sample.state = state;
  return sample;
}

}  // namespace

RangeSample stereo_sample(const DisparityMap& map, const Vec3& direction, TimeUs t_us) {
  const Eigen::Vector2d at = map.pixel_of(direction);
  const double column = std::floor(at.x() + 0.5), row = std::floor(at.y() + 0.5);
  const bool is_seen = column >= 0 && row >= 0 && column < map.codes.width && row < map.codes.height;
  const int u = is_seen ? static_cast<int>(column) : 0, v = is_seen ? static_cast<int>(row) : 0;
  if (!is_seen || map.codes.codes[map.index(u, v)] == 0) return sample_along(direction, t_us, RayState::kInvalid, 0);
  const Vec3 point_m = map.point_m(u, v);
  return sample_along(point_m.normalized(), t_us, RayState::kHit, point_m.norm());
}

PairRanges ranges_in(DisparityMap map) {
  return [kept = std::make_shared<const DisparityMap>(std::move(map))](const Vec3& direction, TimeUs t_us) {
    return stereo_sample(*kept, direction, t_us);
  };
}

Status StereoSensor::start(const ScanPlan& plan, TimeUs t_start_us) {
  if (running_) return Status::kBusy;
  if (lasso::validate(plan) != Status::kOk) return Status::kBadValue;
  try {
    ranges_ = pair_(t_start_us - kEpochUs);
  } catch (const std::exception& error) {
    const std::lock_guard<std::mutex> lock(mutex_);
    failure_ = error.what();
    return Status::kTimeout;
  }
  plan_ = plan;
  t_start_us_ = t_start_us;
  next_ = 0;
  running_ = true;
  return Status::kOk;
}

SensorPoll StereoSensor::poll(TimeUs now_us, Span<RangeSample> out) {
  SensorPoll result;
  if (!running_) {
    result.status = Status::kNoData;
    return result;
  }
  if (now_us < t_start_us_) return result;
  for (; result.count < out.size() && next_ < plan_.points; ++result.count, ++next_)
    out[result.count] = ranges_(pattern_direction(plan_, next_), t_start_us_);
  result.complete = next_ == plan_.points;
  running_ = !result.complete;
  return result;
}

std::string StereoSensor::failure() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return failure_;
}

}  // namespace lasso::mdat
