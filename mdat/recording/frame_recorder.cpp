#include "mdat/recording/frame_recorder.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "fsw/link/event_rows.hpp"
#include "mdat/common/version.hpp"
#include "mdat/link/decode_text.hpp"
#include "mdat/recording/packet_messages.hpp"
#include "mdat/recording/registration_steps.hpp"
#include "mdat/recording/ros_schemas.hpp"
#include "mdat/run/case.hpp"
#include "mdat/run/true_target.hpp"

namespace lasso::mdat {
namespace {

constexpr double kTrueColor[] = {0.45, 0.75, 0.45}, kEstimateColor[] = {0.95, 0.65, 0.25},
                 kOtherColor[] = {0.6, 0.65, 0.7};  // red, green, blue
constexpr double kGhost = 0.35;                     // opacity of the true target

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
                             {"/sensor_scans", ros::packet, mcap::Bulk::kLarge},
                             {"/commands", ros::packet}};
// Of stereo cameras whose pictures are rendered. The file has them from the first pair on.
constexpr Topic kCameraTopics[] = {{"/camera/left/image/compressed", ros::compressed_image, mcap::Bulk::kLarge},
                                   {"/camera/left/camera_info", ros::camera_info},
                                   {"/camera/right/image/compressed", ros::compressed_image, mcap::Bulk::kLarge},
                                   {"/camera/right/camera_info", ros::camera_info}};
constexpr Topic kIterationTopics[] = {{"/iterations", ros::point_cloud, mcap::Bulk::kLarge}, {"/iteration_poses", ros::pose_array}};

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

// Of recorded_topics(), by their names.
const std::map<std::string, std::size_t>& tap_numbers() {
  static const std::map<std::string, std::size_t> kNumbers = [] {
    std::map<std::string, std::size_t> numbers;
    for (const Topic& topic : kTopics) numbers.emplace(topic.name, numbers.size());
    for (const Topic& topic : kCameraTopics) numbers.emplace(topic.name, numbers.size());
    for (const PacketRow* packet : told_packets()) numbers.emplace(packet_topic(*packet), numbers.size());
    return numbers;
  }();
  return kNumbers;
}

// `shift_m`: along the left camera's x, as far as both are alike and look the same way.
ros::CameraModel model_of(const PairCamera& camera, double shift_m) {
  return {static_cast<std::uint32_t>(camera.width),
          static_cast<std::uint32_t>(camera.height),
          camera.focal_x_px,
          camera.focal_y_px,
          camera.center_x_px,
          camera.center_y_px,
          camera.distortion,
          shift_m};
}

std::string scenario_in(const RecordingHead& head) {
  const auto said = head.about.find("scenario");
  return said != head.about.end() ? said->second : "";
}

// Those that are not `moved`, where it is of this mesh; else all.
std::vector<std::array<std::uint32_t, 3>> kept(const std::vector<std::array<std::uint32_t, 3>>& triangles, const std::vector<bool>& moved) {
  if (moved.size() != triangles.size()) return triangles;
  std::vector<std::array<std::uint32_t, 3>> still;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (!moved[i]) still.push_back(triangles[i]);
  }
  return still;
}

}  // namespace

RecordingContent recording_content(const std::string& name) {
  if (name == "replay") return RecordingContent::kReplay;
  return name == "iterations" ? RecordingContent::kIterations : RecordingContent::kAll;
}

std::vector<MessageTopic> recorded_topics() {
  std::vector<MessageTopic> topics;
  for (const Topic& topic : kTopics) topics.push_back({topic.name, topic.schema()});
  for (const Topic& topic : kCameraTopics) topics.push_back({topic.name, topic.schema()});
  for (const PacketRow* packet : told_packets()) topics.push_back({packet_topic(*packet), packet_schema(*packet)});
  return topics;
}

FrameRecorder::FrameRecorder(const std::filesystem::path& file, const CompiledMission& mission, const RecordingHead& head,
                             std::shared_ptr<sim::SensorRecording> scans, RecordingContent content, MessageTap* tap)
    : target_(&mission.mesh),
      frames_(std::in_place, mission.source, scenario_in(head)),
      tap_(tap),
      scans_(std::move(scans)),
      content_(content),
      sight_(std::make_unique<const SensorSight>(mission.source, scenario_in(head))) {
  if (content_ != RecordingContent::kReplay) model_ = make_target(mission.mesh);
  if (content_ == RecordingContent::kIterations)
    image_ = std::make_unique<LoadedImage>(mission.source.file.string(),
                                           image_bytes(mission, parameters_for(mission.source, scenario_in(head))));
  if (!file.empty()) open(file, head);
}

FrameRecorder::FrameRecorder(const std::filesystem::path& file, const Mesh* target, const RecordingHead& head, MessageTap* tap)
    : target_(target), tap_(tap), content_(RecordingContent::kAll) {
  if (!file.empty()) open(file, head);
}

