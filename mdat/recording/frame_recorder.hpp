// A run as a recording that other people's tools open: MCAP, profile ros2, messages in CDR (docs/recordings.md says topic by topic what).
//
// Frames: those of scene_frames.hpp, and in the sensor's `target` (the registration, or where it did not run the prediction) and
// `target_filtered`. All are sent with every frame.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal_sim/ray_caster.hpp"
#include "hal_sim/sensor_recording.hpp"
#include "mdat/common/flight_image.hpp"
#include "mdat/link/decode.hpp"
#include "mdat/mcap/writer.hpp"
#include "mdat/recording/finished_scans.hpp"
#include "mdat/recording/message_tap.hpp"
#include "mdat/recording/recording_head.hpp"
#include "mdat/recording/ros_messages.hpp"
#include "mdat/recording/scan_cloud.hpp"
#include "mdat/recording/scene_frames.hpp"
#include "mdat/recording/sensor_sight.hpp"
#include "mdat/run/run_listener.hpp"

namespace lasso::mdat {

constexpr char kRecordingProfile[] = "ros2";

// What a run has told of: the topics of its messages, in the order by which a tap knows them.
std::vector<MessageTopic> recorded_topics();

// kReplay: packets, and what sensors and operator gave, which is all that mdat replay needs. kIterations: all, and the residuals and poses
// of each registration's steps (registration_steps.hpp).
enum class RecordingContent { kAll, kReplay, kIterations };
RecordingContent recording_content(const std::string& name);  // of "replay" and "iterations"; else all

class FrameRecorder final : public RunListener {
 public:
  // `mission` and `tap` outlive it. `scans`: where the run's sensors leave what they gave; each scan is taken out of it once it is whole;
  // null: they come by on_scans. Without a file the tap alone gets the messages; `head` says the scenario then, too. Throws InputError
  // where the file cannot be written; so do all calls.
  FrameRecorder(const std::filesystem::path& file, const CompiledMission& mission, const RecordingHead& head,
                std::shared_ptr<sim::SensorRecording> scans, RecordingContent content = RecordingContent::kAll, MessageTap* tap = nullptr);
  // Of telemetry alone, without scans and true poses. `target`, which outlives it: its surface; null: it is not known.
  FrameRecorder(const std::filesystem::path& file, const Mesh* target, const RecordingHead& head, MessageTap* tap);

  void on_packets(TimeUs boundary_us, ConstBytes packets) override;
  void on_frame(const FlownFrame& frame) override;
  void on_commands(TimeUs slot_us, ConstBytes bytes) override;
  void on_pair(const TakenPair& pair) override;
  // Whole scans that sensors gave, each once, behind the packets of the boundary at which they are known to be whole.
  void on_scans(sim::SensorRecording finished);
  // A frame of which no more is known than what the component reports; one that has no scan leaves no message.
  void on_report(const PoseTelemetry& told);
  // All so far is in the file; returns its bytes, for who reads it while the run flies (mcap::IndexedFile). 0: there is no file.
  std::uint64_t flush();
  // Ends the file, with the flight image that flew; an empty one is left out.
  void close(const std::vector<std::uint8_t>& image);

 private:
  void open(const std::filesystem::path& file, const RecordingHead& head);
  void add_topic(const MessageTopic& topic, mcap::Bulk bulk);
  void write(const std::string& topic, TimeUs t_us, const std::string& bytes);
  void write_told(TimeUs boundary_us, ConstBytes packets);
  void add_true_surfaces(const std::vector<std::array<std::uint32_t, 3>>& still, std::vector<ros::Surface>& surfaces) const;
  void write_scene(TimeUs t_us, const FlownFrame* frame);
  void write_iterations(const ScanView& view, const PoseTelemetry& told);
  void write_poses(const PoseTelemetry& told, const Pose* truth);
  void write_scan(const FlownFrame& frame);
  void write_picture(const std::string& camera, TimeUs t_us, const std::string& png, const ros::CameraModel& model);
  void write_event(TimeUs boundary_us, const DecodedPacket& packet);

  const Mesh* target_;
  std::optional<SceneFrames> frames_;  // of a run; none: telemetry alone is known
  std::optional<mcap::Writer> writer_;
  MessageTap* tap_;
  std::map<std::string, std::uint16_t> schemas_, channels_;  // of the file
  std::unique_ptr<sim::RayCaster> model_;                    // as the component knows the target; null: only for replay
  FinishedScans scans_{nullptr};
  RecordingContent content_;
  bool scene_written_ = false;
  std::unique_ptr<const SensorSight> sight_;  // of a run
  std::unique_ptr<LoadedImage> image_;        // of kIterations
  PoseTelemetry before_{};                    // of the frame before
  std::uint64_t boundaries_ = 0;
};

}  // namespace lasso::mdat
