// The sensors of a case: simulated, at the end of a line, or out of a recording.
#pragma once

#include <memory>
#include <vector>

#include "fsw/exec/component.hpp"
#include "fsw/sense/pixel_selector.hpp"
#include "hal_sim/flash_lidar.hpp"
#include "hal_sim/lcs_direct.hpp"
#include "mdat/run/camera.hpp"
#include "mdat/run/mounted_sensor.hpp"
#include "mdat/run/recording_sensor.hpp"

namespace lasso::mdat {

// A flash LIDAR, and what the board keeps of its pixels.
struct FlashOnBoard {
  FlashOnBoard(const CaseSetup& setup, const sim::Trajectory& trajectory, const sim::ScannerModel& model, const sim::FlashModel& flash,
               std::uint64_t seed)
      : lidar(*setup.target, trajectory, model, flash, seed, setup.others), selector(lidar) {}

  sim::FlashLidar lidar;
  PixelSelector selector;
};

// What the mission says of the sensor of that number.
struct SensorMade {
  SensorKind kind = SensorKind::kLaserCamera;
  sim::ScannerModel scanner;
  sim::FlashModel flash;
};

// What a sensor sees from where it stands: the case as if its own frame were the sensor frame.
struct OwnView {
  CaseSetup setup;
  std::unique_ptr<sim::Trajectory> trajectory;
};

// Of sensors, some of which stand elsewhere than in the sensor frame.
struct SensorPlace {
  std::unique_ptr<OwnView> view;           // none: it stands in the sensor frame
  std::optional<SensorMounting> mounting;  // of the same
  std::shared_ptr<MeasuredDepth> depth;    // of all of them; none: all stand in the sensor frame
};

// The sensor of that number, which remembers its scans: simulated, at the end of a line, or out of a recording. A recording's are in the
// sensor frame already.
struct Scanner {
  Scanner(const CaseSetup& setup, const sim::Trajectory& trajectory, const SensorMade& made, std::uint64_t seed, std::uint8_t number,
          SensorPlace place);

  Sensor& own();     // in its own frame
  Sensor& source();  // in the sensor frame

  SensorPlace stands;
  sim::SimulatedScanner ideal;
  std::unique_ptr<FlashOnBoard> flash;
  std::unique_ptr<MadeSensor> stereo;
  std::unique_ptr<sim::LcsDirect> head;  // noise ends with the counts of mirrors and detector
  std::unique_ptr<CameraOnLine> camera;
  std::unique_ptr<LiveCamera> live;
  std::unique_ptr<sim::ReplaySensor> replay;
  std::unique_ptr<MountedSensor> mounted;
  std::unique_ptr<sim::SensorRecorder> recorder;
  RecordingSensor recorded;
};

// In the order of their numbers; each with noise of its own, at its own place. `setup` and `trajectory` outlive them. Throws RunError:
// stereo cameras that nobody makes; InputError as LiveCamera.
std::vector<std::unique_ptr<Scanner>> make_scanners(const CaseSetup& setup, const sim::Trajectory& trajectory);

// Throws RunError: more of them than the component has room for.
SensorBank bank_of(const std::vector<std::unique_ptr<Scanner>>& scanners);

}  // namespace lasso::mdat
