// A recording that is open: its frames, values and events in memory (some 1.3 kB a frame), its scans and messages in the file, by index.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fsw/link/pose_telemetry.hpp"
#include "mdat/mcap/indexed_file.hpp"
#include "mdat/serve/chunk_cache.hpp"
#include "mdat/serve/flown_image.hpp"
#include "mdat/serve/messages.hpp"
#include "mdat/serve/value_table.hpp"

namespace lasso::mdat::serve {

// One report of the component on a scan: one packet `pose`. Of a recording by another program: one cloud of points.
struct Frame {
  double time_s = 0;                         // to which its poses belong
  std::uint64_t time_ns = 0;                 // the same, as messages are stamped
  std::uint64_t stated_ns = 0, told_ns = 0;  // as its packet states it, and when the packet came
  std::uint32_t chunk = 0;                   // that its packet is in
  std::uint8_t mode = 0, reason = 0;
  bool valid = false;
  std::optional<bool> wrong;  // none: no truth
};

struct RecordedEvent {
  double time_s = 0;
  std::size_t frame = 0;  // the last one that is not later
  std::uint8_t level = 0;
  std::string name, text;
};

constexpr double kNearest_s = 0.5;

// Safe for several threads once it is made.
class Recording {
 public:
  // Reads index, packets, true poses and events. Throws InputError where the file is no recording.
  explicit Recording(const std::filesystem::path& file);
  // Of a run that flies: the first `whole` bytes of its file (mcap::IndexedFile).
  Recording(const std::filesystem::path& file, std::uint64_t whole);
  // The same later: a copy with what was added. Of a recording that the constructor above made.
  std::shared_ptr<const Recording> grown(std::uint64_t whole) const;

  const mcap::IndexedFile& file() const { return file_; }
  bool own() const { return own_; }  // by mdat run --record
  bool has_truth() const { return truth_; }
  const std::vector<Frame>& frames() const { return frames_; }
  const std::vector<Value>& values() const { return values_; }
  const Value* value(const std::string& id) const;  // null: there is none
  const ValueTable& table(const Value& value) const { return tables_[value.table]; }
  const std::vector<float>& column(const Value& value) const { return tables_[value.table].columns[value.column]; }
  const std::vector<RecordedEvent>& events() const { return events_; }
  const LoadedImage* image() const { return image_.get(); }  // that flew; null: none that can be loaded
  const std::vector<std::string>& damage() const { return damage_; }

  // Of frame n: its telemetry; none: it cannot be read, or is of another program.
  std::optional<PoseTelemetry> told(std::size_t n) const;
  std::optional<Pose> truth(std::size_t n) const;
  // The message of a topic at the frame's time; empty, where there is none.
  std::string message(std::size_t n, const std::string& topic) const;
  std::string first_message(const std::string& topic) const;
  // Of another program's recording: the pose that is told nearest to frame n, on the first topic of poses; none: not within kNearest_s.
  std::optional<Pose> other_pose(std::size_t n) const;
  std::string cloud_topic() const { return cloud_topic_; }  // of scans; empty: there is none

 private:
  struct Building;
  struct UnpackedChunk;
  static std::vector<UnpackedChunk> unpacked_chunks(const mcap::IndexedFile& file, const std::vector<std::size_t>& wanted,
                                                    std::size_t first);
  Recording(const Recording& before, std::uint64_t whole);
  void look_at_head();
  std::map<std::uint16_t, std::string> topics_read_whole() const;
  void build();
  void take_new_chunks();
  void take_chunk(const UnpackedChunk& chunk, Building& building);
  void take(const mcap::Message& message, std::size_t chunk, Building& building);
  void take_packet(const mcap::Message& message, std::size_t chunk, Building& building);
  void add_pose(const mcap::Message& message, ConstBytes packet, std::size_t chunk, Building& building);
  void judge_waiting(Building& building, std::size_t keep);
  void finish(Building& building);
  void find_frames_of_clouds();
  void find_other_poses();
  void add_other_values(const std::string& topic);
  void number_events();

  mcap::IndexedFile file_;
  mutable ChunkCache cache_;
  bool own_ = false, truth_ = false;
  std::string cloud_topic_;
  std::shared_ptr<const LoadedImage> image_;
  std::vector<Frame> frames_;
  std::vector<Value> values_;
  std::map<std::string, std::size_t> by_id_;
  std::vector<ValueTable> tables_;
  std::vector<RecordedEvent> events_;
  std::vector<StampedPose> other_poses_;  // ascending times
  std::vector<std::string> damage_;
  std::shared_ptr<Building> building_;  // of a run that flies
  std::size_t taken_ = 0;               // of its chunks
};

}  // namespace lasso::mdat::serve
