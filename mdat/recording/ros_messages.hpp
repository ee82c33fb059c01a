// Poses, scans and the like as ROS 2 messages: the bytes of each (mdat/mcap/cdr.hpp). ROS means by a pose's quaternion and a covariance's
// rotation what this project means (docs/conventions.md); its covariances have the translation first.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "fsw/core/time.hpp"
#include "fsw/geometry/se3.hpp"
#include "mdat/mcap/cdr.hpp"

namespace lasso::mdat::ros {

// What a message is stated in and when.
struct Header {
  TimeUs t_us = 0;
  std::string frame;
};

// The pose T_parent_child of one frame in another.
struct FrameTransform {
  std::string parent, child;
  Pose T_parent_child;
};

// At the begin of a message of another kind.
void put_header(const Header& header, mcap::CdrWriter& out);

std::string tf_bytes(TimeUs t_us, const std::vector<FrameTransform>& transforms);
std::string pose_bytes(const Header& header, const Pose& pose);
std::string pose_array_bytes(const Header& header, const std::vector<Pose>& poses);

// `covariance`: of rotation, then translation, in the axes of the header's frame.
std::string pose_with_covariance_bytes(const Header& header, const Pose& pose, const Mat6& covariance);

// Its translation first, row by row, as ROS has it.
std::vector<double> ros_covariance(const Mat6& covariance);

// ROS states rates in the child's axes: `rates` are in those of the header's frame. Their covariance is diagonal.
struct Odometry {
  std::string child;
  Pose pose;
  Twist rates;
  Vec6 pose_sigmas, rate_sigmas;  // rotation, then translation; in the header's axes
};
std::string odometry_bytes(const Header& header, const Odometry& odometry);

enum class FieldType : std::uint8_t { kUint8 = 2, kInt32 = 5, kFloat32 = 7 };
struct PointField {
  std::string name;
  std::uint32_t offset;
  FieldType type;
};
// Points of `step` bytes each, one behind the other.
struct PointCloud {
  std::vector<PointField> fields;
  std::uint32_t step = 0;
  std::string data;
};
std::string point_cloud_bytes(const Header& header, const PointCloud& cloud);

std::string png_bytes(const Header& header, std::string_view png);  // a CompressedImage

// A pinhole camera that looks along z of the header's frame, from `shift_m` along its x: 0, or the right camera's of a pair. The middle of
// the first pixel is 0, as in OpenCV.
struct CameraModel {
  std::uint32_t width = 0, height = 0;
  double focal_x_px = 0, focal_y_px = 0, center_x_px = 0, center_y_px = 0;
  std::array<double, 5> distortion{};  // plumb_bob: k1, k2, p1, p2, k3
  double shift_m = 0;
};
std::string camera_info_bytes(const Header& header, const CameraModel& camera);

enum class LogLevel : std::uint8_t { kInfo = 20, kWarn = 30, kError = 40, kFatal = 50 };
std::string log_bytes(TimeUs t_us, LogLevel level, const std::string& name, const std::string& text);

std::string packet_bytes(const Header& header, std::string_view packet);

// A surface that moves with its frame: triangles of indices into its points, metres.
struct Surface {
  std::string id, frame;
  const std::vector<Vec3>* points = nullptr;
  const std::vector<std::array<std::uint32_t, 3>>* triangles = nullptr;
  Vec3 color = Vec3::Ones();  // red, green, blue: 0 to 1
  double opacity = 1;
};
// Lines that move with their frame, one pixel wide: each point to the next (joined), or the first of two to the second.
struct Path {
  std::string id, frame;
  std::vector<Vec3> points;  // metres
  bool joined = false;
  Vec3 color = Vec3::Ones();
};
std::string scene_bytes(TimeUs t_us, const std::vector<Surface>& surfaces, const std::vector<Path>& paths = {});

}  // namespace lasso::mdat::ros
