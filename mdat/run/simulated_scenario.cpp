#include "mdat/run/simulated_scenario.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "hal_sim/random.hpp"
#include "mdat/run/ranged_scene.hpp"
#include "mdat/run/true_target.hpp"
#include "mdat/scene/pose_lookup.hpp"

namespace lasso::mdat {
namespace {

// A node of a scene before its sensors.
class NodeTrajectory final : public sim::Trajectory {
 public:
  NodeTrajectory(std::shared_ptr<const SceneRun> run, std::size_t node, TimeUs epoch_us)
      : run_(std::move(run)),
        node_(node),
        epoch_us_(epoch_us),
        is_quick_(run_->tree.is_quick(node, run_->sensor)),
        lookup_([this](TimeUs t_us) { return state(t_us); }) {}
  NodeTrajectory(const NodeTrajectory&) = delete;  // its look-up knows it
  NodeTrajectory& operator=(const NodeTrajectory&) = delete;
  sim::TruthState at(TimeUs t_us) const override {
    const scene::MotionState now = state(t_us - epoch_us_);
    return {now.T_a_b, now.rates};
  }
  Pose pose_at(TimeUs t_us) const override { return is_quick_ ? state(t_us - epoch_us_).T_a_b : lookup_.at(t_us - epoch_us_); }

 private:
  std::shared_ptr<const SceneRun> run_;
  scene::MotionState state(TimeUs t_us) const { return run_->tree.state(node_, run_->sensor, t_us); }

  std::size_t node_;
  TimeUs epoch_us_;
  bool is_quick_;
  mutable scene::PoseLookup lookup_;
};

// The Sun of a scene in an orbit, before its sensors.
class SceneSun final : public sim::SunSource {
 public:
  SceneSun(const std::shared_ptr<const SceneRun>& run, const scene::Orbit& orbit, TimeUs epoch_us)
      : orbit_(orbit), root_(run, 0, epoch_us), epoch_us_(epoch_us) {}
  sim::Sunlight at(TimeUs t_us) const override {
    return {rotate(root_.pose_at(t_us).q, orbit_.sun_hill(t_us - epoch_us_)), orbit_.sunlit_share(t_us - epoch_us_)};
  }

