#include <algorithm>
#include <functional>
#include <stdexcept>

#include "mdat/common/errors.hpp"
#include "mdat/mcap/copy.hpp"
#include "mdat/mcap/message_value.hpp"
#include "mdat/recording/part_file.hpp"
#include "mdat/recording/recording_edit.hpp"
#include "mdat/recording/recording_head.hpp"
#include "mdat/recording/topic_reader.hpp"

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;
using mcap::MessageValue;

constexpr std::int64_t kNsPerSecond = 1'000'000'000;
constexpr char kRootFrame[] = "world", kTransforms[] = "/tf";

// What is the same of two files' runs, and where their times begin.
struct MergedFile {
  std::uint64_t first_ns = UINT64_MAX;
  std::string target;  // its surface, as text; empty where none is told
};

// Of all scenes: the first surface that one tells.
std::string target_of(const fs::path& file) {
  std::string target;
  const auto wanted = [&](const TopicName& name) { return target.empty() && name.schema == "foxglove_msgs/msg/SceneUpdate"; };
  (void)read_topics(file, {}, wanted, [&](const TopicMessage& message) {
    const MessageValue& entities = message.value.at("entities");
    if (!entities.empty() && !entities[0].at("triangles").empty()) target = entities[0].at("triangles")[0].at("points").dump();
  });
  return target;
}

MergedFile merged_file(const fs::path& file) {
  MergedFile result;
  mcap::Reader reader(file);
  mcap::Visitor visitor;
  visitor.message = [&](const mcap::Channel&, const mcap::Message& message) {
    result.first_ns = std::min(result.first_ns, message.log_ns);
  };
  const std::vector<mcap::Damage> damage = reader.read(visitor);
  if (!damage.empty())
    throw InputError(file.string() + ": damaged at byte " + std::to_string(damage[0].at) + ": " + damage[0].why +
                     ": mdat recording recover makes a file of what is whole");
  if (result.first_ns == UINT64_MAX) throw InputError(file.string() + ": holds no message");
  result.target = target_of(file);
  return result;
}

void check_prefixes(const std::array<std::string, 2>& prefixes) {
  for (const std::string& prefix : prefixes) {
    const bool name = !prefix.empty() && prefix.size() <= 60 &&
                      prefix.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") == std::string::npos &&
                      (prefix[0] < '0' || prefix[0] > '9');
    if (!name) throw InputError("--prefix " + prefix + ": expected a name of letters, digits and underscores");
  }
  if (prefixes[0] == prefixes[1]) throw InputError("--prefix " + prefixes[0] + ": is that of both files: expected two names");
}

// Times and frames of a message, as of one file among two.
class Renamer {
 public:
  Renamer(std::string prefix, std::int64_t shift_ns) : prefix_(std::move(prefix)), shift_ns_(shift_ns) {}

  void change(const mcap::Definition& definition, std::size_t type, MessageValue& value) const {
    const mcap::MessageType& of = definition.types[type];
    if (of.name == "builtin_interfaces/Time") return shift(value);
    for (const mcap::Field& field : of.fields) {
      MessageValue& part = value[field.name];
      if (field.basic == mcap::Basic::kText && (field.name == "frame_id" || field.name == "child_frame_id")) rename(part);
      if (field.basic != mcap::Basic::kNone) continue;
      if (field.many == mcap::Field::Many::kOne) change(definition, field.type, part);
      if (field.many == mcap::Field::Many::kOne) continue;
      for (MessageValue& element : part) change(definition, field.type, element);
    }
  }

  std::uint64_t shifted(std::uint64_t t_ns) const { return static_cast<std::uint64_t>(static_cast<std::int64_t>(t_ns) + shift_ns_); }
  std::string topic(const std::string& name) const {
    return name == kTransforms ? name : "/" + prefix_ + (name[0] == '/' ? "" : "/") + name;
  }
  std::string named(const std::string& name) const { return prefix_ + "/" + name; }

