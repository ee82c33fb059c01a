#include "mdat/recording/frame_recorder.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "fsw/link/event_rows.hpp"
#include "mdat/common/version.hpp"
#include "mdat/link/decode.hpp"
#include "mdat/recording/ros_schemas.hpp"
#include "mdat/recording/scan_cloud.hpp"
#include "mdat/run/case.hpp"
#include "mdat/run/true_target.hpp"

namespace lasso::mdat {
namespace {

constexpr char kSensorFrame[] = "sensor", kTargetFrame[] = "target", kTrueFrame[] = "target_true", kFilteredFrame[] = "target_filtered";
constexpr double kTrueColor[] = {0.45, 0.75, 0.45}, kEstimateColor[] = {0.95, 0.65, 0.25};  // red, green, blue
constexpr double kGhost = 0.35;                                                             // opacity of the true target

struct Topic {
  const char* name;
  RosSchema (*schema)();
  mcap::Bulk bulk = mcap::Bulk::kSmall;
};
constexpr Topic kTopics[] = {{"/tf", ros::tf_message},
                             {"/scan", ros::point_cloud, mcap::Bulk::kLarge},
                             {"/rays_missed", ros::point_cloud, mcap::Bulk::kLarge},
                             {"/pose", ros::pose_stamped},
                             {"/pose_with_covariance", ros::pose_with_covariance},
                             {"/odom", ros::odometry},
                             {"/truth", ros::pose_stamped},
                             {"/scene", ros::scene_update, mcap::Bulk::kLarge},
                             {"/events", ros::log},
                             {"/packets", ros::packet},
                             {"/sensor_scans", ros::packet, mcap::Bulk::kLarge}};

std::uint64_t nanoseconds(TimeUs t_us) { return static_cast<std::uint64_t>(t_us) * 1000; }

std::string_view text_of(ConstBytes bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }
std::string_view text_of(const std::vector<std::uint8_t>& bytes) { return text_of(ConstBytes(bytes.data(), bytes.size())); }

Vec6 sigmas_of(const float (&values)[kPoseSigmas]) {
  Vec6 sigmas;
  for (int i = 0; i < 6; ++i) sigmas[i] = static_cast<double>(values[i]);
  return sigmas;
}

ros::LogLevel level_of(Severity severity) {
  if (severity == Severity::kHigh) return ros::LogLevel::kFatal;
  if (severity == Severity::kMedium) return ros::LogLevel::kError;
  return severity == Severity::kLow ? ros::LogLevel::kWarn : ros::LogLevel::kInfo;
}

const EventRow* event_of(const DecodedPacket& packet) {
  for (const EventRow& row : event_rows::kRows) {
    if (packet.row != nullptr && std::string_view(row.name) == packet.name()) return &row;
  }
  return nullptr;
}

// "item value, item value"
std::string items_text(const DecodedPacket& packet) {
  std::string text;
  for (const DecodedItem& item : packet.items) {
    text += (text.empty() ? "" : ", ") + std::string(item.row->name);
    for (const Number& number : item.values) {
      const Choice* choice = choice_of(*item.row, number);
      text += " " + (choice != nullptr ? std::string(choice->name) : mdat::text_of(number));
    }
  }
  return text;
}

}  // namespace

std::vector<MessageTopic> recorded_topics() {
  std::vector<MessageTopic> topics;
  for (const Topic& topic : kTopics) topics.push_back({topic.name, topic.schema()});
  return topics;
}

FrameRecorder::FrameRecorder(const std::filesystem::path& file, const CompiledMission& mission, const RecordingHead& head,
                             std::shared_ptr<sim::SensorRecording> scans, RecordingContent content, MessageTap* tap)
    : mission_(mission), tap_(tap), scans_(std::move(scans)), content_(content) {
  if (content_ == RecordingContent::kAll) model_ = make_target(mission.mesh);
  if (!file.empty()) open(file, head);
}

void FrameRecorder::open(const std::filesystem::path& file, const RecordingHead& head) {
  writer_.emplace(file, kRecordingProfile, "mdat");
  std::map<std::string, std::uint16_t> schemas;
  for (const Topic& topic : kTopics) {
    if (content_ == RecordingContent::kReplay && topic.schema != ros::packet) continue;
    const RosSchema schema = topic.schema();
    const auto [place, added] = schemas.try_emplace(schema.name, std::uint16_t{0});
    if (added) place->second = writer_->add_schema(schema.name, "ros2msg", schema.text);
    channels_[topic.name] = writer_->add_channel(topic.name, place->second, "cdr", {}, topic.bulk);
  }
  for (const auto& [name, bytes] : head.files) writer_->attach(name, "application/octet-stream", bytes, 0);
  writer_->add_metadata(kRecordingMetadata, head.about);
}

void FrameRecorder::write(const char* topic, TimeUs t_us, const std::string& bytes) {
  if (writer_) writer_->write(channels_.at(topic), nanoseconds(t_us), bytes);
  if (tap_ == nullptr) return;
  const auto* row =
      std::find_if(std::begin(kTopics), std::end(kTopics), [&](const Topic& one) { return std::string_view(one.name) == topic; });
  tap_->on_message(static_cast<std::size_t>(row - std::begin(kTopics)), nanoseconds(t_us), bytes);
}

void FrameRecorder::on_packets(TimeUs boundary_us, ConstBytes packets) {
  ConstBytes rest = packets;
  while (const std::size_t size = packet_size(rest)) {
    const ConstBytes packet = rest.first(std::min(size, rest.size()));
    write("/packets", boundary_us, ros::packet_bytes({boundary_us, ""}, text_of(packet)));
    rest = rest.subspan(packet.size(), rest.size() - packet.size());
  }
  if (content_ == RecordingContent::kAll) write_events(boundary_us, packets);
  take_scans(false);
}

// In the order in which they were begun. One that no later scan of its sensor follows may still be under way.
void FrameRecorder::take_scans(bool all) {
  if (!scans_) return;
  const auto is_followed = [&](std::size_t at) {
    return std::any_of(scans_->begin() + static_cast<std::ptrdiff_t>(at) + 1, scans_->end(),
                       [&](const sim::SensorScan& later) { return later.sensor == (*scans_)[at].sensor; });
  };
  for (; scans_taken_ < scans_->size() && (all || is_followed(scans_taken_)); ++scans_taken_) {
    sim::SensorScan& scan = (*scans_)[scans_taken_];
    const std::vector<std::uint8_t> bytes = sim::to_bytes({scan});
    write("/sensor_scans", scan.t_start_us, ros::packet_bytes({scan.t_start_us, ""}, text_of(bytes)));
    scan.samples = {};
  }
}

std::uint64_t FrameRecorder::flush() { return writer_ ? writer_->flush() : 0; }

void FrameRecorder::close(const std::vector<std::uint8_t>& image) {
  take_scans(true);
  if (!writer_) return;
  if (!image.empty()) writer_->attach(kImageAttachment, "application/octet-stream", text_of(image), 0);
  writer_->close();
}

void FrameRecorder::write_events(TimeUs boundary_us, ConstBytes packets) {
  for (const DecodedPacket& packet : decode_stream(packets, PacketType::kTelemetry).packets) {
    const EventRow* event = event_of(packet);
    if (event == nullptr) continue;
    write("/events", boundary_us, ros::log_bytes(boundary_us, level_of(event->severity), event->name, items_text(packet)));
  }
}

// Once: both move with their frames.
void FrameRecorder::write_surfaces(TimeUs t_us) {
  if (std::exchange(surfaces_written_, true)) return;
  const Mesh& mesh = mission_.mesh;
  write("/scene", t_us,
        ros::scene_bytes(t_us, {{"target, true", kTrueFrame, &mesh.vertices, &mesh.triangles, Vec3(kTrueColor), kGhost},
                                {"target, estimated", kTargetFrame, &mesh.vertices, &mesh.triangles, Vec3(kEstimateColor), 1}}));
}

void FrameRecorder::write_poses(const FlownFrame& frame) {
  const PoseTelemetry& told = frame.telemetry;
  const TimeUs t_us = told.t_measurement_us;
  const ros::Header header{t_us, kSensorFrame};
  const Pose estimate = registration_pose(told), filtered = filtered_pose(told);
  write("/tf", t_us,
        ros::tf_bytes(t_us, {{"world", kSensorFrame, Pose{}},
                             {kSensorFrame, kTrueFrame, frame.truth.T_sensor_target},
                             {kSensorFrame, kTargetFrame, estimate},
                             {kSensorFrame, kFilteredFrame, filtered}}));
  write("/truth", t_us, ros::pose_bytes(header, frame.truth.T_sensor_target));
  const Twist rates{Vec3(told.filter_omega_radps), Vec3(told.filter_v_mps)};
  write("/odom", t_us,
        ros::odometry_bytes(header,
                            {kFilteredFrame, filtered, rates, sigmas_of(told.filter_sigma_pose), sigmas_of(told.filter_sigma_rates)}));
  if (told.valid == 0) return;
  write("/pose", t_us, ros::pose_bytes(header, estimate));
  write("/pose_with_covariance", t_us, ros::pose_with_covariance_bytes(header, estimate, registration_covariance(told)));
}

void FrameRecorder::write_scan(const FlownFrame& frame) {
  if (frame.samples.empty()) return;
  const PoseTelemetry& told = frame.telemetry;
  const TimeUs t_us = told.t_measurement_us;
  const Twist rates{Vec3(told.filter_omega_radps), Vec3(told.filter_v_mps)};
  const ScanView view{frame.samples, t_us, registration_pose(told), rates};
  write("/scan", t_us, ros::point_cloud_bytes({t_us, kSensorFrame}, scan_cloud(view, *model_)));
  write("/rays_missed", t_us, ros::point_cloud_bytes({t_us, kSensorFrame}, missed_cloud(view)));
}

void FrameRecorder::on_frame(const FlownFrame& frame) {
  if (content_ == RecordingContent::kReplay) return;
  write_surfaces(frame.telemetry.t_measurement_us);
  write_poses(frame);
  write_scan(frame);
}

}  // namespace lasso::mdat
