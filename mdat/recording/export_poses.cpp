#include <cmath>
#include <cstdio>
#include <optional>

#include "fsw/geometry/se3.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/recording/recording_export.hpp"
#include "mdat/recording/recording_tables.hpp"
#include "mdat/scene/ccsds_epoch.hpp"

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;
using mcap::MessageValue;

const std::set<std::string>& pose_schemas() {
  static const std::set<std::string> kSchemas = {"geometry_msgs/msg/PoseStamped", "geometry_msgs/msg/PoseWithCovarianceStamped",
                                                 "nav_msgs/msg/Odometry"};
  return kSchemas;
}

// A pose of a trajectory; its velocity in the axes of the frame that it is stated in.
struct TimedPose {
  double t_s = 0;
  Pose pose;
  std::optional<Vec3> v_mps;
};
using TimedPoses = std::vector<TimedPose>;

Vec3 vector_of(const MessageValue& value) {
  return {value.at("x").get<double>(), value.at("y").get<double>(), value.at("z").get<double>()};
}

TimedPose timed_pose(const TopicMessage& message) {
  const MessageValue& outer = message.value.at("pose");
  const MessageValue& pose = outer.contains("pose") ? outer.at("pose") : outer;
  const MessageValue& stamp = message.value.at("header").at("stamp");
  TimedPose result;
  result.t_s = stamp.at("sec").get<double>() + 1e-9 * stamp.at("nanosec").get<double>();
  result.pose.p = vector_of(pose.at("position"));
  const MessageValue& q = pose.at("orientation");
  result.pose.q = Quat(q.at("w").get<double>(), q.at("x").get<double>(), q.at("y").get<double>(), q.at("z").get<double>());
  if (message.value.contains("twist"))
    result.v_mps = rotate(result.pose.q, vector_of(message.value.at("twist").at("twist").at("linear")));  // ROS: in the child's axes
  return result;
}

std::map<std::string, TimedPoses> poses_of(const fs::path& file, const ExportOptions& options) {
  std::map<std::string, TimedPoses> result;
  const auto wanted = [&](const TopicName& name) {
    return pose_schemas().count(name.schema) > 0 && (options.topic.empty() || name.topic == options.topic);
  };
  (void)read_topics(file, options.span, wanted, [&](const TopicMessage& message) { result[message.topic].push_back(timed_pose(message)); });
  return result;
}

TimedPoses poses_of_topic(const fs::path& file, ExportOptions options) {
  options.topic = choose_topic(file, options.topic, pose_schemas(), "/odom");
  std::map<std::string, TimedPoses> all = poses_of(file, options);
  TimedPoses poses = std::move(all[options.topic]);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    if (!(poses[i].t_s > poses[i - 1].t_s))
      throw InputError(file.string() + ": " + options.topic + ": its times go back: an ephemeris has them in order");
  }
  if (poses.size() < 2)
    throw InputError(file.string() + ": " + options.topic + ": fewer than two poses in this span: an ephemeris needs two");
  return poses;
}

template <class... Values>
void append_line(std::string& text, const char* format, Values... values) {
  char line[400];
  (void)std::snprintf(line, sizeof line, format, values...);
  text += line;
}

// The derivative, at the i-th, of the parabola through three neighbours; of two poses, of the line.
Vec3 velocity_of(const TimedPoses& poses, std::size_t i) {
  const std::optional<Vec3>& told_mps = poses[i].v_mps;
  if (told_mps.has_value()) return *told_mps;
  if (poses.size() == 2) return (poses[1].pose.p - poses[0].pose.p) / (poses[1].t_s - poses[0].t_s);
  const std::size_t middle = std::min(std::max<std::size_t>(i, 1), poses.size() - 2);
  const TimedPose &a = poses[middle - 1], &b = poses[middle], &c = poses[middle + 1];
  const double t_s = poses[i].t_s;
  return a.pose.p * ((2 * t_s - b.t_s - c.t_s) / ((a.t_s - b.t_s) * (a.t_s - c.t_s))) +
         b.pose.p * ((2 * t_s - a.t_s - c.t_s) / ((b.t_s - a.t_s) * (b.t_s - c.t_s))) +
         c.pose.p * ((2 * t_s - a.t_s - b.t_s) / ((c.t_s - a.t_s) * (c.t_s - b.t_s)));
}

// Calendar day of the Gregorian calendar from days since 1970-01-01 (H. Hinnant's algorithm, with years that begin in March).
std::string date_text(std::int64_t day) {
  const std::int64_t z = day + 719468, era = (z >= 0 ? z : z - 146096) / 146097, of_era = z - era * 146097;
  const std::int64_t year_of_era = (of_era - of_era / 1460 + of_era / 36524 - of_era / 146096) / 365;
  const std::int64_t of_year = of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100), month = (5 * of_year + 2) / 153;
  const std::int64_t m = month < 10 ? month + 3 : month - 9;
  const std::int64_t year = year_of_era + era * 400 + (m <= 2 ? 1 : 0), date = of_year - (153 * month + 2) / 5 + 1;
  std::string text;
  append_line(text, "%04lld-%02lld-%02lld", static_cast<long long>(year), static_cast<long long>(m), static_cast<long long>(date));
  return text;
}

