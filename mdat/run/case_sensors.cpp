#include "mdat/run/case_sensors.hpp"

#include <algorithm>
#include <utility>

#include "mdat/common/errors.hpp"
#include "mdat/run/ranged_scene.hpp"

namespace lasso::mdat {
namespace {

// The flash LIDAR as simulated: its users take its noise to be what the parameters state.
sim::FlashModel as_simulated(sim::FlashModel flash, const CaseSetup& setup, const SensorParameters& stated) {
  flash.stated_sigma0_m = stated.sigma0_m;
  flash.stated_sigma_k_per_m = stated.sigma_k_per_m;
  flash.noise_factor = setup.scenario.noise_factor;
  flash.ideal = !setup.noise;
  return flash;
}

bool has_stereo(const CaseSetup& setup, SensorKind kind) { return kind == SensorKind::kStereo && setup.noise && !setup.replay; }

std::unique_ptr<MadeSensor> stereo_of(const CaseSetup& setup, std::uint64_t seed, SensorKind kind) {
  if (!has_stereo(setup, kind)) return nullptr;
  if (!setup.make_stereo)
    throw RunError(
        "stereo: this command flies no stereo cameras; mdat run does, and mdat campaign with stereo.model = fitted; set sensor.kind to "
        "another sensor");
  return setup.make_stereo(setup, seed);
}

std::unique_ptr<OwnView> own_view(const CaseSetup& setup, const FurtherSensor& sensor) {
  if (!sensor.T_sensor_own) return nullptr;
  auto view = std::make_unique<OwnView>(OwnView{setup, nullptr});
  const DurationUs period = period_us(setup.parameters);
  view->setup.scenario.scene = scene_run_from(setup.scenario, setup.range_m, period, sensor);
  view->setup.others = make_other_bodies(view->setup.scenario, kEpochUs);
  view->trajectory = make_trajectory(view->setup.scenario, setup.range_m, kEpochUs, period);
  return view;
}

SensorPlace place_of(const CaseSetup& setup, const FurtherSensor& sensor, const std::shared_ptr<MeasuredDepth>& depth) {
  SensorPlace place{own_view(setup, sensor), std::nullopt, depth};
  if (sensor.T_sensor_own) place.mounting = {*sensor.T_sensor_own, sensor.parameters.fov_half_x_rad, sensor.parameters.fov_half_y_rad};
  return place;
}

// None where all of them stand in the sensor frame: then nobody asks.
std::shared_ptr<MeasuredDepth> depth_of(const CaseSetup& setup) {
  const bool apart = std::any_of(setup.further_sensors.begin(), setup.further_sensors.end(),
                                 [](const FurtherSensor& sensor) { return sensor.T_sensor_own.has_value(); });
  return apart ? std::make_shared<MeasuredDepth>() : nullptr;
}

}  // namespace

Scanner::Scanner(const CaseSetup& setup, const sim::Trajectory& trajectory, const SensorMade& made, std::uint64_t seed, std::uint8_t number,
                 SensorPlace place)
    : stands(std::move(place)),
      ideal(*setup.target, trajectory, made.scanner, seed, setup.others),
      flash(made.kind == SensorKind::kFlashLidar ? std::make_unique<FlashOnBoard>(setup, trajectory, made.scanner, made.flash, seed)
                                                 : nullptr),
      stereo(stereo_of(setup, seed, made.kind)),
      head(setup.noise && !flash && made.kind != SensorKind::kStereo
               ? std::make_unique<sim::LcsDirect>(*setup.target, trajectory, made.scanner, seed,
                                                  head_for(setup, made.scanner, made.kind, number), setup.others)
               : nullptr),
      camera(setup.wire && setup.camera_line.empty() && wired(*setup.wire, made.kind)
                 ? std::make_unique<CameraOnLine>(setup, trajectory, made.scanner, seed, number)
                 : nullptr),
      live(!setup.camera_line.empty() && wired(setup.wire.value_or(lcs::Device::kLaserCamera), made.kind)
               ? std::make_unique<LiveCamera>(setup, made.scanner, number)
               : nullptr),
      replay(setup.replay ? std::make_unique<sim::ReplaySensor>(*setup.replay, number) : nullptr),
      mounted(stands.depth && !replay ? std::make_unique<MountedSensor>(own(), stands.mounting, *stands.depth) : nullptr),
      recorder(setup.record ? std::make_unique<sim::SensorRecorder>(source(), number, *setup.record) : nullptr),
      recorded(recorder ? static_cast<Sensor&>(*recorder) : source()) {}

Sensor& Scanner::source() {
  if (mounted) return *mounted;
  return own();
}

Sensor& Scanner::own() {
  if (replay) return *replay;
  if (live) return live->driver;
  if (camera) return camera->line;
  if (flash) return flash->selector;
  if (stereo) return stereo->sensor();
  if (head) return *head;
  return ideal;
}

std::vector<std::unique_ptr<Scanner>> make_scanners(const CaseSetup& setup, const sim::Trajectory& trajectory) {
  std::vector<std::unique_ptr<Scanner>> scanners;
  const std::shared_ptr<MeasuredDepth> depth = depth_of(setup);
  const SensorMade own{setup.sensor, scanner_model(setup.scenario, setup.parameters, setup.noise),
                       as_simulated(setup.flash, setup, setup.parameters)};
  scanners.push_back(
      std::make_unique<Scanner>(setup, trajectory, own, setup.seed, std::uint8_t{0}, SensorPlace{nullptr, std::nullopt, depth}));
  for (const FurtherSensor& sensor : setup.further_sensors) {
    const auto number = static_cast<std::uint8_t>(scanners.size());
    std::uint64_t seed = setup.seed + number;
    SensorPlace place = place_of(setup, sensor, depth);
    const CaseSetup& seen = place.view ? place.view->setup : setup;
    const sim::Trajectory& motion = place.view ? *place.view->trajectory : trajectory;
    const SensorMade made{sensor.kind, scanner_model(seen.scenario, sensor, setup.noise),
                          as_simulated(sensor.flash, setup, sensor.parameters)};
    scanners.push_back(std::make_unique<Scanner>(seen, motion, made, sim::split_mix64(seed), number, std::move(place)));
  }
  return scanners;
}

SensorBank bank_of(const std::vector<std::unique_ptr<Scanner>>& scanners) {
  SensorBank bank;
  for (const auto& scanner : scanners) {
    if (!bank.push_back(&scanner->recorded)) throw RunError("more sensors than the component has room for");
  }
  return bank;
}

}  // namespace lasso::mdat
