#include "mdat/recording/ros_messages.hpp"

namespace lasso::mdat::ros {
namespace {

using mcap::CdrWriter;

constexpr std::int64_t kUsPerSecond = 1'000'000;

void put_time(TimeUs t_us, CdrWriter& out) {
  const std::int64_t seconds = t_us / kUsPerSecond - (t_us % kUsPerSecond < 0 ? 1 : 0);
  out.put(static_cast<std::int32_t>(seconds));
  out.put(static_cast<std::uint32_t>((t_us - seconds * kUsPerSecond) * 1000));
}

void put_vector(const Vec3& vector, CdrWriter& out) {
  for (int i = 0; i < 3; ++i) out.put(vector[i]);
}

void put_pose(const Pose& pose, CdrWriter& out) {
  put_vector(pose.p, out);
  for (const double value : {pose.q.x(), pose.q.y(), pose.q.z(), pose.q.w()}) out.put(value);
}

void put_color(const Vec3& color, double opacity, CdrWriter& out) {
  put_vector(color, out);
  out.put(opacity);
}

void put_triangles(const Surface& surface, CdrWriter& out) {
  put_pose(Pose{}, out);
  out.put(static_cast<std::uint32_t>(surface.points->size()));
  for (const Vec3& point : *surface.points) put_vector(point, out);
  put_color(surface.color, surface.opacity, out);
  out.put(std::uint32_t{0});  // colours of the points
  out.put(static_cast<std::uint32_t>(3 * surface.triangles->size()));
  for (const auto& triangle : *surface.triangles) {
    for (const std::uint32_t index : triangle) out.put(index);
  }
}

void put_flag(bool flag, CdrWriter& out) { out.put(static_cast<std::uint8_t>(flag)); }

void put_path(const Path& path, CdrWriter& out) {
  constexpr std::uint8_t kStrip = 0, kList = 2;
  out.put(path.joined ? kStrip : kList);
  put_pose(Pose{}, out);
  out.put(1.0);  // pixels
  put_flag(true, out);
  out.put(static_cast<std::uint32_t>(path.points.size()));
  for (const Vec3& point : path.points) put_vector(point, out);
  put_color(path.color, 1, out);
  out.put(std::uint32_t{0});  // colours of the points
  out.put(std::uint32_t{0});  // indices
}

// Kinds of primitives of an entity, of which there are none.
void put_none(int kinds, CdrWriter& out) {
  for (int i = 0; i < kinds; ++i) out.put(std::uint32_t{0});
}

// The begin of a SceneEntity, which stays for ever and moves with its frame, up to its lines.
void put_entity(TimeUs t_us, const std::string& id, const std::string& frame, CdrWriter& out) {
  constexpr int kBeforeLines = 4;
  put_header({t_us, frame}, out);
  out.text(id);
  out.put(std::int32_t{0}).put(std::uint32_t{0});  // lifetime
  put_flag(true, out);
  out.put(std::uint32_t{0});  // metadata
  put_none(kBeforeLines, out);
}

void put_surface(TimeUs t_us, const Surface& surface, CdrWriter& out) {
  put_entity(t_us, surface.id, surface.frame, out);
  put_none(1, out);  // lines
  out.put(std::uint32_t{1});
  put_triangles(surface, out);
  put_none(2, out);  // texts and models
}

void put_lines(TimeUs t_us, const Path& path, CdrWriter& out) {
  put_entity(t_us, path.id, path.frame, out);
  out.put(std::uint32_t{1});
  put_path(path, out);
  put_none(3, out);  // triangles, texts and models
}

}  // namespace

void put_header(const Header& header, CdrWriter& out) {
  put_time(header.t_us, out);
  out.text(header.frame);
}

std::string tf_bytes(TimeUs t_us, const std::vector<FrameTransform>& transforms) {
  CdrWriter out;
  out.put(static_cast<std::uint32_t>(transforms.size()));
  for (const FrameTransform& transform : transforms) {
    put_header({t_us, transform.parent}, out);
    out.text(transform.child);
    put_pose(transform.T_parent_child, out);  // as a transform's: the translation, then the quaternion
  }
  return out.bytes();
}

std::string pose_bytes(const Header& header, const Pose& pose) {
  CdrWriter out;
  put_header(header, out);
  put_pose(pose, out);
  return out.bytes();
}

std::string pose_array_bytes(const Header& header, const std::vector<Pose>& poses) {
  CdrWriter out;
  put_header(header, out);
  out.put(static_cast<std::uint32_t>(poses.size()));
  for (const Pose& pose : poses) put_pose(pose, out);
  return out.bytes();
}

std::vector<double> ros_covariance(const Mat6& covariance) {
  std::vector<double> values;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) values.push_back(covariance((row + 3) % 6, (column + 3) % 6));
  }
  return values;
}

