// Where a mission's sensors look, and what noise they are assumed to have: for the scene and the scans of a recording.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fsw/sense/range_image.hpp"
#include "mdat/missiondb/mission_source.hpp"
#include "mdat/recording/ros_messages.hpp"

namespace lasso::mdat {

class SensorSight {
 public:
  // As the scenario has it; without a name, as the mission has. Throws MissionError where there is no such scenario.
  SensorSight(const MissionSource& mission, const std::string& scenario);

  // The edges of each sensor's field, in the sensor frame, up to a plane at this depth along its own boresight.
  std::vector<ros::Path> fields_of_view(double depth_m) const;
  // The left camera's frame in the sensor frame, of a stereo head whose pictures are rendered; none: there is no such.
  const std::optional<Pose>& camera() const { return camera_; }
  // Of a sensor by its number; of one that the mission does not have, the first's.
  const SensorParameters& parameters(std::uint8_t sensor) const;

 private:
  struct Sensor {
    std::string name;
    SensorParameters parameters;
    Pose T_sensor_own;
  };
  std::vector<Sensor> sensors_;
  std::optional<Pose> camera_;
};

// Where the rays of a scan go, one after the other, in the sensor frame at this range.
ros::Path scan_path(const std::vector<RangeSample>& samples, double range_m);

}  // namespace lasso::mdat
