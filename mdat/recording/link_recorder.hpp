// Telemetry that comes over a link, as the messages of a run: recorded, and sent to viewers. What a link does not carry is absent: scans,
// true poses.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "fsw/link/pose_telemetry.hpp"
#include "mdat/link/decode.hpp"
#include "mdat/recording/frame_recorder.hpp"

namespace lasso::mdat {

struct LinkRecorderOptions {
  std::filesystem::path file;    // empty: none is written
  const Mesh* target = nullptr;  // its surface, which outlives the recorder; null: not known
  RecordingHead head;
  MessageTap* tap = nullptr;  // outlives it
};

class LinkRecorder {
 public:
  // Throws InputError where the file cannot be written; so do all calls.
  explicit LinkRecorder(LinkRecorderOptions options);

  // A packet of telemetry, in the order in which they come. Messages have the component's own time, which its poses have. Where this clock
  // begins anew, after a reset, the recording goes on in a further file: FILE-2.mcap.
  void take(const DecodedPacket& packet);
  // All so far is in the file; its bytes (FrameRecorder).
  std::uint64_t flush() { return recorder_->flush(); }
  void close();

  // The last one is being written.
  const std::vector<std::filesystem::path>& files() const { return files_; }
  // Packets `pose`, those of them that are valid, and the last one.
  std::uint64_t frames() const { return frames_; }
  std::uint64_t valid_frames() const { return valid_frames_; }
  const std::optional<PoseTelemetry>& last() const { return last_; }

 private:
  void begin();
  void write(const DecodedPacket& packet, TimeUs header_us, const std::optional<PoseTelemetry>& pose);
  void write_held();

  const LinkRecorderOptions options_;
  std::vector<std::filesystem::path> files_;
  std::unique_ptr<FrameRecorder> recorder_;
  std::optional<TimeUs> offset_us_;  // of times in headers to the component's own
  TimeUs latest_us_ = 0;
  std::vector<std::vector<std::uint8_t>> held_;  // until the offset is known
  std::uint64_t frames_ = 0, valid_frames_ = 0;
  std::optional<PoseTelemetry> last_;
};

}  // namespace lasso::mdat
