#include "mdat/serve/messages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "mdat/mcap/cdr.hpp"

namespace lasso::mdat::serve {
namespace {

using mcap::CdrReader;

constexpr std::uint32_t kMostFields = 256;
constexpr float kNotThere = std::numeric_limits<float>::quiet_NaN();

double read_stamp(CdrReader& in) {
  const auto seconds = in.get<std::int32_t>();
  return seconds + 1e-9 * in.get<std::uint32_t>();
}

Vec3 read_vector(CdrReader& in) {
  Vec3 vector;
  for (int i = 0; i < 3; ++i) vector[i] = in.get<double>();
  return vector;
}

Pose read_bare_pose(CdrReader& in) {
  Pose pose;
  pose.p = read_vector(in);
  double q[4];
  for (double& value : q) value = in.get<double>();
  pose.q = Quat(q[3], q[0], q[1], q[2]);
  return pose;
}

template <class T>
float number_at(const char* bytes, bool big_endian) {
  std::array<char, sizeof(T)> own;
  std::memcpy(own.data(), bytes, sizeof(T));
  if (big_endian) std::reverse(own.begin(), own.end());
  T value;
  std::memcpy(&value, own.data(), sizeof value);
  return static_cast<float>(value);
}

struct NumberType {
  std::size_t size;
  float (*read)(const char*, bool big_endian);
};
// By the numbers of sensor_msgs/PointField.
constexpr NumberType kNumberTypes[] = {{0, nullptr},
                                       {1, number_at<std::int8_t>},
                                       {1, number_at<std::uint8_t>},
                                       {2, number_at<std::int16_t>},
                                       {2, number_at<std::uint16_t>},
                                       {4, number_at<std::int32_t>},
                                       {4, number_at<std::uint32_t>},
                                       {4, number_at<float>},
                                       {8, number_at<double>}};

bool is_within(const CloudView::Field& field, std::uint32_t step) {
  return field.type > 0 && field.type < std::size(kNumberTypes) && field.offset <= step &&
         kNumberTypes[field.type].size <= step - field.offset;
}

// Its points lie within its data. Rows may have bytes behind their points.
bool is_whole(CloudView& cloud) {
  const std::uint64_t row = std::uint64_t{cloud.width} * cloud.step;
  if (cloud.height <= 1) cloud.row_step = row;  // what a single row says of itself is often 0
  if (cloud.size() == 0) return true;
  const std::uint64_t rows = cloud.data.size() / std::max<std::uint64_t>(cloud.row_step, 1);  // whole ones
  const std::uint64_t rest = cloud.data.size() - rows * cloud.row_step;
  return row > 0 && cloud.row_step >= row && (rows >= cloud.height || (rows + 1 == cloud.height && rest >= row));
}

// Of a SceneEntity, up to its triangles. False: it has other primitives before them.
bool skip_to_triangles(CdrReader& in, std::string& frame) {
  constexpr int kBefore = 6;  // counts that have to be 0: metadata, arrows, cubes, spheres, cylinders, lines
  (void)read_stamp(in);
  frame = in.text();
  (void)in.text();
  (void)in.get<std::int32_t>();
  (void)in.get<std::uint32_t>();
  (void)in.get<std::uint8_t>();
  for (int i = 0; i < kBefore; ++i) {
    if (in.get<std::uint32_t>() != 0) return false;
  }
  return in.get<std::uint32_t>() > 0 && in.ok();
}

bool read_triangles(CdrReader& in, std::size_t most, SurfaceTriangles& surface) {
  (void)read_bare_pose(in);
  const auto points = in.get<std::uint32_t>();
  if (!in.ok() || points > most / (3 * sizeof(double))) return false;
  for (std::uint32_t i = 0; i < points; ++i) {
    const Vec3 point = read_vector(in);
    surface.points.push_back({static_cast<float>(point[0]), static_cast<float>(point[1]), static_cast<float>(point[2])});
  }
  for (int i = 0; i < 4; ++i) (void)in.get<double>();  // colour
  if (in.get<std::uint32_t>() != 0) return false;      // colours of the points
  const auto indices = in.get<std::uint32_t>();
  if (!in.ok() || indices > most / sizeof indices || indices % 3 != 0) return false;
  for (std::uint32_t i = 0; i < indices; ++i) surface.indices.push_back(in.get<std::uint32_t>());
  return in.ok() && std::all_of(surface.indices.begin(), surface.indices.end(), [&](std::uint32_t index) { return index < points; });
}

}  // namespace

const CloudView::Field* CloudView::field(std::string_view name) const {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field& row) { return row.name == name; });
  return found != fields.end() ? &*found : nullptr;
}

