// The frames of a run besides those of the estimates, as /tf says them: nodes of a scene where they truly are, parts of the target, and the
// frames that results are said of.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mdat/missiondb/mission_source.hpp"
#include "mdat/recording/ros_messages.hpp"

namespace lasso::mdat {

constexpr char kWorldFrame[] = "world", kSensorFrame[] = "sensor";  // the root of all, and the frame in which scans and poses are stated
constexpr char kTargetFrame[] = "target", kFilteredFrame[] = "target_filtered";  // estimates
constexpr char kTrueFrame[] = "target_true";
constexpr char kCameraFrame[] = "camera/left";  // of the pictures of both cameras of a stereo head

class SceneFrames {
 public:
  // Of a run of this scenario; without a name, or of one that says ranges, the sensor rests in the world. Throws MissionError where the
  // mission has no such scenario.
  SceneFrames(const MissionSource& mission, const std::string& scenario);

  // Each frame in its parent, from the world down to sensor and true target. A scene's root is the world, its sensor and target are
  // kSensorFrame and kTrueFrame, and every other node has its own name; "_node" follows one that is another frame's. `T_sensor_true`: of a
  // run without a scene.
  std::vector<ros::FrameTransform> true_frames(TimeUs t_us, const Pose& T_sensor_true) const;
  // Fixed to the estimated target: "part/NAME" of each part, "relative/NAME" of each [relative.NAME]'s frame there.
  const std::vector<ros::FrameTransform>& estimated_frames() const { return estimated_; }

  struct Body {
    std::string frame;
    const Mesh* surface;  // of the mission's
  };
  // Other surfaces of the scene, each fixed to its node.
  std::vector<Body> bodies() const;
  // Triangles of the target's mesh, by number, that are another node's; empty: none.
  const std::vector<bool>& moved_triangles() const;

 private:
  std::string frame_of(std::size_t node) const;
  std::shared_ptr<const SceneRun> scene_;                   // null: none
  std::vector<std::pair<std::size_t, std::size_t>> links_;  // each node with its parent
  std::vector<ros::FrameTransform> estimated_;
};

}  // namespace lasso::mdat