 private:
  void rename(MessageValue& text) const {
    const std::string name = text.get<std::string>();
    if (!name.empty() && name != kRootFrame) text = named(name);
  }
  void shift(MessageValue& time) const {
    const std::int64_t ns = time.at("sec").get<std::int64_t>() * kNsPerSecond + time.at("nanosec").get<std::int64_t>() + shift_ns_;
    const std::int64_t seconds = ns / kNsPerSecond - (ns % kNsPerSecond < 0 ? 1 : 0);
    time["sec"] = static_cast<std::int32_t>(seconds);
    time["nanosec"] = static_cast<std::uint32_t>(ns - seconds * kNsPerSecond);
  }
  std::string prefix_;
  std::int64_t shift_ns_;
};

// One file into the common one.
class MergeSource {
 public:
  MergeSource(const fs::path& file, Renamer renamer, mcap::Writer& writer)
      : file_(file), renamer_(std::move(renamer)), writer_(writer), reader_(file), copy_(reader_, writer) {}

  void copy(EditReport& report) {
    mcap::Visitor visitor;
    visitor.message = [&](const mcap::Channel& channel, const mcap::Message& message) {
      ++report.kept;
      take(channel, message);
    };
    visitor.attachment = [&](const mcap::Attachment& attachment) {
      writer_.attach(renamer_.named(attachment.name), attachment.media_type, attachment.data, attachment.log_ns);
    };
    visitor.metadata = [&](const std::string& name, const mcap::Text& map) { writer_.add_metadata(renamer_.named(name), map); };
    (void)reader_.read(visitor);
  }

 private:
  void take(mcap::Channel channel, mcap::Message message) {
    const std::string topic = channel.topic;
    std::string data(message.data);
    try {
      const mcap::Definition* definition = definition_of(channel);
      if (definition != nullptr) {
        MessageValue value = mcap::value_of(*definition, message.data);
        renamer_.change(*definition, 0, value);
        data = mcap::message_of(*definition, value);
      }
    } catch (const std::invalid_argument& error) {
      throw InputError(file_.string() + ": " + topic + ", message " + std::to_string(message.sequence) +
                       ": is not as its schema says: " + error.what());
    }
    channel.topic = renamer_.topic(topic);
    message.log_ns = renamer_.shifted(message.log_ns);
    message.publish_ns = renamer_.shifted(message.publish_ns);
    message.data = data;
    copy_.message(channel, message);
  }

  // None: of another encoding, which is copied as it is.
  const mcap::Definition* definition_of(const mcap::Channel& channel) {
    const auto schema = reader_.schemas().find(channel.schema);
    if (schema == reader_.schemas().end() || channel.encoding != "cdr" || schema->second.encoding != "ros2msg") return nullptr;
    const auto [place, added] = definitions_.try_emplace(channel.schema);
    if (added) place->second = mcap::parse_definition(schema->second.name, schema->second.data);
    return &place->second;
  }

  fs::path file_;
  Renamer renamer_;
  mcap::Writer& writer_;
  mcap::Reader reader_;
  mcap::Copy copy_;
  std::map<std::uint16_t, mcap::Definition> definitions_;
};

}  // namespace

EditReport merge_recordings(const std::array<fs::path, 2>& files, const MergeOptions& options, const fs::path& out) {
  check_prefixes(options.prefixes);
  const MergedFile first = merged_file(files[0]), second = merged_file(files[1]);
  const bool different = !first.target.empty() && !second.target.empty() && first.target != second.target;
  if (different && !options.different_targets)
    throw InputError(files[1].string() + ": is a run of another target than " + files[0].string() +
                     ": --different-targets merges them all the same");
  const std::string profile = mcap::Reader(files[0]).profile();
  if (mcap::Reader(files[1]).profile() != profile)
    throw InputError(files[1].string() + ": has another profile than " + files[0].string() + " ('" + profile + "')");
  EditReport report;
  if (!options.keep_times) report.shift_ns = static_cast<std::int64_t>(first.first_ns) - static_cast<std::int64_t>(second.first_ns);
  PartFile part(out);
  mcap::Writer writer(part.path(), profile, "mdat");
  writer.add_metadata(kMergedMetadata, {{options.prefixes[0], files[0].filename()}, {options.prefixes[1], files[1].filename()}});
  for (std::size_t i = 0; i < files.size(); ++i) {
    MergeSource source(files[i], Renamer(options.prefixes[i], i == 0 ? 0 : report.shift_ns), writer);
    source.copy(report);
  }
  writer.close();
  part.commit();
  return report;
}

}  // namespace lasso::mdat
