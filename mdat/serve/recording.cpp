#include "mdat/serve/recording.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <future>
#include <unordered_map>

#include "mdat/link/decode.hpp"
#include "mdat/recording/recording_head.hpp"
#include "mdat/serve/frame_facts.hpp"

namespace lasso::mdat::serve {
namespace {

constexpr double kNs = 1e-9;
constexpr std::size_t kFactsTable = 0;
constexpr std::size_t kTogether = 16;                         // chunks
constexpr std::size_t kTogetherBytes = std::size_t{1} << 26;  // of their records: a small file may unpack to any size
constexpr std::uint64_t kUsualLag_ns = 500'000'000;           // of reports behind their scans
constexpr std::size_t kPatience = 64;                         // reports that wait for their true poses
constexpr std::size_t kMostDamage = 100;                      // of chunks that cannot be read, each

bool is_pose(const PacketRow& row) { return std::string_view(row.name) == "pose"; }

bool is_event(const PacketRow& row) { return row.cause[0] != '\0'; }  // whose words are in /events

// The first topic of poses.
std::optional<std::uint16_t> first_of_poses(const mcap::IndexedFile& file) {
  for (const auto& [id, channel] : file.channels()) {
    const auto schema = file.schemas().find(channel.schema);
    if (schema == file.schemas().end()) continue;
    const std::string& name = schema->second.name;
    if (name == "geometry_msgs/msg/PoseStamped" || name == "geometry_msgs/msg/PoseWithCovarianceStamped") return id;
  }
  return std::nullopt;
}

// A report states the time of its scan; one before all scans has that of its boundary.
std::uint64_t stated_ns(const PoseTelemetry& pose, std::uint64_t told_ns) {
  return pose.t_measurement_us > 0 ? static_cast<std::uint64_t>(pose.t_measurement_us) * 1000 : told_ns;
}

}  // namespace

struct Recording::UnpackedChunk {
  std::size_t index = 0;
  std::string records, why;
};

// The next ones from `first` on of those that are wanted, at least one while there is one: another thread unpacks them while the ones
// before are taken.
std::vector<Recording::UnpackedChunk> Recording::unpacked_chunks(const mcap::IndexedFile& file, const std::vector<std::size_t>& wanted,
                                                                 std::size_t first) {
  std::vector<UnpackedChunk> chunks;
  std::size_t bytes = 0;
  for (std::size_t i = first; i < std::min(first + kTogether, wanted.size()) && bytes < kTogetherBytes; ++i) {
    chunks.emplace_back();
    chunks.back().index = wanted[i];
    chunks.back().records = file.records_of(file.chunks()[wanted[i]], chunks.back().why);
    bytes += chunks.back().records.size();
  }
  return chunks;
}

// What is known only while the file is read.
struct Recording::Building {
  struct Told {
    PoseTelemetry pose;
    double time_s = 0;
    std::uint64_t time_ns = 0, stated_ns = 0, told_ns = 0;
    std::uint32_t chunk = 0;
  };
  std::uint64_t time_ns_of(std::uint64_t stated_ns, std::uint64_t told_ns, bool scanned);
  std::map<std::uint16_t, std::string> topics;  // of the channels that are read whole
  std::map<const PacketRow*, PacketColumns> packets;
  std::unordered_map<std::uint64_t, Pose> truth;
  std::deque<Told> waiting;                          // for the true pose, which may come behind the packet
  std::uint64_t scan_ns = 0, lag_ns = kUsualLag_ns;  // of the last scan: its time, and how much later its first report was
};

Recording::Recording(const std::filesystem::path& file) : file_(file), cache_(file_) {
  for (const mcap::Damage& part : file_.damage()) damage_.push_back("byte " + std::to_string(part.at) + ": " + part.why);
  look_at_head();
  build();
}

Recording::Recording(const std::filesystem::path& file, std::uint64_t whole)
    : file_(file, whole), cache_(file_), building_(std::make_shared<Building>()) {
  tables_.emplace_back();
  take_new_chunks();
}

Recording::Recording(const Recording& before, std::uint64_t whole)
    : file_(before.file_),
      cache_(file_),
      truth_(before.truth_),
      image_(before.image_),
      frames_(before.frames_),
      tables_(before.tables_),
      events_(before.events_),
      damage_(before.damage_),
      building_(std::make_shared<Building>(*before.building_)),
      taken_(before.taken_) {
  file_.grow(whole);
  take_new_chunks();
}

std::shared_ptr<const Recording> Recording::grown(std::uint64_t whole) const {
  return std::shared_ptr<const Recording>(new Recording(*this, whole));
}

// Each boundary's messages are whole in the file: no report waits for its true pose longer than that.
void Recording::take_new_chunks() {
  look_at_head();
  building_->topics = topics_read_whole();
  for (; taken_ < file_.chunks().size(); ++taken_) {
    const mcap::ChunkPlace& place = file_.chunks()[taken_];
    const auto may_have = [&](const auto& topic) { return place.may_have(topic.first); };
    if (!std::any_of(building_->topics.begin(), building_->topics.end(), may_have)) continue;
    UnpackedChunk chunk;
    chunk.index = taken_;
    chunk.records = file_.records_of(place, chunk.why);
    take_chunk(chunk, *building_);
  }
  judge_waiting(*building_, 0);
  finish(*building_);
}

void Recording::look_at_head() {
  own_ = file_.metadata().count(kRecordingMetadata) > 0;
  if (own_ && !image_) image_ = flown_image(file_);
  for (const auto& [id, channel] : file_.channels()) {
    const auto schema = file_.schemas().find(channel.schema);
    const bool cloud = schema != file_.schemas().end() && schema->second.name == "sensor_msgs/msg/PointCloud2";
    if (cloud && (cloud_topic_.empty() || channel.topic == "/scan")) cloud_topic_ = channel.topic;
  }
}

std::map<std::uint16_t, std::string> Recording::topics_read_whole() const {
  std::map<std::uint16_t, std::string> topics;
  for (const auto& [id, channel] : file_.channels()) {
    if (channel.topic == "/packets" || channel.topic == "/truth" || channel.topic == "/events") topics[id] = channel.topic;
  }
  return topics;
}

void Recording::build() {
  Building building;
  building.topics = topics_read_whole();
  tables_.emplace_back();
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < file_.chunks().size(); ++i) {
    const auto may_have = [&](const auto& topic) { return file_.chunks()[i].may_have(topic.first); };
    if (std::any_of(building.topics.begin(), building.topics.end(), may_have)) wanted.push_back(i);
  }
  const auto read = [&](std::size_t first) { return unpacked_chunks(file_, wanted, first); };
  std::vector<UnpackedChunk> chunks = read(0);
  for (std::size_t first = 0; first < wanted.size();) {
    first += chunks.size();
    std::future<std::vector<UnpackedChunk>> next = std::async(std::launch::async, read, first);
    for (const UnpackedChunk& chunk : chunks) take_chunk(chunk, building);
    chunks = next.get();
  }
  judge_waiting(building, 0);
  finish(building);
}

