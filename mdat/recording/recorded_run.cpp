#include "mdat/recording/recorded_run.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <system_error>

#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/mcap/cdr.hpp"

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;

// The data of a lasso_msgs/Packet.
std::string_view packet_of(std::string_view message) {
  mcap::CdrReader reader(message);
  (void)reader.get<std::int32_t>();
  (void)reader.get<std::uint32_t>();
  (void)reader.text();
  const std::string_view data = reader.blob();
  return reader.ok() ? data : std::string_view();
}

ConstBytes bytes_of(std::string_view text) { return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}; }

void take_scan(const fs::path& file, std::string_view message, sim::SensorRecording& scans) {
  try {
    for (sim::SensorScan& scan : sim::recording_of(bytes_of(packet_of(message)))) scans.push_back(std::move(scan));
  } catch (const std::invalid_argument& error) {
    throw InputError(file.string() + ": /sensor_scans, message " + std::to_string(scans.size() + 1) + ": " + error.what());
  }
}

void take_commands(const mcap::Message& message, CommandStream& commands) {
  const std::string_view bytes = packet_of(message.data);
  commands.pieces.push_back({static_cast<TimeUs>(message.log_ns / 1000), {bytes.begin(), bytes.end()}});
}

std::string size_text(std::uint64_t bytes) {
  char text[40];
  const double kb = static_cast<double>(bytes) / 1000;
  (void)std::snprintf(text, sizeof text, kb < 1000 ? "%.1f kB" : "%.1f MB", kb < 1000 ? kb : kb / 1000);
  return text;
}

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size() + 2), ' ');
  return text;
}

// What contents_text gathers while it reads.
struct Contents {
  struct Topic {
    std::string schema;
    std::uint64_t messages = 0, bytes = 0;
  };
  std::map<std::string, Topic> topics;
  std::map<std::string, std::uint64_t> attachments;
  std::map<std::string, mcap::Text> metadata;
  std::uint64_t first_ns = UINT64_MAX, last_ns = 0;
};

Contents contents_of(mcap::Reader& reader, std::vector<mcap::Damage>& damage) {
  Contents contents;
  mcap::Visitor visitor;
  visitor.message = [&](const mcap::Channel& channel, const mcap::Message& message) {
    Contents::Topic& topic = contents.topics[channel.topic];
    const auto schema = reader.schemas().find(channel.schema);
    topic.schema = schema != reader.schemas().end() ? schema->second.name : "no schema";
    ++topic.messages;
    topic.bytes += message.data.size();
    contents.first_ns = std::min(contents.first_ns, message.log_ns);
    contents.last_ns = std::max(contents.last_ns, message.log_ns);
  };
  visitor.attachment = [&](const mcap::Attachment& attachment) { contents.attachments[attachment.name] = attachment.data.size(); };
  visitor.metadata = [&](const std::string& name, const mcap::Text& map) { contents.metadata[name] = map; };
  damage = reader.read(visitor);
  return contents;
}

std::string one_line(std::string text) {
  for (char& c : text) c = c == '\n' ? ' ' : c;
  return text;
}

std::string text_of(const Contents& contents) {
  std::string text;
  for (const auto& [name, map] : contents.metadata) {
    for (const auto& [key, value] : map) {
      if (!value.empty()) text += "  " + padded(key, 12) + one_line(value) + "\n";
    }
  }
  text += "topics                           messages        size  of\n";
  for (const auto& [name, topic] : contents.topics) {
    char line[200];
    (void)std::snprintf(line, sizeof line, "  %-30s %8llu %11s  %s\n", name.substr(0, 80).c_str(),
                        static_cast<unsigned long long>(topic.messages), size_text(topic.bytes).c_str(),
                        topic.schema.substr(0, 60).c_str());
    text += line;
  }
  if (!contents.attachments.empty()) text += "attachments\n";
  for (const auto& [name, size] : contents.attachments) text += "  " + padded(name, 44) + size_text(size) + "\n";
  return text;
}

struct TimedPacket {
  std::uint64_t t_ns = 0;
  std::string bytes;
};

// Metadata's number of at most 19 digits; else none.
std::optional<std::uint64_t> number_in(const mcap::Text& map, const std::string& key) {
  const auto said = map.find(key);
  if (said == map.end() || said->second.empty() || said->second.size() > 19) return std::nullopt;
  if (said->second.find_first_not_of("0123456789") != std::string::npos) return std::nullopt;
  return std::stoull(said->second);
}

std::uint64_t whole_until_ns(const mcap::Text& about) { return number_in(about, kWholeUntil).value_or(UINT64_MAX); }

