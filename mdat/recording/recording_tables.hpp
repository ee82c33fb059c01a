// Messages as tables: a row a message, a column each number or text in it.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "mdat/recording/topic_reader.hpp"

namespace lasso::mdat {

struct MessageTable {
  struct Row {
    std::uint64_t t_ns = 0;
    std::vector<mcap::MessageValue> values;  // of the columns
  };
  std::vector<std::string> columns;  // "pose.position.x", "covariance[7]"
  std::vector<Row> rows;
};

struct RecordingTables {
  std::map<std::string, MessageTable> tables;   // by topic
  std::map<std::string, std::string> left_out;  // topics with lists of any length, and their schemas
};

// Of all topics, or of one. Throws InputError as read_topics.
RecordingTables tables_of(const std::filesystem::path& file, const RecordingSpan& span, const std::string& topic);

// A topic's name as that of a file.
std::string file_name_of(const std::string& topic);

// A topic of any kind. Throws InputError that lists those that there are.
TopicName topic_named(const std::filesystem::path& file, const std::string& topic);

}  // namespace lasso::mdat