float CloudView::value(std::size_t point, const Field* field) const {
  if (field == nullptr || point >= size()) return kNotThere;
  const std::size_t at = point / width * row_step + point % width * step;
  return kNumberTypes[field->type].read(data.data() + at + field->offset, big_endian);
}

std::optional<StampedPose> read_pose(std::string_view message) {
  CdrReader in(message);
  StampedPose pose;
  pose.time_s = read_stamp(in);
  pose.frame = in.text();
  pose.pose = read_bare_pose(in);
  return in.ok() ? std::optional(pose) : std::nullopt;
}

std::optional<std::vector<ros::FrameTransform>> read_transforms(std::string_view message) {
  CdrReader in(message);
  std::vector<ros::FrameTransform> transforms;
  const auto count = in.get<std::uint32_t>();
  for (std::uint32_t i = 0; i < count && in.ok(); ++i) {
    ros::FrameTransform transform;
    (void)read_stamp(in);
    transform.parent = in.text();
    transform.child = in.text();
    transform.T_parent_child = read_bare_pose(in);
    transforms.push_back(std::move(transform));
  }
  return in.ok() ? std::optional(std::move(transforms)) : std::nullopt;
}

std::optional<LogMessage> read_log(std::string_view message) {
  CdrReader in(message);
  LogMessage log;
  log.time_s = read_stamp(in);
  log.level = in.get<std::uint8_t>();
  log.name = in.text();
  log.text = in.text();
  return in.ok() ? std::optional(std::move(log)) : std::nullopt;
}

std::optional<CloudView> read_cloud(std::string_view message) {
  CdrReader in(message);
  CloudView cloud;
  cloud.time_s = read_stamp(in);
  cloud.frame = in.text();
  cloud.height = in.get<std::uint32_t>();
  cloud.width = in.get<std::uint32_t>();
  const auto fields = in.get<std::uint32_t>();
  if (fields > kMostFields) return std::nullopt;
  for (std::uint32_t i = 0; i < fields && in.ok(); ++i) {
    CloudView::Field field;
    field.name = in.text();
    field.offset = in.get<std::uint32_t>();
    field.type = in.get<std::uint8_t>();
    (void)in.get<std::uint32_t>();
    cloud.fields.push_back(std::move(field));
  }
  cloud.big_endian = in.get<std::uint8_t>() != 0;
  cloud.step = in.get<std::uint32_t>();
  cloud.row_step = in.get<std::uint32_t>();
  cloud.data = in.blob();
  std::erase_if(cloud.fields, [&](const CloudView::Field& field) { return !is_within(field, cloud.step); });
  return in.ok() && is_whole(cloud) ? std::optional(std::move(cloud)) : std::nullopt;
}

std::optional<ConstBytes> read_packet(std::string_view message) {
  CdrReader in(message);
  (void)read_stamp(in);
  (void)in.text();
  const std::string_view data = in.blob();
  if (!in.ok()) return std::nullopt;
  return ConstBytes(reinterpret_cast<const std::uint8_t*>(data.data()), data.size());
}

std::optional<SurfaceTriangles> read_surface(std::string_view message) {
  CdrReader in(message);
  SurfaceTriangles surface;
  if (in.get<std::uint32_t>() != 0 || in.get<std::uint32_t>() == 0 || !skip_to_triangles(in, surface.frame)) return std::nullopt;
  return read_triangles(in, message.size(), surface) ? std::optional(std::move(surface)) : std::nullopt;
}

}  // namespace lasso::mdat::serve
