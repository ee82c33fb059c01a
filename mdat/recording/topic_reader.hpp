// The messages of a recording as values, topic by topic, of any program's recording.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "mdat/mcap/message_value.hpp"
#include "mdat/mcap/reader.hpp"
#include "mdat/recording/recording_edit.hpp"

namespace lasso::mdat {

struct TopicMessage {
  std::string topic, schema;  // "sensor_msgs/msg/PointCloud2"
  std::uint64_t t_ns = 0;
  mcap::MessageValue value;
};

struct TopicName {
  std::string topic, schema;
};

// Gets the messages of a span for which `wanted` is true, in the file's order. Returns what is damaged. Throws InputError that names file,
// topic and message: a message that is not as its schema says, an encoding other than ROS 2's.
std::vector<mcap::Damage> read_topics(const std::filesystem::path& file, const RecordingSpan& span,
                                      const std::function<bool(const TopicName&)>& wanted,
                                      const std::function<void(const TopicMessage&)>& take);

// All topics, by their names.
std::vector<TopicName> topics_of(const std::filesystem::path& file);

// The topic `wanted`, or if it is empty the only one whose schema is one of `schemas`, or of these `preferred`. Throws InputError: there is
// none, or several; it lists those that there are.
std::string choose_topic(const std::filesystem::path& file, const std::string& wanted, const std::set<std::string>& schemas,
                         const std::string& preferred);

}  // namespace lasso::mdat
