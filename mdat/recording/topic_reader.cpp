#include "mdat/recording/topic_reader.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "mdat/common/errors.hpp"

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;

// Definitions by the numbers of their channels; each is parsed once.
class ChannelDefinitions {
 public:
  ChannelDefinitions(const fs::path& file, const mcap::Reader& reader) : file_(file), reader_(reader) {}

  TopicName name_of(const mcap::Channel& channel) const {
    const auto schema = reader_.schemas().find(channel.schema);
    return {channel.topic, schema != reader_.schemas().end() ? schema->second.name : ""};
  }

  mcap::MessageValue value_of(const mcap::Channel& channel, const mcap::Message& message) {
    try {
      return mcap::value_of(definition_of(channel), message.data);
    } catch (const std::invalid_argument& error) {
      throw InputError(file_.string() + ": " + channel.topic + ", message " + std::to_string(message.sequence) +
                       ": is not as its schema says: " + error.what());
    }
  }

 private:
  const mcap::Definition& definition_of(const mcap::Channel& channel) {
    const auto [place, added] = definitions_.try_emplace(channel.id);
    if (!added) return place->second;
    const auto schema = reader_.schemas().find(channel.schema);
    const bool ros = schema != reader_.schemas().end() && schema->second.encoding == "ros2msg" && channel.encoding == "cdr";
    if (!ros)
      throw InputError(file_.string() + ": " + channel.topic + ": its messages are '" + channel.encoding.substr(0, 20) +
                       "': expected those of ROS 2 (cdr, ros2msg)");
    return place->second = mcap::parse_definition(schema->second.name, schema->second.data);
  }

  fs::path file_;
  const mcap::Reader& reader_;
  std::map<std::uint16_t, mcap::Definition> definitions_;
};

std::string list_of(const std::vector<TopicName>& topics) {
  std::string text;
  for (const TopicName& topic : topics) text += (text.empty() ? "" : ", ") + topic.topic + " (" + topic.schema + ")";
  return text.empty() ? "none" : text;
}

}  // namespace

std::vector<mcap::Damage> read_topics(const fs::path& file, const RecordingSpan& span, const std::function<bool(const TopicName&)>& wanted,
                                      const std::function<void(const TopicMessage&)>& take) {
  mcap::Reader reader(file);
  ChannelDefinitions definitions(file, reader);
  mcap::Visitor visitor;
  visitor.message = [&](const mcap::Channel& channel, const mcap::Message& message) {
    const TopicName name = definitions.name_of(channel);
    if (span.holds(message.log_ns) && wanted(name)) take({name.topic, name.schema, message.log_ns, definitions.value_of(channel, message)});
  };
  return reader.read(visitor);
}

std::vector<TopicName> topics_of(const fs::path& file) {
  mcap::Reader reader(file);
  std::map<std::string, std::string> found;
  mcap::Visitor visitor;
  visitor.message = [&](const mcap::Channel& channel, const mcap::Message&) {
    if (found.count(channel.topic) > 0) return;
    const auto schema = reader.schemas().find(channel.schema);
    found[channel.topic] = schema != reader.schemas().end() ? schema->second.name : "no schema";
  };
  (void)reader.read(visitor);
  std::vector<TopicName> topics;
  for (const auto& [topic, schema] : found) topics.push_back({topic, schema});
  return topics;
}

std::string choose_topic(const fs::path& file, const std::string& wanted, const std::set<std::string>& schemas,
                         const std::string& preferred) {
  const std::vector<TopicName> topics = topics_of(file);
  std::vector<TopicName> fitting;
  for (const TopicName& topic : topics) {
    if (schemas.count(topic.schema) > 0) fitting.push_back(topic);
  }
  const auto named = [&](const std::string& name) {
    return std::any_of(fitting.begin(), fitting.end(), [&](const TopicName& topic) { return topic.topic == name; });
  };
  const std::string& kind = *schemas.begin();
  if (!wanted.empty() && named(wanted)) return wanted;
  if (!wanted.empty())
    throw InputError(file.string() + ": no topic " + wanted + " with such messages (" + kind + "): there are " +
                     list_of(fitting.empty() ? topics : fitting));
  if (named(preferred)) return preferred;
  if (fitting.size() == 1) return fitting[0].topic;
  if (fitting.empty()) throw InputError(file.string() + ": no topic of " + kind + ": there are " + list_of(topics));
  throw InputError(file.string() + ": several topics of " + kind + ": choose one by --topic: " + list_of(fitting));
}

}  // namespace lasso::mdat