void Recording::take_chunk(const UnpackedChunk& chunk, Building& building) {
  const std::uint64_t at = file_.chunks()[chunk.index].at;
  if (!chunk.why.empty() && damage_.size() < kMostDamage) damage_.push_back("byte " + std::to_string(at) + ": " + chunk.why);
  mcap::for_each_message(chunk.records, [&](const mcap::Message& message) { take(message, chunk.index, building); });
  judge_waiting(building, kPatience);
}

void Recording::take(const mcap::Message& message, std::size_t chunk, Building& building) {
  const auto topic = building.topics.find(message.channel);
  if (topic == building.topics.end()) return;
  if (topic->second == "/packets") return take_packet(message, chunk, building);
  if (topic->second == "/truth") {
    const std::optional<StampedPose> pose = read_pose(message.data);
    if (pose && is_valid(pose->pose)) building.truth[message.log_ns] = pose->pose;
    return;
  }
  const std::optional<LogMessage> log = read_log(message.data);
  if (log) events_.push_back({kNs * static_cast<double>(message.log_ns), 0, log->level, log->name, log->text});
}

void Recording::take_packet(const mcap::Message& message, std::size_t chunk, Building& building) {
  const std::optional<ConstBytes> packet = read_packet(message.data);
  if (!packet) return;
  const PacketRow* row = telemetry_row(*packet);
  if (row == nullptr || is_event(*row) || row->items.empty()) return;
  const auto [place, added] = building.packets.try_emplace(row, *row, tables_.size());
  if (added) tables_.emplace_back();
  if (is_pose(*row)) return add_pose(message, *packet, chunk, building);
  place->second.add(kNs * static_cast<double>(message.log_ns), *packet, tables_[place->second.values().front().table]);
}

