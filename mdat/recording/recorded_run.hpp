// A run as its recording holds it: everything that is needed to fly it again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hal_sim/sensor_recording.hpp"
#include "mdat/mcap/reader.hpp"
#include "mdat/recording/recording_head.hpp"
#include "mdat/run/command_stream.hpp"

namespace lasso::mdat {

struct RecordedRun {
  mcap::Text about;                          // as RecordingHead's
  std::map<std::string, std::string> files;  // attachments
  sim::SensorRecording scans;
  CommandStream commands;                   // of an operator, where it had a link (kLinkForm)
  std::string telemetry;                    // packets, in order: all that follow from `scans`
  std::uint64_t last_packet_ns = 0;         // time of the last of them
  std::optional<std::uint64_t> boundaries;  // that it passed, where it ended as it should
  bool whole = true;                        // false: damaged, or a part of a recording
  std::vector<mcap::Damage> damage;         // what could not be read
};

// Throws InputError that names the file: it cannot be read, is no MCAP file, has been written by another program, holds a scan that is
// none, does not begin where its run does, or is two runs in one.
RecordedRun read_recorded_run(const std::filesystem::path& file);

// What a file holds, for a person: who wrote it, its run, each topic with its messages, attachments with their sizes, and what is damaged.
// Of any MCAP file. Throws InputError as mcap::Reader.
std::string contents_text(const std::filesystem::path& file);

// Its mission's files, and those of its board's store, in a folder of their own, which goes with this object.
class MissionFolder {
 public:
  // Throws InputError: an attachment that would leave the folder; RunError: no folder can be made.
  explicit MissionFolder(const RecordedRun& run);
  ~MissionFolder();
  MissionFolder(const MissionFolder&) = delete;
  MissionFolder& operator=(const MissionFolder&) = delete;
  const std::filesystem::path& mission() const { return mission_; }
  std::filesystem::path file(const std::string& attachment) const { return folder_ / attachment; }  // of kMissionFolder
  std::filesystem::path store() const { return folder_ / kStoreFolder; }  // the board's, as it was; there where the run had one

 private:
  std::filesystem::path folder_, mission_;
};

}  // namespace lasso::mdat
