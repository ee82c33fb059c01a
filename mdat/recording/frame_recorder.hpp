// A run as a recording that other people's tools open: MCAP, profile ros2, messages in CDR (docs/recordings.md says topic by topic what).
//
// Frames: `world`, at rest for a run without a scene; `sensor` in it; `target_true`, `target` (the registration, or where it did not run
// the prediction) and `target_filtered` in the sensor's. All are sent with every frame.
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
#include "mdat/mcap/writer.hpp"
#include "mdat/recording/message_tap.hpp"
#include "mdat/recording/recording_head.hpp"
#include "mdat/recording/ros_messages.hpp"
#include "mdat/run/run_listener.hpp"

namespace lasso::mdat {

constexpr char kRecordingProfile[] = "ros2";

// What a run has told of: the topics of its messages, in the order by which a tap knows them.
std::vector<MessageTopic> recorded_topics();

enum class RecordingContent { kAll, kReplay };  // kReplay: packets and what the sensors gave, which is all that mdat replay needs

class FrameRecorder final : public RunListener {
 public:
  // `mission` and `tap` outlive it. `scans`: where the run's sensors leave what they gave; each scan is taken out of it once it is whole.
  // Without a file the tap alone gets the messages. Throws InputError where the file cannot be written; so do all calls.
  FrameRecorder(const std::filesystem::path& file, const CompiledMission& mission, const RecordingHead& head,
                std::shared_ptr<sim::SensorRecording> scans, RecordingContent content = RecordingContent::kAll, MessageTap* tap = nullptr);

  void on_packets(TimeUs boundary_us, ConstBytes packets) override;
  void on_frame(const FlownFrame& frame) override;
  // All so far is in the file; returns its bytes, for who reads it while the run flies (mcap::IndexedFile). 0: there is no file.
  std::uint64_t flush();
  // Ends the file, with the flight image that flew; an empty one is left out.
  void close(const std::vector<std::uint8_t>& image);

 private:
  void open(const std::filesystem::path& file, const RecordingHead& head);
  void write(const char* topic, TimeUs t_us, const std::string& bytes);
  void write_surfaces(TimeUs t_us);
  void write_poses(const FlownFrame& frame);
  void write_scan(const FlownFrame& frame);
  void write_events(TimeUs boundary_us, ConstBytes packets);
  void take_scans(bool all);

  const CompiledMission& mission_;
  std::optional<mcap::Writer> writer_;
  MessageTap* tap_;
  std::map<std::string, std::uint16_t> channels_;  // of the file
  std::unique_ptr<sim::RayCaster> model_;          // as the component knows the target; null: only for replay
  std::shared_ptr<sim::SensorRecording> scans_;
  RecordingContent content_;
  std::size_t scans_taken_ = 0;
  bool surfaces_written_ = false;
};

}  // namespace lasso::mdat
