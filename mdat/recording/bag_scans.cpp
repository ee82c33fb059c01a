#include "mdat/recording/bag_scans.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "mdat/common/errors.hpp"
#include "mdat/mcap/reader.hpp"
#include "mdat/recording/ros_schemas.hpp"

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;

constexpr char kCloudSchema[] = "sensor_msgs/msg/PointCloud2";

std::string scan_stem_of(std::size_t i) {
  char name[40];
  (void)std::snprintf(name, sizeof name, "scan%05zu", i);
  return name;
}

// Message by message, as a scan.
sim::RawScan scan_of_message(const mcap::Definition& definition, std::string_view message, const std::string& place) {
  try {
    return scan_of(foreign_cloud(mcap::value_of(definition, message)), place);
  } catch (const std::invalid_argument& error) {
    throw InputError(place + ": is not as its schema says: " + error.what());
  }
}

// What a bag holds, topic by topic.
struct BagTopic {
  std::string schema, encoding, definition;
};

[[noreturn]] void refuse_topic(const fs::path& file, const std::string& what, const std::map<std::string, BagTopic>& topics) {
  std::string list;
  for (const auto& [name, topic] : topics) list += (list.empty() ? "" : ", ") + name + " (" + topic.schema + ")";
  throw InputError(file.string() + ": " + what + ": there are " + (list.empty() ? "no topics" : list));
}

std::string chosen_topic(const fs::path& file, const std::string& wanted, const std::map<std::string, BagTopic>& topics) {
  if (!wanted.empty()) {
    const auto topic = topics.find(wanted);
    if (topic == topics.end()) refuse_topic(file, "no topic " + wanted, topics);
    if (topic->second.schema != kCloudSchema) refuse_topic(file, wanted + " is no topic of scans (" + kCloudSchema + ")", topics);
    return wanted;
  }
  std::vector<std::string> clouds;
  for (const auto& [name, topic] : topics) {
    if (topic.schema == kCloudSchema) clouds.push_back(name);
  }
  const bool ours = topics.count("/sensor_scans") > 0 && std::find(clouds.begin(), clouds.end(), "/scan") != clouds.end();
  if (ours) return "/scan";
  if (clouds.empty()) refuse_topic(file, std::string("no topic of scans (") + kCloudSchema + ")", topics);
  if (clouds.size() > 1) refuse_topic(file, "several topics of scans: choose one by --topic", topics);
  return clouds.front();
}

class McapScans final : public sim::ScanSource {
 public:
  McapScans(const fs::path& file, const std::string& wanted) : file_(file), reader_(file) {
    std::map<std::string, BagTopic> topics;
    std::map<std::string, std::vector<MessagePlace>> places;
    std::uint64_t record = 0;
    std::size_t nth = 0;
    mcap::Visitor visitor;
    visitor.message = [&](const mcap::Channel& channel, const mcap::Message&) {
      nth = std::exchange(record, reader_.record_at()) == reader_.record_at() ? nth + 1 : 0;
      const auto schema = reader_.schemas().find(channel.schema);
      const mcap::Schema none, &said = schema != reader_.schemas().end() ? schema->second : none;
      topics[channel.topic] = {said.name, channel.encoding + "/" + said.encoding, said.data};
      if (said.name == kCloudSchema) places[channel.topic].push_back({record, nth});
    };
    damage_ = reader_.read(visitor);
    topic_ = chosen_topic(file, wanted, topics);
    const BagTopic& topic = topics.at(topic_);
    if (topic.encoding != "cdr/ros2msg")
      throw InputError(file.string() + ": " + topic_ + ": its messages are '" + topic.encoding.substr(0, 40) +
                       "': expected those of ROS 2 (cdr/ros2msg)");
    try {
      definition_ = mcap::parse_definition(topic.schema, topic.definition);
    } catch (const std::invalid_argument& error) {
      throw InputError(file.string() + ": " + topic_ + ": its schema cannot be read: " + error.what());
    }
    places_ = places.at(topic_);
    for (const mcap::Damage& part : damage_)
      std::fprintf(stderr, "warning: %s: damaged at byte %llu: %s\n", file.c_str(), static_cast<unsigned long long>(part.at),
                   part.why.c_str());
  }

