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

// A SceneEntity: it stays for ever, moves with its frame, and is triangles alone.
void put_entity(TimeUs t_us, const Surface& surface, CdrWriter& out) {
  constexpr int kBefore = 5, kBehind = 2;  // kinds of primitives, of which there are none: arrows to lines; texts and models
  put_header({t_us, surface.frame}, out);
  out.text(surface.id);
  out.put(std::int32_t{0}).put(std::uint32_t{0});  // lifetime
  put_flag(true, out);
  out.put(std::uint32_t{0});  // metadata
  for (int i = 0; i < kBefore; ++i) out.put(std::uint32_t{0});
  out.put(std::uint32_t{1});
  put_triangles(surface, out);
  for (int i = 0; i < kBehind; ++i) out.put(std::uint32_t{0});
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

std::string scene_bytes(TimeUs t_us, const std::vector<Surface>& surfaces) {
  CdrWriter out;
  out.put(std::uint32_t{0});  // deletions
  out.put(static_cast<std::uint32_t>(surfaces.size()));
  for (const Surface& surface : surfaces) put_entity(t_us, surface, out);
  return out.bytes();
}

}  // namespace lasso::mdat::ros