void FrameRecorder::open(const std::filesystem::path& file, const RecordingHead& head) {
  mcap::Writer& writer = writer_.emplace(file, kRecordingProfile, "mdat");
  for (const Topic& topic : kTopics) {
    if (content_ != RecordingContent::kReplay || topic.schema == ros::packet) add_topic({topic.name, topic.schema()}, topic.bulk);
  }
  for (const Topic& topic : kIterationTopics) {
    if (content_ == RecordingContent::kIterations) add_topic({topic.name, topic.schema()}, topic.bulk);
  }
  for (const auto& [name, bytes] : head.files) writer.attach(name, "application/octet-stream", bytes, 0);
  writer.add_metadata(kRecordingMetadata, head.about);
}

void FrameRecorder::add_topic(const MessageTopic& topic, mcap::Bulk bulk) {
  if (!writer_) return;
  const auto [place, added] = schemas_.try_emplace(topic.schema.name, std::uint16_t{0});
  if (added) place->second = writer_->add_schema(topic.schema.name, "ros2msg", topic.schema.text);
  channels_[topic.name] = writer_->add_channel(topic.name, place->second, "cdr", {}, bulk);
}

void FrameRecorder::write(const std::string& topic, TimeUs t_us, const std::string& bytes) {
  if (writer_) writer_->write(channels_.at(topic), nanoseconds(t_us), bytes);
  if (tap_ != nullptr) tap_->on_message(tap_numbers().at(topic), nanoseconds(t_us), bytes);
}

void FrameRecorder::on_commands(TimeUs slot_us, ConstBytes bytes) {
  write("/commands", slot_us, ros::packet_bytes({slot_us, ""}, text_of(bytes)));
}

void FrameRecorder::on_packets(TimeUs boundary_us, ConstBytes packets) {
  ++boundaries_;
  ConstBytes rest = packets;
  while (const std::size_t size = packet_size(rest)) {
    const ConstBytes packet = rest.first(std::min(size, rest.size()));
    write("/packets", boundary_us, ros::packet_bytes({boundary_us, ""}, text_of(packet)));
    rest = rest.subspan(packet.size(), rest.size() - packet.size());
  }
  if (content_ != RecordingContent::kReplay) write_told(boundary_us, packets);
  on_scans(scans_.take(false));
}

void FrameRecorder::on_scans(sim::SensorRecording finished) {
  for (sim::SensorScan& scan : finished) {
    const TimeUs t_start_us = scan.t_start_us;
    sim::SensorRecording alone;
    alone.push_back(std::move(scan));
    write("/sensor_scans", t_start_us, ros::packet_bytes({t_start_us, ""}, text_of(sim::to_bytes(alone))));
  }
}

std::uint64_t FrameRecorder::flush() { return writer_ ? writer_->flush() : 0; }

void FrameRecorder::close(const std::vector<std::uint8_t>& image) {
  on_scans(scans_.take(true));
  if (!writer_) return;
  if (!image.empty()) writer_->attach(kImageAttachment, "application/octet-stream", text_of(image), 0);
  writer_->add_metadata(kRecordingEnd, {{kBoundaries, std::to_string(boundaries_)}});
  writer_->close();
}

// Each packet by the dictionary. The file has a packet's topic from the first one on.
void FrameRecorder::write_told(TimeUs boundary_us, ConstBytes packets) {
  for (const DecodedPacket& packet : decode_stream(packets, PacketType::kTelemetry, apid_of(packets)).packets) {
    if (packet.row == nullptr) continue;
    const std::string topic = packet_topic(*packet.row);
    if (channels_.count(topic) == 0) add_topic({topic, packet_schema(*packet.row)}, mcap::Bulk::kSmall);
    write(topic, boundary_us, packet_message(boundary_us, packet));
    write_event(boundary_us, packet);
  }
}

void FrameRecorder::write_event(TimeUs boundary_us, const DecodedPacket& packet) {
  const EventRow* event = event_of(packet);
  if (event == nullptr) return;
  write("/events", boundary_us, ros::log_bytes(boundary_us, level_of(event->severity), event->name, items_text(packet)));
}

// What is known of a run besides its estimates: the true target, and other bodies of its scene.
void FrameRecorder::add_true_surfaces(const std::vector<std::array<std::uint32_t, 3>>& still, std::vector<ros::Surface>& surfaces) const {
  if (!frames_) return;
  surfaces.push_back({"target, true", kTrueFrame, &target_->vertices, &still, Vec3(kTrueColor), kGhost});
  for (const SceneFrames::Body& body : frames_->bodies())
    surfaces.push_back({body.frame, body.frame, &body.surface->vertices, &body.surface->triangles, Vec3(kOtherColor), 1});
}