  std::size_t size() const override { return places_.size(); }
  fs::path place(std::size_t i) const override { return scan_stem_of(i); }
  sim::RawScan read(std::size_t i) const override {
    const MessagePlace& at = places_.at(i);
    return scan_of_message(definition_, reader_.message_at(at.record, at.nth),
                           file_.string() + ": " + topic_ + ", message " + std::to_string(i));
  }

 private:
  struct MessagePlace {
    std::uint64_t record = 0;
    std::size_t nth = 0;
  };
  fs::path file_;
  mutable mcap::Reader reader_;
  std::string topic_;
  mcap::Definition definition_;
  std::vector<MessagePlace> places_;
  std::vector<mcap::Damage> damage_;
};

// A database and what it is asked, closed with their scope.
using Database = std::unique_ptr<sqlite3, int (*)(sqlite3*)>;
using Query = std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)>;

class DatabaseScans final : public sim::ScanSource {
 public:
  DatabaseScans(const fs::path& file, const std::string& wanted) : file_(file), database_(nullptr, sqlite3_close) {
    sqlite3* opened = nullptr;
    const int status = sqlite3_open_v2(file.c_str(), &opened, SQLITE_OPEN_READONLY, nullptr);
    database_.reset(opened);
    if (status != SQLITE_OK) fail("cannot be opened");
    std::map<std::string, BagTopic> topics;
    std::map<std::string, std::int64_t> numbers;
    const Query rows = query("SELECT id, name, type, serialization_format FROM topics");
    while (next(rows)) {
      const std::string name = text(rows, 1);
      topics[name] = {text(rows, 2), text(rows, 3), ""};
      numbers[name] = sqlite3_column_int64(rows.get(), 0);
    }
    topic_ = chosen_topic(file, wanted, topics);
    if (topics.at(topic_).encoding != "cdr")
      throw InputError(file.string() + ": " + topic_ + ": its messages are '" + topics.at(topic_).encoding + "': expected cdr");
    const Query messages = query("SELECT id FROM messages WHERE topic_id = ? ORDER BY timestamp, id");
    sqlite3_bind_int64(messages.get(), 1, numbers.at(topic_));
    while (next(messages)) messages_.push_back(sqlite3_column_int64(messages.get(), 0));
    if (messages_.empty()) throw InputError(file.string() + ": " + topic_ + ": holds no message");
    const RosSchema schema = ros::point_cloud();
    definition_ = mcap::parse_definition(schema.name, schema.text);
  }

  std::size_t size() const override { return messages_.size(); }
  fs::path place(std::size_t i) const override { return scan_stem_of(i); }
  sim::RawScan read(std::size_t i) const override {
    const Query row = query("SELECT data FROM messages WHERE id = ?");
    sqlite3_bind_int64(row.get(), 1, messages_.at(i));
    if (!next(row)) fail("a message that was there is gone");
    const std::string_view data(static_cast<const char*>(sqlite3_column_blob(row.get(), 0)),
                                static_cast<std::size_t>(sqlite3_column_bytes(row.get(), 0)));
    return scan_of_message(definition_, data, file_.string() + ": " + topic_ + ", message " + std::to_string(i));
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(file_.string() + ": " + what + ": " + sqlite3_errmsg(database_.get()) + ": expected a bag of ROS 2 (.db3)");
  }
  Query query(const char* text) const {
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v2(database_.get(), text, -1, &statement, nullptr) != SQLITE_OK) fail("is no bag");
    return {statement, sqlite3_finalize};
  }
  bool next(const Query& row) const {
    const int status = sqlite3_step(row.get());
    if (status != SQLITE_ROW && status != SQLITE_DONE) fail("cannot be read");
    return status == SQLITE_ROW;
  }
  static std::string text(const Query& row, int column) {
    const unsigned char* const value = sqlite3_column_text(row.get(), column);
    return value != nullptr ? reinterpret_cast<const char*>(value) : "";
  }

  fs::path file_;
  Database database_;
  std::string topic_;
  mcap::Definition definition_;
  std::vector<std::int64_t> messages_;
};

// The one file of messages in a bag's folder.
fs::path storage_of(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".zstd")) throw InputError(entry.path().string() + ": is compressed as a whole: zstd -d unpacks it");
    if (name.ends_with(".mcap") || name.ends_with(".db3")) files.push_back(entry.path());
  }
  if (files.size() != 1)
    throw InputError(folder.string() + ": a bag with " + std::to_string(files.size()) +
                     " files of messages (.mcap, .db3): give the one to read");
  return files.front();
}