void check_run(const fs::path& file, RecordedRun& run, bool merged) {
  if (merged)
    throw InputError(file.string() + ": is two runs in one file, for viewers: replay one of the recordings that it was merged of");
  if (run.about.count(kLinkAddress) > 0)
    throw InputError(file.string() +
                     ": is telemetry of a link, without scans, and cannot be flown again: record the run itself (mdat run --record)");
  const std::string mission = run.about["mission"];
  if (mission.rfind(kMissionFolder, 0) != 0 || run.files.count(mission) == 0)
    throw InputError(file.string() + ": says of no mission of which run it is: expected a recording of mdat run --record");
  const auto late = run.about.find(kBeginsLate);
  if (late != run.about.end())
    throw InputError(
        file.string() + ": begins at " + late->second +
        " s of its run: what the component knew then is not recorded, so it cannot be flown again; cut it without --from, or replay the "
        "whole recording");
}

// What the component reported up to that time.
void keep_telemetry(const std::vector<TimedPacket>& packets, std::uint64_t until_ns, RecordedRun& run) {
  run.whole = until_ns == UINT64_MAX;
  for (const TimedPacket& packet : packets) {
    if (packet.t_ns > until_ns) continue;
    run.telemetry += packet.bytes;
    run.last_packet_ns = std::max(run.last_packet_ns, packet.t_ns);
  }
}

bool came_in_datagrams(const mcap::Text& about) {
  const auto form = about.find(kLinkForm);
  return form != about.end() && form->second == kDatagrams;
}

}  // namespace

RecordedRun read_recorded_run(const fs::path& file) {
  mcap::Reader reader(file);
  RecordedRun run;
  std::vector<TimedPacket> packets;
  std::uint64_t scans_until_ns = 0;
  mcap::Visitor visitor;
  visitor.message = [&](const mcap::Channel& channel, const mcap::Message& message) {
    if (channel.topic == "/packets") packets.push_back({message.log_ns, std::string(packet_of(message.data))});
    if (channel.topic == "/commands") take_commands(message, run.commands);
    if (channel.topic != "/sensor_scans") return;
    take_scan(file, message.data, run.scans);
    if (reader.damage().empty()) scans_until_ns = std::max(scans_until_ns, message.log_ns);
  };
  visitor.attachment = [&](const mcap::Attachment& attachment) { run.files[attachment.name] = attachment.data; };
  bool merged = false;
  visitor.metadata = [&](const std::string& name, const mcap::Text& map) {
    if (name == kRecordingMetadata) run.about = map;
    if (name == kRecordingEnd) run.boundaries = number_in(map, kBoundaries);
    merged = merged || name == kMergedMetadata;
  };
  run.damage = reader.read(visitor);
  check_run(file, run, merged);
  run.commands.datagrams = came_in_datagrams(run.about);
  keep_telemetry(packets, std::min(whole_until_ns(run.about), run.damage.empty() ? UINT64_MAX : scans_until_ns), run);
  return run;
}

std::string contents_text(const fs::path& file) {
  mcap::Reader reader(file);
  std::vector<mcap::Damage> damage;
  const Contents contents = contents_of(reader, damage);
  const double seconds = contents.last_ns > contents.first_ns ? static_cast<double>(contents.last_ns - contents.first_ns) * 1e-9 : 0;
  char span[40];
  (void)std::snprintf(span, sizeof span, "%.1f s", seconds);
  std::string text = file.string() + ": profile " + (reader.profile().empty() ? "none" : reader.profile()) + ", by " + reader.library() +
                     ", " + span + "\n" + text_of(contents);
  for (const mcap::Damage& part : damage) text += "damaged at byte " + std::to_string(part.at) + ": " + part.why + "\n";
  return text;
}

MissionFolder::MissionFolder(const RecordedRun& run) {
  std::string name = (fs::temp_directory_path() / "mdat-recording-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw RunError(name + ": no folder for the recording's mission can be made");
  folder_ = name;
  try {
    for (const auto& [attachment, content] : run.files) {
      const bool of_store = attachment.rfind(kStoreFolder, 0) == 0;
      if (attachment.rfind(kMissionFolder, 0) != 0 && !of_store) continue;
      const fs::path place = fs::path(attachment).lexically_normal();
      if (place.is_absolute() || *place.begin() != (of_store ? "store" : "mission"))
        throw InputError("attachment '" + attachment + "' would leave the " + (of_store ? "store's" : "mission's") + " folder");
      fs::create_directories((folder_ / place).parent_path());
      write_file(folder_ / place, content);
    }
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
    throw;
  }
  mission_ = folder_ / run.about.at("mission");
}

MissionFolder::~MissionFolder() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

}  // namespace lasso::mdat