 private:
  scene::Orbit orbit_;
  NodeTrajectory root_;
  TimeUs epoch_us_;
};

void set_detector(const sim::DetectorModel& detector, const Scenario& scenario, sim::ScannerModel& model) {
  model.detector = detector;
  if (!(detector.bandpass_m > 0) || scenario.scene == nullptr) return;
  const std::optional<scene::Orbit>& orbit = scenario.scene->orbit;
  if (orbit) model.detector.sun = std::make_shared<SceneSun>(scenario.scene, *orbit, kEpochUs);
}

// As long as it is, into any direction.
void turn(std::vector<double>& vector, sim::Random& random) {
  const double length = Vec3(vector.data()).norm();
  const double x = random.gaussian(), y = random.gaussian();
  const Vec3 turned = length * Vec3(x, y, random.gaussian()).normalized();
  vector.assign(turned.data(), turned.data() + 3);
}

// What does not depend on noise.
sim::ScannerModel model_of(const Scenario& scenario, const SensorParameters& sensor) {
  sim::ScannerModel model;
  model.fov_half_x_rad = sensor.fov_half_x_rad;
  model.fov_half_y_rad = sensor.fov_half_y_rad;
  model.range_min_m = sensor.range_min_m;
  model.range_max_m = sensor.range_max_m;
  model.dropout_incidence_rad = scenario.dropout_incidence_rad;
  model.outlier_probability = scenario.outlier_probability;
  model.edge_mixing_m = scenario.edge_mixing_m;
  model.dark_from_us = kEpochUs + to_us(scenario.eclipse_s[0]);
  model.dark_until_us = kEpochUs + to_us(scenario.eclipse_s[1]);
  return model;
}

// Of a scenario, or as a further sensor states its own.
template <class Source>
void set_common(const Source& source, sim::ScannerModel& model) {
  model.common_sigma_m = source.common_sigma_m;
  model.common_sigma_k_per_m = source.common_sigma_k_per_m;
  model.common_sigma_rad = source.common_sigma_rad;
  model.common_memory_s = source.common_memory_s;
}

}  // namespace

DurationUs to_us(double time_s) { return static_cast<DurationUs>(std::llround(time_s * 1e6)); }

DurationUs period_us(const MissionParameters& parameters) { return to_us(parameters.period_s); }

sim::ScannerModel scanner_model(const Scenario& scenario, const SensorParameters& sensor, bool noise) {
  sim::ScannerModel model = model_of(scenario, sensor);
  model.dropout_probability = scenario.dropout_probability;
  if (!noise) return model;
  model.sigma0_m = scenario.noise_factor * scenario.sigma0_m;
  model.sigma_k_per_m = scenario.noise_factor * scenario.sigma_k_per_m;
  model.sigma_angle_rad = scenario.angle_noise_rad;
  set_common(scenario, model);
  model.beam_divergence_rad = scenario.beam_divergence_rad;
  set_detector(scenario.detector, scenario, model);
  return model;
}

sim::ScannerModel scanner_model(const Scenario& scenario, const FurtherSensor& sensor, bool noise) {
  sim::ScannerModel model = model_of(scenario, sensor.parameters);
  model.dropout_probability = sensor.parameters.dropout_probability;
  if (!noise) return model;
  model.sigma0_m = scenario.noise_factor * sensor.parameters.sigma0_m;
  model.sigma_k_per_m = scenario.noise_factor * sensor.parameters.sigma_k_per_m;
  model.sigma_angle_rad = sensor.parameters.sigma_angle_rad;
  set_common(sensor.parameters, model);
  set_detector(sensor.detector, scenario, model);
  if (sensor.kind == SensorKind::kTimeOfFlight) model.beam_divergence_rad = sim::time_of_flight_lidar().beam_divergence_rad;
  return model;
}

Scenario drawn_scenario(Scenario scenario, std::uint64_t seed) {
  if (scenario.drawn == 0) return scenario;
  constexpr std::uint64_t kMotionStream = 0x6d6f74696f6eU;  // not that of the noise
  sim::Random random(seed ^ kMotionStream);
  scenario.roll_rad = random.uniform(-kPi, kPi);
  scenario.boresight_rad = random.uniform(-kPi, kPi);
  scenario.tilt_rad = std::asin(random.uniform(-1, 1));  // the long axis in any direction, all alike
  turn(scenario.spin_radps, random);
  turn(scenario.drift_mps, random);
  return scenario;
}

sim::OtherBodies make_other_bodies(const Scenario& scenario, TimeUs epoch_us) {
  sim::OtherBodies bodies;
  for (std::size_t i = 0; scenario.scene != nullptr && i < scenario.scene->body_nodes.size(); ++i) {
    bodies.push_back({make_target(scenario.scene->surfaces->bodies[i].mesh, scenario.scene->surfaces->bodies[i].laser),
                      std::make_shared<NodeTrajectory>(scenario.scene, scenario.scene->body_nodes[i], epoch_us)});
  }
  if (scenario.scene == nullptr) return bodies;
  for (const auto& [node, volume] : scenario.scene->volumes)
    bodies.push_back({nullptr, std::make_shared<NodeTrajectory>(scenario.scene, node, epoch_us), volume});
  return bodies;
}

std::unique_ptr<sim::Trajectory> make_trajectory(const Scenario& scenario, double range_m, TimeUs epoch_us, DurationUs period) {
  std::shared_ptr<const SceneRun> run = scene_run(scenario, range_m, period);
  const std::size_t target = run->target;
  return std::make_unique<NodeTrajectory>(std::move(run), target, epoch_us);
}

}  // namespace lasso::mdat
