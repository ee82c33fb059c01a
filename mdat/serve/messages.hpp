// Messages of recordings (CDR), read back.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fsw/core/span.hpp"
#include "mdat/recording/ros_messages.hpp"

namespace lasso::mdat::serve {

struct StampedPose {
  std::string frame;
  double time_s = 0;
  Pose pose;
};

struct LogMessage {
  double time_s = 0;
  std::uint8_t level = 0;
  std::string name, text;
};

// A PointCloud2 as it lies in its message: numbers of each point by their fields.
class CloudView {
 public:
  struct Field {
    std::string name;
    std::uint32_t offset = 0;
    std::uint8_t type = 0;  // of sensor_msgs/PointField: 1 to 8
  };
  std::string frame;
  double time_s = 0;
  std::vector<Field> fields;
  std::uint32_t width = 0, height = 0, step = 0;  // points of a row, rows, bytes of a point
  std::uint64_t row_step = 0;                     // bytes from row to row
  bool big_endian = false;
  std::string_view data;

  std::size_t size() const { return static_cast<std::size_t>(width) * height; }
  const Field* field(std::string_view name) const;
  // NaN where there is no such field (null).
  float value(std::size_t point, const Field* field) const;
};

struct SurfaceTriangles {
  std::string frame;
  std::vector<std::array<float, 3>> points;
  std::vector<std::uint32_t> indices;  // three a triangle
};

// Each: none, where the message is shorter than it says, or is none of this type. The views of a cloud are into `message`.
std::optional<StampedPose> read_pose(std::string_view message);  // PoseStamped, and what begins like it
std::optional<std::vector<ros::FrameTransform>> read_transforms(std::string_view message);
std::optional<LogMessage> read_log(std::string_view message);
std::optional<CloudView> read_cloud(std::string_view message);
std::optional<ConstBytes> read_packet(std::string_view message);
std::optional<SurfaceTriangles> read_surface(std::string_view message);  // of a SceneUpdate the first entity

}  // namespace lasso::mdat::serve
