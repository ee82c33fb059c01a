// A scanner of a simulated target, laser camera or LIDAR by its model: behind the Sensor interface, point by point at each point's own
// time.
#pragma once

#include "fsw/sense/sensor.hpp"
#include "hal_sim/common_error.hpp"
#include "hal_sim/other_body.hpp"
#include "hal_sim/random.hpp"
#include "hal_sim/ray_caster.hpp"
#include "hal_sim/scanner_model.hpp"
#include "hal_sim/trajectory.hpp"

namespace lasso::sim {

// What one ray finds: pure, so that reports and tests can ask about any ray at any time.
// `direction` is the reported (nominal) unit direction in the sensor frame; the ray is cast against the target, and all other bodies,
// where they are at `t_us`; what is nearest is met. Where the model has a detector, or a body is a cloud, the light that returns decides
// what is told (detector.hpp, scatter_volume.hpp).
class RaySimulator {
 public:
  // Keeps references: target and trajectory outlive the simulator. Throws std::invalid_argument as validate(model).
  RaySimulator(const RayCaster& target, const Trajectory& trajectory, const ScannerModel& model, std::uint64_t seed,
               OtherBodies others = {});

  RangeSample measure(std::uint32_t scan_id, std::uint32_t ray, const Vec3& direction, TimeUs t_us) const;
  const ScannerModel& model() const { return model_; }

 private:
  struct Beam;
  CommonErrors common_errors(std::uint32_t scan_id, TimeUs t_us) const;
  RayHit cast(const Beam& beam, const Vec3& direction) const;  // normal in sensor axes
  bool is_blocked(const Beam& beam, const Vec3& from_m, const Vec3& direction) const;
  bool lost(const RayHit& hit, const Beam& beam) const;
  RayHit rim_hit(const RayHit& hit, const Beam& beam) const;
  bool mixes(const RayHit& hit, const Beam& beam) const;
  double noisy_range_m(const Echo& echo, double background, const Beam& beam) const;
  Detection surface_alone(const RayHit& hit, const Beam& beam) const;
  Echoes echoes_of(const RayHit& hit, const Beam& beam) const;
  double background_electrons(const RayHit& hit, const Beam& beam) const;
  Detection detected(const RayHit& hit, double background, const DetectorDraws& draws, const Beam& beam) const;
  Detection by_single_photons(const RayHit& hit, const Beam& beam, Random& random) const;

  const RayCaster& target_;
  const Trajectory& trajectory_;
  OtherBodies others_;
  ScannerModel model_;
  std::uint64_t seed_;
  double cos_dropout_incidence_;
  CommonErrorProcess common_;
  bool scatters_;  // whether there is a cloud
  bool detects_;   // whether there is more to a return than that a surface is there
  FalseAlarms alarms_;
};

class SimulatedScanner final : public Sensor {
 public:
  // References and exceptions as RaySimulator. What a scan returns depends on the plan, its start time and the seed alone.
  SimulatedScanner(const RayCaster& target, const Trajectory& trajectory, const ScannerModel& model, std::uint64_t seed,
                   OtherBodies others = {});

  // kBadValue: a plan that validate (pattern.hpp) refuses, or that leaves the field of view.
  Status start(const ScanPlan& plan, TimeUs t_start_us) override;
  // Casts at most out.size() rays. A sample is there from its own time on.
  SensorPoll poll(TimeUs now_us, Span<RangeSample> out) override;
  void abort() override { running_ = false; }
  void permit_laser(bool /*permitted*/) override {}  // its light is the simulation's

 private:
  bool within_field_of_view(const ScanPlan& plan) const;

  RaySimulator rays_;
  double tan_half_x_, tan_half_y_;
  ScanPlan plan_;
  TimeUs t_start_us_ = 0;
  std::uint16_t next_ = 0;  // ray
  bool running_ = false;
};

}  // namespace lasso::sim
