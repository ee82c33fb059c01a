#include <limits>
#include <stdexcept>

#include "mdat/common/hdf5_file.hpp"
#include "mdat/recording/foreign_cloud.hpp"
#include "mdat/recording/recording_export.hpp"
#include "mdat/recording/recording_tables.hpp"

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;
using mcap::MessageValue;

void put_reals(hid_t group, const std::string& name, const std::vector<double>& values) {
  (void)h5_column(group, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.size(), values.data());
}

void put_texts(hid_t group, const std::string& name, const std::vector<std::string>& texts) {
  std::size_t longest = 1;
  for (const std::string& text : texts) longest = std::max(longest, text.size());
  std::string bytes;
  for (const std::string& text : texts) bytes += text + std::string(longest - text.size(), '\0');
  const H5Object type = text_type(longest);
  (void)h5_column(group, name, type, type, texts.size(), bytes.data());
}

double real_of(const MessageValue& value) {
  if (value.is_boolean()) return value.get<bool>() ? 1 : 0;
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

void put_table(hid_t file, const std::string& topic, const MessageTable& table) {
  const H5Object group = h5_group(file, file_name_of(topic));
  std::vector<double> times_s;
  for (const MessageTable::Row& row : table.rows) times_s.push_back(1e-9 * static_cast<double>(row.t_ns));
  put_reals(group, "t_s", times_s);
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    std::vector<double> reals;
    std::vector<std::string> texts;
    for (const MessageTable::Row& row : table.rows) {
      if (row.values[i].is_string()) texts.push_back(row.values[i].get<std::string>());
      if (!row.values[i].is_string()) reals.push_back(real_of(row.values[i]));
    }
    texts.empty() ? put_reals(group, table.columns[i], reals) : put_texts(group, table.columns[i], texts);
  }
}

// The clouds of a topic, one behind the other.
struct CloudColumns {
  std::vector<double> times_s;
  std::vector<double> first;  // point of each
  std::map<std::string, std::vector<double>> fields;
};

void add_to(CloudColumns& columns, const ForeignCloud& cloud, std::uint64_t t_ns) {
  std::size_t before = columns.fields.empty() ? 0 : columns.fields.begin()->second.size();
  for (const auto& [name, values] : columns.fields) before = std::max(before, values.size());
  columns.times_s.push_back(1e-9 * static_cast<double>(t_ns));
  columns.first.push_back(static_cast<double>(before));
  for (const CloudField& field : cloud.fields) {
    std::vector<double>& values = columns.fields[field.name];
    values.resize(before, std::numeric_limits<double>::quiet_NaN());  // a cloud before had no such field
    for (std::size_t i = 0; i < cloud.points; ++i) values.push_back(cloud.value(field, i));
  }
}

void put_clouds(hid_t file, const std::string& topic, CloudColumns& columns) {
  const H5Object group = h5_group(file, file_name_of(topic));
  put_reals(group, "t_s", columns.times_s);
  put_reals(group, "first", columns.first);
  std::size_t longest = 0;
  for (const auto& [name, values] : columns.fields) longest = std::max(longest, values.size());
  for (auto& [name, values] : columns.fields) {
    values.resize(longest, std::numeric_limits<double>::quiet_NaN());
    put_reals(group, name, values);
  }
}

}  // namespace

std::string export_h5(const fs::path& file, const ExportOptions& options) {
  if (!options.topic.empty()) (void)topic_named(file, options.topic);
  std::map<std::string, CloudColumns> clouds;
  const auto wanted = [&](const TopicName& name) {
    return name.schema == "sensor_msgs/msg/PointCloud2" && (options.topic.empty() || name.topic == options.topic);
  };
  (void)read_topics(file, options.span, wanted, [&](const TopicMessage& message) {
    try {
      add_to(clouds[message.topic], foreign_cloud(message.value), message.t_ns);
    } catch (const std::invalid_argument& error) {
      throw InputError(file.string() + ": " + message.topic + ": " + error.what());
    }
  });
  const H5Object made = h5_in_memory();
  for (const auto& [topic, table] : tables_of(file, options.span, options.topic).tables) put_table(made, topic, table);
  for (auto& [topic, columns] : clouds) put_clouds(made, topic, columns);
  return image_of(made);
}

}  // namespace lasso::mdat
