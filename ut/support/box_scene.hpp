// A box in motion before a sensor: a ray caster in closed form behind the Sensor interface, with faults on request.
#pragma once

#include <cmath>
#include <cstdint>
#include <set>

#include "fsw/geometry/se3.hpp"
#include "fsw/mission/calibration.hpp"
#include "fsw/sense/pattern.hpp"
#include "fsw/sense/sensor.hpp"
#include "ut/support/box_image.hpp"
#include "ut/support/generator.hpp"

namespace lasso::test {

struct BoxScene {
  BoxModel box;
  Boxes others;        // parts of the target, too
  Pose at_zero;        // T_sensor_target at t = 0
  Twist rates;         // constant
  double sigma_m = 0;  // noise along the ray
  Pose pose_at(TimeUs t_us) const { return propagate(at_zero, rates, to_seconds(t_us)); }
  Boxes boxes() const {
    Boxes all{box};
    all.insert(all.end(), others.begin(), others.end());
    return all;
  }
};

inline BoxScene default_scene() {
  BoxScene scene;
  scene.at_zero.q = normalized(Quat(0.8, 0.3, -0.4, 0.35));
  scene.at_zero.p = Vec3(0.05, -0.04, 2.5);
  scene.rates.omega_radps = Vec3(0.01, 0.03, -0.02);
  scene.rates.v_mps = Vec3(0.004, -0.003, 0.01);
  scene.sigma_m = 1e-3;
  return scene;
}

// The same in motion, of a target without symmetry.
inline BoxScene uneven_scene() {
  BoxScene scene = default_scene();
  scene.others = {uneven_boxes()[1], uneven_boxes()[2]};
  return scene;
}

inline RangeSample cast_sample(const BoxScene& scene, const ScanPlan& plan, std::uint16_t index, TimeUs t_us, Generator& random) {
  const Vec3 u = pattern_direction(plan, index);
  const Pose T_target_sensor = inverse(scene.pose_at(t_us));
  const double range = cast_boxes(scene.boxes(), T_target_sensor.p, rotate(T_target_sensor.q, u));
  const double noise = scene.sigma_m * random.normal();
  RangeSample sample;
  for (int i = 0; i < 3; ++i) sample.direction[i] = static_cast<float>(u[i]);
  sample.t_us = t_us;
  sample.state = range > 0 ? RayState::kHit : RayState::kMiss;
  sample.range_m = range > 0 ? static_cast<float>(range + noise) : 0.0f;
  return sample;
}

class BoxSensor final : public Sensor {
 public:
  explicit BoxSensor(const BoxScene& scene) : scene_(scene) {}

  Status start(const ScanPlan& plan, TimeUs t_start_us) override {
    ++starts;
    last_plan = plan;
    if (refused.count(plan.scan_id) != 0) return Status::kBadValue;
    if (running_) return Status::kBusy;
    plan_ = plan;
    t_start_us_ = t_start_us;
    next_ = 0;
    running_ = true;
    random_ = Generator(plan.scan_id + 1u);
    return Status::kOk;
  }

  SensorPoll poll(TimeUs now_us, Span<RangeSample> out) override {
    SensorPoll poll;
    poll.status = running_ ? Status::kOk : Status::kNoData;
    if (running_ && lost.count(plan_.scan_id) != 0) poll.status = Status::kBadCrc;
    if (running_ && own_serial != 0 && serial != own_serial) poll.status = Status::kBadVersion;
    if (poll.status != Status::kOk) return poll;
    while (next_ < plan_.points && poll.count < out.size() && time_of(next_) <= now_us) {
      const std::uint16_t looked_at = stuck ? std::uint16_t{0} : next_;
      out[poll.count] = cast_sample(scene_, plan_, looked_at, time_of(next_) + scene_ahead_us, random_);
      out[poll.count].t_us = time_of(next_);
      if (hidden) out[poll.count].state = RayState::kMiss;
      ++poll.count;
      ++next_;
    }
    poll.complete = next_ == plan_.points;
    running_ = !poll.complete;
    return poll;
  }

  void abort() override { running_ = false; }
  void permit_laser(bool permitted) override { laser_permitted = permitted; }
  void use_calibration(const TriangulationCalibration* calibration) override { serial = calibration == nullptr ? 0 : calibration->serial; }

  std::set<std::uint32_t> lost;     // scans that fail while they run
  std::set<std::uint32_t> refused;  // scans that cannot be started
  bool hidden = false;              // the target is eclipsed: every ray misses
  DurationUs scene_ahead_us = 0;    // of the sensor's clock
  bool stuck = false;               // the mirrors stand still
  int starts = 0;
  bool laser_permitted = true;   // as it was last told
  std::uint32_t serial = 0;      // of the calibration that it was given; 0: none
  std::uint32_t own_serial = 0;  // no other is believed; 0: any
  ScanPlan last_plan;

 private:
  TimeUs time_of(std::uint16_t index) const { return t_start_us_ + pattern_time_us(plan_, index); }
  BoxScene scene_;
  ScanPlan plan_;
  TimeUs t_start_us_ = 0;
  std::uint16_t next_ = 0;
  bool running_ = false;
  Generator random_{1};
};

// Parameters that fit the scene, starting `off` from its truth.
inline MissionParameters box_parameters(const BoxScene& scene, const Vec6& off = Vec6::Zero()) {
  MissionParameters p = preset_parameters();
  p.sigma0_m = scene.sigma_m > 0 ? scene.sigma_m : 1e-5;
  p.sigma_k_per_m = 0;
  const Quat q = exp_so3(off.head<3>()) * scene.at_zero.q;
  const Vec3 t = scene.at_zero.p + off.tail<3>();
  p.start_check = 0;  // a test that wants one asks for it: most begin from the truth
  p.initial_present = 1;
  p.initial_qx = q.x();
  p.initial_qy = q.y();
  p.initial_qz = q.z();
  p.initial_qw = q.w();
  p.initial_x_m = t.x();
  p.initial_y_m = t.y();
  p.initial_z_m = t.z();
  return p;
}

}  // namespace lasso::test