// Seconds of a point's time field; absolute or from the header's stamp.
class PointTime {
 public:
  explicit PointTime(const ForeignCloud& cloud) : cloud_(cloud), stamp_s_(1e-9 * static_cast<double>(cloud.stamp_ns)) {
    constexpr const char* kNames[] = {"t", "time", "timestamp", "time_offset", "offset_time", "time_stamp", "offset_us"};
    for (const char* name : kNames) {
      if (field_ == nullptr) field_ = cloud.find(name);
    }
    if (field_ == nullptr) return;
    unit_s_ = field_->name == "offset_us" ? 1e-6 : field_->type.kind != sim::ScalarType::Kind::kReal ? 1e-9 : real_unit_s();
  }
  bool known() const { return field_ != nullptr; }
  double at(std::size_t point) const {
    if (field_ == nullptr) return stamp_s_;
    const double time_s = cloud_.value(*field_, point) * unit_s_;
    return std::abs(time_s) < kLongestScan_s ? stamp_s_ + time_s : time_s;
  }

 private:
  static constexpr double kLongestScan_s = 1e6;
  double real_unit_s() const {
    double largest = 0;
    for (std::size_t i = 0; i < cloud_.points; ++i) {
      const double time = std::abs(cloud_.value(*field_, i));
      if (std::isfinite(time)) largest = std::max(largest, time);
    }
    return largest > 1e17 ? 1e-9 : largest > 1e14 ? 1e-6 : 1;
  }
  const ForeignCloud& cloud_;
  const CloudField* field_ = nullptr;
  double stamp_s_, unit_s_ = 1;
};

bool add_known_miss(const ForeignCloud& cloud, std::size_t point, double time_s, sim::RawScan& scan) {
  constexpr double kMiss = 1;  // RayState
  const CloudField *state = cloud.find("state"), *x = cloud.find("ux"), *y = cloud.find("uy"), *z = cloud.find("uz");
  if (state == nullptr || x == nullptr || y == nullptr || z == nullptr) return false;
  scan.misses_known = true;
  const Vec3 direction(cloud.value(*x, point), cloud.value(*y, point), cloud.value(*z, point));
  const bool miss = cloud.value(*state, point) == kMiss && std::abs(direction.norm() - 1) < 1e-3;
  if (miss) scan.add_miss(direction.normalized(), time_s, point + 1);
  return miss;
}

}  // namespace

bool is_bag(const fs::path& path) {
  std::error_code ignored;
  const std::string extension = path.extension().string();
  if (fs::is_directory(path, ignored)) return fs::exists(path / "metadata.yaml", ignored);
  return extension == ".mcap" || extension == ".db3" || path.string().ends_with(".db3.zstd") || path.string().ends_with(".mcap.zstd");
}

std::shared_ptr<const sim::ScanSource> open_bag(const fs::path& path, const std::string& topic) {
  if (path.extension() == ".zstd") throw InputError(path.string() + ": is compressed as a whole: zstd -d unpacks it");
  std::error_code ignored;
  const fs::path file = fs::is_directory(path, ignored) ? storage_of(path) : path;
  if (file.extension() == ".db3") return std::make_shared<DatabaseScans>(file, topic);
  return std::make_shared<McapScans>(file, topic);
}

sim::RawScan scan_of(const ForeignCloud& cloud, const std::string& place) {
  const PointTime time(cloud);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < cloud.points; ++i) {
    const double time_s = time.at(i);
    if (!std::isfinite(time_s)) throw std::invalid_argument("the time of point " + std::to_string(i + 1) + " is no number");
    order.emplace_back(time_s, i);
  }
  std::sort(order.begin(), order.end());  // points of one time stay in their order
  sim::RawScan scan;
  scan.file = place;
  scan.has_times = true;
  scan.unit_s = 1;
  scan.seconds_named = true;
  scan.first_time = order.empty() ? time.at(0) : order.front().first;
  const CloudField &x = *cloud.find("x"), &y = *cloud.find("y"), &z = *cloud.find("z");
  for (const auto& [time_s, i] : order) {
    if (add_known_miss(cloud, i, time_s, scan)) continue;
    scan.add_point(Vec3(cloud.value(x, i), cloud.value(y, i), cloud.value(z, i)), time_s, i + 1);
  }
  return scan;
}

}  // namespace lasso::mdat