std::string pose_with_covariance_bytes(const Header& header, const Pose& pose, const Mat6& covariance) {
  CdrWriter out;
  put_header(header, out);
  put_pose(pose, out);
  for (const double value : ros_covariance(covariance)) out.put(value);
  return out.bytes();
}

std::string odometry_bytes(const Header& header, const Odometry& odometry) {
  const Mat3 R_child_parent = to_matrix(odometry.pose.q).transpose();
  const Mat6 pose_covariance = odometry.pose_sigmas.cwiseAbs2().asDiagonal();
  Mat6 rates = odometry.rate_sigmas.cwiseAbs2().asDiagonal();
  for (const int at : {0, 3}) rates.block<3, 3>(at, at) = R_child_parent * rates.block<3, 3>(at, at) * R_child_parent.transpose();
  CdrWriter out;
  put_header(header, out);
  out.text(odometry.child);
  put_pose(odometry.pose, out);
  for (const double value : ros_covariance(pose_covariance)) out.put(value);
  put_vector(R_child_parent * odometry.rates.v_mps, out);
  put_vector(R_child_parent * odometry.rates.omega_radps, out);
  for (const double value : ros_covariance(rates)) out.put(value);
  return out.bytes();
}

std::string point_cloud_bytes(const Header& header, const PointCloud& cloud) {
  CdrWriter out;
  put_header(header, out);
  out.put(std::uint32_t{1});
  out.put(static_cast<std::uint32_t>(cloud.step > 0 ? cloud.data.size() / cloud.step : 0));
  out.put(static_cast<std::uint32_t>(cloud.fields.size()));
  for (const PointField& field : cloud.fields) {
    out.text(field.name);
    out.put(field.offset);
    out.put(static_cast<std::uint8_t>(field.type));
    out.put(std::uint32_t{1});
  }
  put_flag(false, out);
  out.put(cloud.step);
  out.put(static_cast<std::uint32_t>(cloud.data.size()));
  out.blob(cloud.data);
  put_flag(false, out);  // not dense: what has no place has NaN
  return out.bytes();
}

std::string png_bytes(const Header& header, std::string_view png) {
  CdrWriter out;
  put_header(header, out);
  out.text("png").blob(png);
  return out.bytes();
}

// Its pictures are rectified as they are: no rotation, and the projection is that of the camera itself.
std::string camera_info_bytes(const Header& header, const CameraModel& camera) {
  const double fx = camera.focal_x_px, fy = camera.focal_y_px, cx = camera.center_x_px, cy = camera.center_y_px;
  CdrWriter out;
  put_header(header, out);
  out.put(camera.height).put(camera.width).text("plumb_bob");
  out.put(static_cast<std::uint32_t>(camera.distortion.size()));
  for (const double term : camera.distortion) out.put(term);
  for (const double term : {fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0}) out.put(term);
  for (const double term : {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}) out.put(term);
  for (const double term : {fx, 0.0, cx, -fx * camera.shift_m, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0}) out.put(term);
  for (int binning_and_region = 0; binning_and_region < 6; ++binning_and_region) out.put(std::uint32_t{0});  // all pixels
  put_flag(false, out);
  return out.bytes();
}

std::string log_bytes(TimeUs t_us, LogLevel level, const std::string& name, const std::string& text) {
  CdrWriter out;
  put_time(t_us, out);
  out.put(static_cast<std::uint8_t>(level));
  out.text(name).text(text).text("").text("");
  out.put(std::uint32_t{0});
  return out.bytes();
}

std::string packet_bytes(const Header& header, std::string_view packet) {
  CdrWriter out;
  put_header(header, out);
  out.blob(packet);
  return out.bytes();
}

std::string scene_bytes(TimeUs t_us, const std::vector<Surface>& surfaces, const std::vector<Path>& paths) {
  CdrWriter out;
  out.put(std::uint32_t{0});  // deletions
  out.put(static_cast<std::uint32_t>(surfaces.size() + paths.size()));
  for (const Surface& surface : surfaces) put_surface(t_us, surface, out);
  for (const Path& path : paths) put_lines(t_us, path, out);
  return out.bytes();
}

}  // namespace lasso::mdat::ros
