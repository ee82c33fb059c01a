// A bag's folder, as rosbag2 has it: the messages' file, and metadata.yaml, which says what is in it.
#include <algorithm>
#include <map>
#include <system_error>

#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/recording/part_file.hpp"
#include "mdat/recording/recording_export.hpp"

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;

constexpr int kBagVersion = 5;  // of metadata.yaml: that of Humble, which later ones read

struct ListedTopic {
  std::string type, encoding;
  std::uint64_t messages = 0;
};

struct BagContents {
  std::map<std::string, ListedTopic> topics;
  std::uint64_t messages = 0, first_ns = UINT64_MAX, last_ns = 0;
};

BagContents bag_contents(const fs::path& file) {
  BagContents contents;
  mcap::Reader reader(file);
  mcap::Visitor visitor;
  visitor.message = [&](const mcap::Channel& channel, const mcap::Message& message) {
    const auto schema = reader.schemas().find(channel.schema);
    ListedTopic& topic = contents.topics[channel.topic];
    topic.type = schema != reader.schemas().end() ? schema->second.name : "";
    topic.encoding = channel.encoding;
    ++topic.messages;
    ++contents.messages;
    contents.first_ns = std::min(contents.first_ns, message.log_ns);
    contents.last_ns = std::max(contents.last_ns, message.log_ns);
  };
  (void)reader.read(visitor);
  if (contents.messages == 0) throw InputError(file.string() + ": holds no message that can be read");
  return contents;
}

std::string yaml_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

std::string times_text(const BagContents& contents, const std::string& before) {
  return before + "duration:\n" + before + "  nanoseconds: " + std::to_string(contents.last_ns - contents.first_ns) + "\n" + before +
         "starting_time:\n" + before + "  nanoseconds_since_epoch: " + std::to_string(contents.first_ns) + "\n" + before +
         "message_count: " + std::to_string(contents.messages) + "\n";
}

std::string metadata_text(const BagContents& contents, const std::string& name) {
  std::string text = "rosbag2_bagfile_information:\n  version: " + std::to_string(kBagVersion) + "\n  storage_identifier: mcap\n";
  text += times_text(contents, "  ") + "  topics_with_message_count:\n";
  for (const auto& [topic, what] : contents.topics) {
    text += "    - topic_metadata:\n        name: " + yaml_text(topic) + "\n        type: " + yaml_text(what.type) +
            "\n        serialization_format: " + yaml_text(what.encoding) +
            "\n        offered_qos_profiles: \"\"\n      message_count: " + std::to_string(what.messages) + "\n";
  }
  text += "  compression_format: \"\"\n  compression_mode: \"\"\n  relative_file_paths:\n    - " + yaml_text(name) +
          "\n  files:\n    - path: " + yaml_text(name) + "\n" + times_text(contents, "      ");
  return text;
}

// Beside its place first, as each file that mdat writes.
void copy_messages(const fs::path& file, const RecordingSpan& span, const fs::path& place) {
  if (span.first_ns > 0 || span.end_ns < UINT64_MAX) {
    (void)cut_recording(file, span, place);
    return;
  }
  PartFile part(place);
  std::error_code error;
  fs::copy_file(file, part.path(), fs::copy_options::overwrite_existing, error);
  if (error) throw InputError(part.path().string() + ": cannot be written: " + error.message());
  part.commit();
}

}  // namespace

void export_bag(const fs::path& file, const ExportOptions& options, const fs::path& folder) {
  const fs::path place = fs::absolute(folder / "").lexically_normal().parent_path();  // "bag" and "bag/" are one
  const std::string name = place.filename().string() + "_0.mcap";
  OutputFolder made(folder);
  copy_messages(file, options.span, folder / name);
  made.write("metadata.yaml", metadata_text(bag_contents(folder / name), name));
  made.commit();
}

}  // namespace lasso::mdat
