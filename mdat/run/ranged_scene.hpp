// What a scenario flies, as a scene: the mission's nodes, or, of one that says ranges, the target alone before a sensor at rest.
//
// The keys ranges_m, times_s, tilt_deg, spin_degps and their like are a short spelling of two nodes. Here they become them, and nobody
// behind asks which of both a scenario said.
#pragma once

#include <memory>

#include "mdat/missiondb/mission_source.hpp"

namespace lasso::mdat {

// The motion of the target in the sensor's frame that the scenario's short keys say, of a run at `range_m`; with times_s, through its
// ranges. Times are since frame 0. `period_us`: of a frame, in which step_deg turns it.
scene::MotionPtr ranged_motion(const Scenario& scenario, double range_m, DurationUs period_us);

// The scene of a run. Of a scenario that says ranges: root is the sensor, the target its only node.
std::shared_ptr<const SceneRun> scene_run(const Scenario& scenario, double range_m, DurationUs period_us);

// The same as a sensor sees it that stands elsewhere (FurtherSensor::T_sensor_own): its own frame is the sensor frame.
std::shared_ptr<const SceneRun> scene_run_from(const Scenario& scenario, double range_m, DurationUs period_us, const FurtherSensor& sensor);

}  // namespace lasso::mdat