// Where no scan comes, as in safe mode, reports state the time of the last one, which may be from before the recording. They get the time
// that a scan would have.
std::uint64_t Recording::Building::time_ns_of(std::uint64_t stated_ns, std::uint64_t told_ns, bool scanned) {
  const bool anew = scan_ns == 0 ? scanned || told_ns - std::min(told_ns, stated_ns) < 2 * kUsualLag_ns : stated_ns != scan_ns;
  scan_ns = stated_ns;
  if (!anew) return told_ns - std::min(told_ns, lag_ns);
  lag_ns = told_ns - std::min(told_ns, stated_ns);
  return stated_ns;
}

void Recording::add_pose(const mcap::Message& message, ConstBytes packet, std::size_t chunk, Building& building) {
  PacketHeader header;
  PoseTelemetry pose;
  if (decode_pose(packet, header, pose, apid_of(packet)) != PacketFault::kNone) return;
  const std::uint64_t stated = stated_ns(pose, message.log_ns), time_ns = building.time_ns_of(stated, message.log_ns, pose.rays > 0);
  const double time_s = kNs * static_cast<double>(time_ns);
  const PacketColumns& columns = building.packets.at(telemetry_row(packet));
  columns.add(time_s, packet, tables_[columns.values().front().table]);
  building.waiting.push_back({pose, time_s, time_ns, stated, message.log_ns, static_cast<std::uint32_t>(chunk)});
}

// In their order: those whose true pose is there, and all but the last `keep`.
void Recording::judge_waiting(Building& building, std::size_t keep) {
  while (!building.waiting.empty()) {
    const Building::Told& told = building.waiting.front();
    const auto found = building.truth.find(told.time_ns);
    const bool known = found != building.truth.end();
    if (!known && building.waiting.size() <= keep) return;
    const FrameFacts facts(told.pose, known ? std::optional(found->second) : std::nullopt);
    add_facts(told.time_s, facts, tables_[kFactsTable]);
    frames_.push_back({told.time_s, told.time_ns, told.stated_ns, told.told_ns, told.chunk, told.pose.mode, told.pose.reason,
                       told.pose.valid != 0, facts.wrong});
    truth_ = truth_ || known;
    if (known) building.truth.erase(found);
    building.waiting.pop_front();
  }
}

void Recording::finish(Building& building) {
  if (!frames_.empty()) values_ = fact_values(kFactsTable);
  if (!truth_) std::erase_if(values_, [](const Value& value) { return value.topic == "/truth"; });
  for (const auto& [row, columns] : building.packets) values_.insert(values_.end(), columns.values().begin(), columns.values().end());
  if (!own_ && !building_) find_other_poses();
  if (frames_.empty() && !building_) find_frames_of_clouds();
  for (std::size_t i = 0; i < values_.size(); ++i) by_id_[values_[i].id] = i;
  number_events();
}

// Of another program's recording: its clouds, by their times.
void Recording::find_frames_of_clouds() {
  const std::optional<std::uint16_t> channel = cloud_topic_.empty() ? std::nullopt : file_.channel_of(cloud_topic_);
  if (!channel) return;
  for (std::size_t i = 0; i < file_.chunks().size(); ++i) {
    if (!file_.chunks()[i].may_have(*channel)) continue;
    std::string why;
    const std::string records = file_.records_of(file_.chunks()[i], why);
    if (!why.empty() && damage_.size() < kMostDamage) damage_.push_back("byte " + std::to_string(file_.chunks()[i].at) + ": " + why);
    mcap::for_each_message(records, [&](const mcap::Message& message) {
      if (message.channel != *channel) return;
      Frame frame;
      frame.time_ns = message.log_ns;
      frame.time_s = kNs * static_cast<double>(message.log_ns);
      frame.chunk = static_cast<std::uint32_t>(i);
      frames_.push_back(frame);
    });
  }
  std::stable_sort(frames_.begin(), frames_.end(), [](const Frame& a, const Frame& b) { return a.time_ns < b.time_ns; });
}

// Position and attitude of a topic become values of it.
void Recording::find_other_poses() {
  const std::optional<std::uint16_t> found = first_of_poses(file_);
  if (!found) return;
  for (const mcap::ChunkPlace& chunk : file_.chunks()) {
    if (!chunk.may_have(*found)) continue;
    std::string why;
    mcap::for_each_message(file_.records_of(chunk, why), [&](const mcap::Message& message) {
      std::optional<StampedPose> pose = message.channel == *found ? read_pose(message.data) : std::nullopt;
      if (!pose || !is_valid(pose->pose)) return;
      pose->time_s = kNs * static_cast<double>(message.log_ns);
      other_poses_.push_back(*pose);
    });
  }
  std::stable_sort(other_poses_.begin(), other_poses_.end(),
                   [](const StampedPose& a, const StampedPose& b) { return a.time_s < b.time_s; });
  add_other_values(file_.channels().at(*found).topic);
}

