#include <cmath>
#include <cstdio>

#include "mdat/common/errors.hpp"
#include "mdat/mcap/cdr.hpp"
#include "mdat/recording/recording_export.hpp"
#include "mdat/recording/recording_tables.hpp"

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;
using mcap::MessageValue;

std::string csv_text(const MessageValue& value) {
  if (value.is_boolean()) return value.get<bool>() ? "1" : "0";
  if (value.is_number_float()) {
    char text[40];
    (void)std::snprintf(text, sizeof text, "%.17g", value.get<double>());
    return std::isfinite(value.get<double>()) ? text : "";
  }
  if (!value.is_string()) return value.dump();
  std::string quoted = "\"";
  for (const char c : value.get_ref<const std::string&>()) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string csv_of(const MessageTable& table) {
  std::string text = "t_s";
  for (const std::string& column : table.columns) text += "," + column;
  text += "\n";
  for (const MessageTable::Row& row : table.rows) {
    char time[40];
    (void)std::snprintf(time, sizeof time, "%.9f", static_cast<double>(row.t_ns) * 1e-9);
    text += time;
    for (const MessageValue& value : row.values) text += "," + csv_text(value);
    text += "\n";
  }
  return text;
}

}  // namespace

std::string file_name_of(const std::string& topic) {
  std::string name = topic.substr(topic.find_first_not_of('/') == std::string::npos ? topic.size() : topic.find_first_not_of('/'));
  for (char& c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
    if (!plain) c = '_';
  }
  return name.empty() || name[0] == '.' ? "topic" + name : name;
}

ExportedFiles export_csv(const fs::path& file, const ExportOptions& options) {
  if (!options.topic.empty()) (void)topic_named(file, options.topic);
  ExportedFiles result;
  const RecordingTables tables = tables_of(file, options.span, options.topic);
  for (const auto& [topic, table] : tables.tables) result.files[file_name_of(topic) + ".csv"] = csv_of(table);
  for (const auto& [topic, schema] : tables.left_out)
    result.notes.push_back(topic + " (" + schema + ") is no table: its messages have lists of any length");
  return result;
}

std::string export_packets(const fs::path& file, const ExportOptions& options) {
  std::string bytes;
  const std::string topic = options.topic.empty() ? "/packets" : options.topic;
  (void)choose_topic(file, topic, {"lasso_msgs/msg/Packet"}, topic);
  (void)read_topics(
      file, options.span, [&](const TopicName& name) { return name.topic == topic; },
      [&](const TopicMessage& message) {
        const auto& data = message.value.at("data").get_binary();
        bytes.append(data.begin(), data.end());
      });
  return bytes;
}

}  // namespace lasso::mdat
