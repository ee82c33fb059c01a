#include "mdat/stereo/stereo_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "fsw/geometry/so3.hpp"
#include "fsw/sense/pattern.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/stereo/depth_window.hpp"

namespace lasso::mdat {
namespace {

std::string stereo_camera_name(const MissionSource& source) {
  const std::vector<std::string> names = sensor_names(source);
  if (source.sensor == SensorKind::kStereo) return names.front();
  for (std::size_t i = 0; i < source.further_sensors.size(); ++i) {
    if (source.further_sensors[i].kind == SensorKind::kStereo) return names[i + 1];
  }
  return "";
}

// Renders, writes and matches pair after pair of one case.
class Photographer {
 public:
  Photographer(const MissionInput& mission, const CaseSetup& setup, std::uint64_t target_seed, std::uint64_t seed, unsigned jobs)
      : mission_(mission),
        scene_(scene_of_case(mission, setup, target_seed, stereo_camera_name(mission.source), 0)),
        camera_(make_head(mission.source.stereo, scene_.fov_half_x_rad, scene_.fov_half_y_rad), seed),
        materials_(stereo_materials(mission.source.stereo, scene_.materials)),
        depths_(stated_depths(mission.mesh, setup, mission.source.stereo.baseline_m)),
        jobs_(jobs) {
    write_file(files_.calibration, stereo_pair_text(camera_.head().stated));
  }

  DisparityMap pair_at(TimeUs t_us) {
    move_scene(mission_, t_us, scene_);
    const StereoSource& source = mission_.source.stereo;
    const StereoPictures pictures = camera_.take(
        {*scene_.surface, materials_, stereo_lights(source, scene_.orbit_lights, scene_.lamps), scene_.T_sensor_target}, jobs_);
    write_file(files_.left, grey_png(pictures.left));
    write_file(files_.right, grey_png(pictures.right));
    return match_files(matcher_program(), files_, depths_);
  }

 private:
  const MissionInput& mission_;
  Scene scene_;
  StereoCamera camera_;
  std::vector<Material> materials_;
  MatchDepths depths_;
  unsigned jobs_;
  ScratchFolder folder_;
  PairFiles files_{folder_.path() / "left.png", folder_.path() / "right.png", folder_.path() / "calibration.toml"};
};

class StereoOfCase final : public MadeSensor {
 public:
  StereoOfCase(const MissionInput& mission, const CaseSetup& setup, std::uint64_t target_seed, std::uint64_t seed, unsigned jobs)
      : photographer_(mission, setup, target_seed, seed, jobs), sensor_([this](TimeUs t_us) { return photographer_.pair_at(t_us); }) {}
  Sensor& sensor() override { return sensor_; }
  std::string failure() const override { return sensor_.failure(); }

 private:
  Photographer photographer_;
  StereoSensor sensor_;
};

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

Status StereoSensor::start(const ScanPlan& plan, TimeUs t_start_us) {
  if (running_) return Status::kBusy;
  if (lasso::validate(plan) != Status::kOk) return Status::kBadValue;
  try {
    map_ = pair_(t_start_us - kEpochUs);
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
    out[result.count] = stereo_sample(map_, pattern_direction(plan_, next_), t_start_us_);
  result.complete = next_ == plan_.points;
  running_ = !result.complete;
  return result;
}

std::string StereoSensor::failure() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return failure_;
}

bool has_stereo_head(const MissionSource& source) { return !stereo_camera_name(source).empty(); }

MakeStereo stereo_maker(const MissionInput& mission, std::uint64_t target_seed, unsigned jobs) {
  return [&mission, target_seed, jobs](const CaseSetup& setup, std::uint64_t seed) {
    return std::make_unique<StereoOfCase>(mission, setup, target_seed, seed, jobs);
  };
}

}  // namespace lasso::mdat