// To the nearest microsecond.
std::string epoch_text(const scene::Epoch& zero, double t_s) {
  constexpr std::int64_t kUsOfDay = 86'400'000'000;
  const std::int64_t us = std::llround(zero.second * 1e6) + std::llround(t_s * 1e6);
  const std::int64_t days = us / kUsOfDay, rest = us % kUsOfDay;
  std::string text = date_text(zero.day + days);
  append_line(text, "T%02lld:%02lld:%02lld.%06lld", static_cast<long long>(rest / 3'600'000'000),
              static_cast<long long>(rest / 60'000'000 % 60), static_cast<long long>(rest / 1'000'000 % 60),
              static_cast<long long>(rest % 1'000'000));
  return text;
}

scene::Epoch zero_of(const ExportOptions& options) {
  const std::optional<scene::Epoch> zero = scene::parse_epoch(options.epoch);
  if (!zero) throw InputError("--epoch " + options.epoch + ": expected a date and time, such as 2026-11-28T12:00:00");
  return *zero;
}

std::string span_lines(const TimedPoses& poses, const scene::Epoch& zero) {
  return "START_TIME = " + epoch_text(zero, poses.front().t_s) + "\nSTOP_TIME = " + epoch_text(zero, poses.back().t_s) + "\n";
}

}  // namespace

ExportedFiles export_tum(const fs::path& file, const ExportOptions& options) {
  if (!options.topic.empty()) (void)choose_topic(file, options.topic, pose_schemas(), options.topic);
  ExportedFiles result;
  for (const auto& [topic, poses] : poses_of(file, options)) {
    std::string text;
    for (const TimedPose& at : poses)
      append_line(text, "%.9f %.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", at.t_s, at.pose.p.x(), at.pose.p.y(), at.pose.p.z(),
                  at.pose.q.x(), at.pose.q.y(), at.pose.q.z(), at.pose.q.w());
    result.files[file_name_of(topic) + ".tum"] = text;
  }
  if (result.files.empty()) throw InputError(file.string() + ": no topic of poses has a message in this span");
  return result;
}

std::string export_oem(const fs::path& file, const ExportOptions& options) {
  const scene::Epoch zero = zero_of(options);
  const TimedPoses poses = poses_of_topic(file, options);
  std::string text = "CCSDS_OEM_VERS = 2.0\nCOMMENT origin of the target's frame in the axes of the sensor: z boresight, x right, y down\n";
  text += poses.front().v_mps ? "COMMENT velocities are those of the topic\n"
                              : "COMMENT velocities are derivatives of parabolas through three positions\n";
  text += "CREATION_DATE = " + epoch_text(zero, 0) +
          "\nORIGINATOR = MDAT\nMETA_START\nOBJECT_NAME = TARGET\nOBJECT_ID = TARGET\n"
          "CENTER_NAME = SENSOR\nREF_FRAME = SENSOR\nTIME_SYSTEM = TAI\n";
  text += span_lines(poses, zero) + "INTERPOLATION = HERMITE\nINTERPOLATION_DEGREE = 3\nMETA_STOP\n";
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Vec3 p_km = 1e-3 * poses[i].pose.p, v_kmps = 1e-3 * velocity_of(poses, i);
    text += epoch_text(zero, poses[i].t_s);
    append_line(text, " %.15g %.15g %.15g %.12g %.12g %.12g\n", p_km.x(), p_km.y(), p_km.z(), v_kmps.x(), v_kmps.y(), v_kmps.z());
  }
  return text;
}

std::string export_aem(const fs::path& file, const ExportOptions& options) {
  const scene::Epoch zero = zero_of(options);
  const TimedPoses poses = poses_of_topic(file, options);
  std::string text =
      "CCSDS_AEM_VERS = 1.0\nCOMMENT the target's frame in the axes of the sensor: z boresight, x right, y down\nCREATION_DATE = " +
      epoch_text(zero, 0) +
      "\nORIGINATOR = MDAT\nMETA_START\nOBJECT_NAME = TARGET\nOBJECT_ID = TARGET\nCENTER_NAME = SENSOR\n"
      "REF_FRAME_A = SENSOR\nREF_FRAME_B = SC_BODY_1\nATTITUDE_DIR = A2B\nTIME_SYSTEM = TAI\n";
  text += span_lines(poses, zero) + "ATTITUDE_TYPE = QUATERNION\nQUATERNION_TYPE = LAST\nMETA_STOP\nDATA_START\n";
  for (const TimedPose& at : poses) {
    text += epoch_text(zero, at.t_s);
    append_line(text, " %.15g %.15g %.15g %.15g\n", at.pose.q.x(), at.pose.q.y(), at.pose.q.z(), at.pose.q.w());
  }
  return text + "DATA_STOP\n";
}

}  // namespace lasso::mdat
