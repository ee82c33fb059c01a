// What a scenario simulates: its clock, the sensors' models, and the target's motion.
#pragma once

#include <cstdint>
#include <memory>

#include "hal_sim/other_body.hpp"
#include "hal_sim/scanner.hpp"
#include "hal_sim/trajectory.hpp"
#include "mdat/missiondb/mission_source.hpp"

namespace lasso::mdat {

constexpr TimeUs kEpochUs = 1'000'000;  // begin of frame 0 of every run
DurationUs to_us(double time_s);        // to the nearest
DurationUs period_us(const MissionParameters& parameters);

// The scanner of a scenario, [sensor]; without noise its ranges and directions are exact.
sim::ScannerModel scanner_model(const Scenario& scenario, const SensorParameters& sensor, bool noise);
// Another one of the mission's.
sim::ScannerModel scanner_model(const Scenario& scenario, const FurtherSensor& sensor, bool noise);

// The scenario of a run whose noise is that of `seed`: where its motion is drawn, with that motion; otherwise as it is.
Scenario drawn_scenario(Scenario scenario, std::uint64_t seed);

// All else that a scene has: nodes with a surface, as the sensors see them move. None where it says ranges.
sim::OtherBodies make_other_bodies(const Scenario& scenario, TimeUs epoch_us);

// The target's motion; frame 0 begins at `epoch_us`.
std::unique_ptr<sim::Trajectory> make_trajectory(const Scenario& scenario, double range_m, TimeUs epoch_us, DurationUs period_us);

}  // namespace lasso::mdat