void Recording::add_other_values(const std::string& topic) {
  constexpr const char* kNames[] = {"x", "y", "z", "qx", "qy", "qz", "qw"};
  ValueTable table;
  table.columns.resize(std::size(kNames));
  for (const StampedPose& pose : other_poses_) {
    table.time_s.push_back(pose.time_s);
    for (std::size_t i = 0; i < std::size(kNames); ++i) {
      const auto axis = static_cast<int>(i);
      table.columns[i].push_back(static_cast<float>(i < 3 ? pose.pose.p[axis] : pose.pose.q.coeffs()[axis - 3]));
    }
  }
  for (std::size_t i = 0; i < std::size(kNames); ++i) {
    const std::string name = kNames[i];
    values_.push_back({topic + "." + name, (i < 3 ? "position " : "attitude, quaternion ") + name, i < 3 ? "m" : "1", topic, "pose",
                       tables_.size(), i, nullptr});
  }
  tables_.push_back(std::move(table));
}

std::optional<Pose> Recording::other_pose(std::size_t n) const {
  const double time_s = frames_.at(n).time_s;
  const auto after = std::lower_bound(other_poses_.begin(), other_poses_.end(), time_s,
                                      [](const StampedPose& pose, double at_s) { return pose.time_s < at_s; });
  const StampedPose* nearest = after != other_poses_.end() ? &*after : nullptr;
  if (after != other_poses_.begin() && (nearest == nullptr || time_s - std::prev(after)->time_s < nearest->time_s - time_s))
    nearest = &*std::prev(after);
  if (nearest == nullptr || std::abs(nearest->time_s - time_s) > kNearest_s) return std::nullopt;
  return nearest->pose;
}

void Recording::number_events() {
  std::stable_sort(events_.begin(), events_.end(), [](const RecordedEvent& a, const RecordedEvent& b) { return a.time_s < b.time_s; });
  for (RecordedEvent& event : events_) {
    const auto later = std::upper_bound(frames_.begin(), frames_.end(), event.time_s,
                                        [](double time_s, const Frame& frame) { return time_s < frame.time_s; });
    event.frame = later == frames_.begin() ? 0 : static_cast<std::size_t>(later - frames_.begin()) - 1;
  }
}

const Value* Recording::value(const std::string& id) const {
  const auto found = by_id_.find(id);
  return found != by_id_.end() ? &values_[found->second] : nullptr;
}

std::optional<PoseTelemetry> Recording::told(std::size_t n) const {
  const std::optional<std::uint16_t> channel = own_ ? file_.channel_of("/packets") : std::nullopt;
  std::optional<PoseTelemetry> found;
  if (!channel) return found;
  const std::shared_ptr<const std::string> records = cache_.records(frames_.at(n).chunk);
  mcap::for_each_message(*records, [&](const mcap::Message& message) {
    const std::optional<ConstBytes> packet = message.channel == *channel && !found ? read_packet(message.data) : std::nullopt;
    PacketHeader header;
    PoseTelemetry pose;
    if (!packet || decode_pose(*packet, header, pose, apid_of(*packet)) != PacketFault::kNone) return;
    if (message.log_ns == frames_[n].told_ns && stated_ns(pose, message.log_ns) == frames_[n].stated_ns) found = pose;
  });
  return found;
}

std::optional<Pose> Recording::truth(std::size_t n) const {
  const std::string bytes = message(n, "/truth");
  const std::optional<StampedPose> pose = bytes.empty() ? std::nullopt : read_pose(bytes);
  return pose ? std::optional(pose->pose) : std::nullopt;
}

std::string Recording::message(std::size_t n, const std::string& topic) const {
  const std::optional<std::uint16_t> channel = file_.channel_of(topic);
  return channel ? cache_.message(*channel, frames_.at(n).time_ns) : "";
}

std::string Recording::first_message(const std::string& topic) const {
  const std::optional<std::uint16_t> channel = file_.channel_of(topic);
  return channel ? cache_.first_message(*channel) : "";
}

}  // namespace lasso::mdat::serve
