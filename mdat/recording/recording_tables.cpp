#include "mdat/recording/recording_tables.hpp"

#include "mdat/common/errors.hpp"

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;
using mcap::MessageValue;

// What a table can hold: no bytes, and no list; arrays of a fixed number are told from lists by their schema.
bool is_table(const MessageValue& value) {
  if (value.is_binary()) return false;
  if (value.is_array() && (value.size() > 64 || (!value.empty() && value[0].is_object()))) return false;
  if (!value.is_structured()) return true;
  if (value.is_array()) return !value.empty();
  for (const auto& part : value) {
    if (!is_table(part)) return false;
  }
  return true;
}

void flatten(const MessageValue& value, const std::string& name, std::vector<std::string>* names, std::vector<MessageValue>& values) {
  if (value.is_object()) {
    for (const auto& [key, part] : value.items()) flatten(part, name.empty() ? key : name + "." + key, names, values);
    return;
  }
  if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) flatten(value[i], name + "[" + std::to_string(i) + "]", names, values);
    return;
  }
  if (names != nullptr) names->push_back(name);
  values.push_back(value);
}

}  // namespace

RecordingTables tables_of(const fs::path& file, const RecordingSpan& span, const std::string& topic) {
  RecordingTables result;
  const auto wanted = [&](const TopicName& name) {
    return (topic.empty() || name.topic == topic) && result.left_out.count(name.topic) == 0;
  };
  (void)read_topics(file, span, wanted, [&](const TopicMessage& message) {
    MessageTable& table = result.tables[message.topic];
    MessageTable::Row row{message.t_ns, {}};
    const bool first = table.rows.empty();
    if (first && !is_table(message.value)) result.left_out[message.topic] = message.schema;
    flatten(message.value, "", first ? &table.columns : nullptr, row.values);
    if (row.values.size() != table.columns.size()) result.left_out[message.topic] = message.schema;
    if (result.left_out.count(message.topic) > 0) {
      result.tables.erase(message.topic);
    } else {
      table.rows.push_back(std::move(row));
    }
  });
  return result;
}

TopicName topic_named(const fs::path& file, const std::string& topic) {
  std::string names;
  for (const TopicName& name : topics_of(file)) {
    if (name.topic == topic) return name;
    names += (names.empty() ? "" : ", ") + name.topic;
  }
  throw InputError(file.string() + ": no topic " + topic + ": there are " + (names.empty() ? "none" : names));
}

}  // namespace lasso::mdat
