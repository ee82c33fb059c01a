#include "mdat/run/case_sensors.hpp"

#include "mdat/common/errors.hpp"

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
    throw RunError("stereo: only mdat run flies stereo cameras: their pictures take seconds a frame; set sensor.kind to another sensor");
  return setup.make_stereo(setup, seed);
}

}  // namespace

Scanner::Scanner(const CaseSetup& setup, const sim::Trajectory& trajectory, const SensorMade& made, std::uint64_t seed, std::uint8_t number)
    : ideal(*setup.target, trajectory, made.scanner, seed, setup.others),
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
      recorder(setup.record ? std::make_unique<sim::SensorRecorder>(source(), number, *setup.record) : nullptr),
      recorded(recorder ? static_cast<Sensor&>(*recorder) : source()) {}

Sensor& Scanner::source() {
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
  const SensorMade own{setup.sensor, scanner_model(setup.scenario, setup.parameters, setup.noise),
                       as_simulated(setup.flash, setup, setup.parameters)};
  scanners.push_back(std::make_unique<Scanner>(setup, trajectory, own, setup.seed, std::uint8_t{0}));
  for (const FurtherSensor& sensor : setup.further_sensors) {
    const auto number = static_cast<std::uint8_t>(scanners.size());
    std::uint64_t seed = setup.seed + number;
    const SensorMade made{sensor.kind, scanner_model(setup.scenario, sensor, setup.noise),
                          as_simulated(sensor.flash, setup, sensor.parameters)};
    scanners.push_back(std::make_unique<Scanner>(setup, trajectory, made, sim::split_mix64(seed), number));
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
