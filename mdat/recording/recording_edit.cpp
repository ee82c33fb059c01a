#include "mdat/recording/recording_edit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "mdat/common/errors.hpp"
#include "mdat/mcap/copy.hpp"
#include "mdat/recording/part_file.hpp"
#include "mdat/recording/recording_head.hpp"

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;

constexpr char kScansTopic[] = "/sensor_scans";
constexpr char kEditedBy[] = "mdat";

std::string seconds_text(std::uint64_t ns) {
  char text[40];
  (void)std::snprintf(text, sizeof text, "%.9g", static_cast<double>(ns) * 1e-9);
  return text;
}

std::uint64_t ns_of(double seconds) { return static_cast<std::uint64_t>(std::llround(seconds * 1e9)); }

// What a file holds, before it is copied.
struct Survey {
  std::uint64_t messages = 0, first_ns = UINT64_MAX, last_ns = 0;
  std::map<std::string, std::string> attachments;
};

Survey survey_of(const fs::path& file) {
  Survey survey;
  mcap::Reader reader(file);
  mcap::Visitor visitor;
  visitor.message = [&](const mcap::Channel&, const mcap::Message& message) {
    ++survey.messages;
    survey.first_ns = std::min(survey.first_ns, message.log_ns);
    survey.last_ns = std::max(survey.last_ns, message.log_ns);
  };
  visitor.attachment = [&](const mcap::Attachment& attachment) { survey.attachments[attachment.name] = attachment.data; };
  (void)reader.read(visitor);
  if (survey.messages == 0) throw InputError(file.string() + ": holds no message that can be read");
  return survey;
}

bool is_scene(const mcap::Reader& reader, const mcap::Channel& channel) {
  const auto schema = reader.schemas().find(channel.schema);
  return schema != reader.schemas().end() && schema->second.name == "foxglove_msgs/msg/SceneUpdate";
}

void attach_to(mcap::Writer& writer, const mcap::Attachment& attachment) {
  writer.attach(attachment.name, attachment.media_type, attachment.data, attachment.log_ns);
}

// Up to when the component's telemetry follows from the scans that a part of a recording holds: kWholeUntil of its metadata.
void limit_whole(mcap::Text& about, std::uint64_t until_ns) {
  const auto said = about.find(kWholeUntil);
  if (said != about.end() && said->second.size() <= 19 && said->second.find_first_not_of("0123456789") == std::string::npos &&
      !said->second.empty())
    until_ns = std::min<std::uint64_t>(until_ns, std::stoull(said->second));
  about[kWholeUntil] = std::to_string(until_ns);
}

// A damage as metadata says it: "byte 1200, between 3.2 s and 4 s: a chunk cannot be unpacked".
std::string damage_text(const mcap::Damage& damage) {
  std::string text = "byte " + std::to_string(damage.at);
  if (damage.after_ns > 0) text += ", after " + seconds_text(damage.after_ns) + " s";
  if (damage.before_ns > 0) text += ", before " + seconds_text(damage.before_ns) + " s";
  return text + ": " + damage.why;
}

}  // namespace

RecordingSpan span_of(std::optional<double> from_s, std::optional<double> to_s) {
  const auto check = [](const char* name, std::optional<double> time_s) {
    if (time_s && !(*time_s >= 0 && *time_s < 9e9)) throw InputError(std::string(name) + ": expected seconds from 0 to 9e9");
  };
  check("--from", from_s);
  check("--to", to_s);
  RecordingSpan span;
  if (from_s) span.first_ns = ns_of(*from_s);
  if (to_s) span.end_ns = ns_of(*to_s);
  if (span.end_ns <= span.first_ns) throw InputError("--to " + seconds_text(span.end_ns) + ": expected a time behind --from");
  return span;
}

EditReport cut_recording(const fs::path& file, const RecordingSpan& span, const fs::path& out) {
  const Survey survey = survey_of(file);
  PartFile part(out);
  mcap::Reader reader(file);
  mcap::Writer writer(part.path(), reader.profile(), kEditedBy);
  mcap::Copy copy(reader, writer);
  EditReport report;
  mcap::Visitor visitor;
  visitor.message = [&](const mcap::Channel& channel, const mcap::Message& message) {
    mcap::Message moved = message;
    const bool holds = span.holds(message.log_ns), earlier_scene = message.log_ns < span.first_ns && is_scene(reader, channel);
    if (earlier_scene) moved.log_ns = span.first_ns;
    ++(holds ? report.kept : report.left_out);
    if (holds || earlier_scene) copy.message(channel, moved);
  };
  visitor.attachment = [&](const mcap::Attachment& attachment) { attach_to(writer, attachment); };
  visitor.metadata = [&](const std::string& name, const mcap::Text& map) {
    mcap::Text changed = map;
    if (name == kRecordingMetadata && span.first_ns > survey.first_ns) changed[kBeginsLate] = seconds_text(span.first_ns);
    if (name == kRecordingMetadata && span.end_ns <= survey.last_ns) limit_whole(changed, span.end_ns - 1);
    writer.add_metadata(name, changed);
  };
  report.damage = reader.read(visitor);
  if (report.kept == 0)
    throw InputError(file.string() + ": no message from " + seconds_text(span.first_ns) + " s on, of those from " +
                     seconds_text(survey.first_ns) + " to " + seconds_text(survey.last_ns) + " s");
  writer.close();
  part.commit();
  return report;
}

EditReport recover_recording(const fs::path& file, const fs::path& out) {
  PartFile part(out);
  mcap::Reader reader(file);
  mcap::Writer writer(part.path(), reader.profile(), kEditedBy);
  mcap::Copy copy(reader, writer);
  EditReport report;
  std::uint64_t whole_until_ns = 0;
  std::map<std::string, mcap::Text> metadata;
  mcap::Visitor visitor;
  visitor.message = [&](const mcap::Channel& channel, const mcap::Message& message) {
    ++report.kept;
    if (channel.topic == kScansTopic && reader.damage().empty()) whole_until_ns = std::max(whole_until_ns, message.log_ns);
    copy.message(channel, message);
  };
  visitor.attachment = [&](const mcap::Attachment& attachment) { attach_to(writer, attachment); };
  visitor.metadata = [&](const std::string& name, const mcap::Text& map) { metadata[name] = map; };
  report.damage = reader.read(visitor);
  for (auto& [name, map] : metadata) {
    if (name == kRecordingMetadata && !report.damage.empty()) limit_whole(map, whole_until_ns);
    writer.add_metadata(name, map);
  }
  mcap::Text lost;
  for (const mcap::Damage& damage : report.damage) lost["lost " + std::to_string(lost.size() + 1)] = damage_text(damage);
  if (!lost.empty()) writer.add_metadata("recovered", lost);
  writer.close();
  part.commit();
  return report;
}

}  // namespace lasso::mdat
