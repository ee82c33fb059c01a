#include "mdat/benchmark/still_scans.hpp"

#include "fsw/sense/planner.hpp"
#include "hal_sim/scanner.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/run/simulated_scenario.hpp"

namespace lasso::mdat {

StillScans::StillScans(const Subject& subject, ScanStream stream)
    : subject_(subject),
      random_(1000 * subject.body.seed + static_cast<std::uint64_t>(stream)),
      middle_m_(0.5 * (subject.truth.low_m + subject.truth.high_m)) {
  const MissionParameters parameters = parameters_for(subject.mission.source, "spin");
  image_ = std::make_unique<LoadedImage>(subject.mission.source.name, image_bytes(subject.mission, parameters));
}

Vec3 StillScans::draw_direction() {
  const double x = random_.gaussian(), y = random_.gaussian();
  return Vec3(x, y, random_.gaussian()).normalized();
}

Pose StillScans::draw_pose() {
  const double x = random_.gaussian(), y = random_.gaussian(), z = random_.gaussian();
  Pose pose;
  pose.q = normalized(Quat(random_.gaussian(), x, y, z));
  const double range_m = subject_.nearest_m * random_.uniform(1, 2);
  const double right = random_.uniform(-0.02, 0.02), down = random_.uniform(-0.02, 0.02);
  pose.p = range_m * Vec3(right, down, 1) - rotate(pose.q, middle_m_);
  return pose;
}

Pose StillScans::draw_start(const Pose& T_sensor_target, double turn_rad, double shift_m) {
  const Quat turn = exp_so3(turn_rad * draw_direction());
  Pose start = T_sensor_target * Pose{turn, middle_m_ - rotate(turn, middle_m_)};
  start.p += shift_m * draw_direction();
  return start;
}

const RangeImage& StillScans::scan(const sim::RayCaster& surface, const Pose& T_sensor_target, const Pose& expected) {
  const Scenario& scenario = scenario_of(subject_.mission.source, "spin");
  const TimeUs begin_us = kEpochUs + scan_->scan_id++ * period_us(mission().parameters);
  const sim::ConstantTwist rest({T_sensor_target, Twist{}}, begin_us);
  sim::SimulatedScanner scanner(surface, rest, scanner_model(scenario, mission().parameters, true), random_.bits());
  ScanPlan plan;
  if (plan_scan(mission().parameters, {mission().hull, mission().center_m}, expected, scan_->scan_id, plan) != Status::kOk ||
      scanner.start(plan, begin_us) != Status::kOk)
    throw RunError("a scan has no plan");
  std::vector<RangeSample> samples(plan.points);
  const SensorPoll polled = scanner.poll(begin_us + plan.duration_us, {samples.data(), samples.size()});
  scan_->samples.clear();
  for (std::size_t i = 0; i < polled.count; ++i) (void)scan_->samples.push_back(samples[i]);
  return *scan_;
}

}  // namespace lasso::mdat