// Once: all of it moves with its frames. Lines of the sensors reach as far as the target.
void FrameRecorder::write_scene(TimeUs t_us, const FlownFrame* frame) {
  if (target_ == nullptr || std::exchange(scene_written_, true)) return;
  std::vector<ros::Surface> surfaces;
  std::vector<std::array<std::uint32_t, 3>> still;  // lives as long as the surfaces
  if (frames_) still = kept(target_->triangles, frames_->moved_triangles());
  add_true_surfaces(still, surfaces);
  surfaces.push_back({"target, estimated", kTargetFrame, &target_->vertices, &target_->triangles, Vec3(kEstimateColor), 1});
  std::vector<ros::Path> paths;
  if (frame != nullptr) {
    const double range_m = frame->truth.T_sensor_target.p.norm();
    paths = sight_->fields_of_view(range_m);
    if (!frame->samples.empty()) paths.push_back(scan_path(frame->samples, range_m));
  }
  write("/scene", t_us, ros::scene_bytes(t_us, surfaces, paths));
}

void FrameRecorder::write_poses(const PoseTelemetry& told, const Pose* truth) {
  const TimeUs t_us = told.t_measurement_us;
  const ros::Header header{t_us, kSensorFrame};
  const Pose estimate = registration_pose(told), filtered = filtered_pose(told);
  std::vector<ros::FrameTransform> frames = {{kWorldFrame, kSensorFrame, Pose{}}};
  if (frames_ && truth != nullptr) frames = frames_->true_frames(t_us, *truth);
  frames.push_back({kSensorFrame, kTargetFrame, estimate});
  frames.push_back({kSensorFrame, kFilteredFrame, filtered});
  if (sight_ && sight_->camera()) frames.push_back({kSensorFrame, kCameraFrame, *sight_->camera()});
  if (frames_) frames.insert(frames.end(), frames_->estimated_frames().begin(), frames_->estimated_frames().end());
  write("/tf", t_us, ros::tf_bytes(t_us, frames));
  if (truth != nullptr) write("/truth", t_us, ros::pose_bytes(header, *truth));
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
  const SensorParameters& sensor = sight_->parameters(told.sensor);
  const ScanView view{frame.samples, t_us, registration_pose(told), rates, told.part, sensor.sigma0_m, sensor.sigma_k_per_m};
  write("/scan", t_us, ros::point_cloud_bytes({t_us, kSensorFrame}, scan_cloud(view, *model_)));
  write("/rays_missed", t_us, ros::point_cloud_bytes({t_us, kSensorFrame}, missed_cloud(view)));
  if (image_) write_iterations(view, told);
}

// Where nothing tells how the registration began, there are no messages.
void FrameRecorder::write_iterations(const ScanView& view, const PoseTelemetry& told) {
  const ros::Header header{view.t_us, kSensorFrame};
  RangeImage scan;
  if (!to_range_image(view.samples, scan)) return;
  const std::vector<RegistrationStep> steps = registration_steps(*image_, before_, told, scan);
  if (steps.empty()) return;
  const ScanView moved{view.samples, view.t_us, {}, {Vec3(before_.filter_omega_radps), Vec3(before_.filter_v_mps)}};
  const auto columns = static_cast<std::size_t>(image_->mission().parameters.iterations_max) + 2;  // the start, and a limit of none
  write("/iterations", view.t_us, ros::point_cloud_bytes(header, steps_cloud(moved, steps, columns, *model_)));
  std::vector<Pose> poses;
  for (const RegistrationStep& step : steps) poses.push_back(step.T_sensor_target);
  write("/iteration_poses", view.t_us, ros::pose_array_bytes(header, poses));
}

void FrameRecorder::write_picture(const std::string& camera, TimeUs t_us, const std::string& png, const ros::CameraModel& model) {
  const ros::Header header{t_us, kCameraFrame};
  write(camera + "/image/compressed", t_us, ros::png_bytes(header, png));
  write(camera + "/camera_info", t_us, ros::camera_info_bytes(header, model));
}

void FrameRecorder::on_pair(const TakenPair& pair) {
  if (content_ == RecordingContent::kReplay) return;
  for (const Topic& topic : kCameraTopics) {
    if (channels_.count(topic.name) == 0) add_topic({topic.name, topic.schema()}, topic.bulk);
  }
  write_picture("/camera/left", pair.t_us, pair.left_png, model_of(pair.stated.left, 0));
  write_picture("/camera/right", pair.t_us, pair.right_png, model_of(pair.stated.right, pair.stated.T_left_right.p.x()));
}

void FrameRecorder::on_frame(const FlownFrame& frame) {
  if (content_ == RecordingContent::kReplay) return;
  write_scene(frame.telemetry.t_measurement_us, &frame);
  write_poses(frame.telemetry, &frame.truth.T_sensor_target);
  write_scan(frame);
  before_ = frame.telemetry;
}

void FrameRecorder::on_report(const PoseTelemetry& told) {
  if (told.t_measurement_us <= 0) return;
  write_scene(told.t_measurement_us, nullptr);
  write_poses(told, nullptr);
}

}  // namespace lasso::mdat
