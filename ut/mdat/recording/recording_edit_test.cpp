#include "mdat/recording/recording_edit.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "hal_sim/random.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/recording/recording_head.hpp"
#include "mdat/recording/topic_reader.hpp"
#include "ut/mdat/recording/small_recording.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using RecordingEdit = SmallRecording;

struct HeldContent {
  std::multiset<std::string> messages;  // topic, time, data
  std::map<std::string, std::string> attachments;
  std::map<std::string, mcap::Text> metadata;
  std::vector<mcap::Damage> damage;
};

HeldContent content_of(const std::filesystem::path& file) {
  HeldContent content;
  mcap::Reader reader(file);
  mcap::Visitor visitor;
  visitor.message = [&](const mcap::Channel& channel, const mcap::Message& message) {
    content.messages.insert(channel.topic + " " + std::to_string(message.log_ns) + " " + std::string(message.data));
  };
  visitor.attachment = [&](const mcap::Attachment& attachment) { content.attachments[attachment.name] = attachment.data; };
  visitor.metadata = [&](const std::string& name, const mcap::Text& map) { content.metadata[name] = map; };
  content.damage = reader.read(visitor);
  return content;
}

bool holds_no_other(const HeldContent& part, const HeldContent& whole) {
  return std::includes(whole.messages.begin(), whole.messages.end(), part.messages.begin(), part.messages.end());
}

TEST_F(RecordingEdit, ACutHoldsItsSpanAndTheScene) {
  VERIFIES("LASSO-REC-011~1");
  const auto whole = write("whole.mcap");
  const EditReport report = cut_recording(whole, span_of(2.0, 3.0), file("cut.mcap"));
  std::map<std::string, std::vector<std::uint64_t>> times;
  for (const auto& message : content_of(file("cut.mcap")).messages) {
    const std::size_t blank = message.find(' ');
    times[message.substr(0, blank)].push_back(std::stoull(message.substr(blank + 1)));
  }
  EXPECT_EQ(times["/scan"], (std::vector<std::uint64_t>{2'000'000'000, 2'500'000'000}));
  EXPECT_EQ(times["/scene"], (std::vector<std::uint64_t>{2'000'000'000})) << "a viewer needs it";
  EXPECT_EQ(report.kept, 12U);
  EXPECT_EQ(report.kept + report.left_out, content_of(whole).messages.size());
  EXPECT_EQ(content_of(file("cut.mcap")).attachments, content_of(whole).attachments);
}

// What a replay may compare, and whether there may be one.
TEST_F(RecordingEdit, ACutSaysWhatOfItsRunItIs) {
  VERIFIES("LASSO-REC-011~1");
  const auto whole = write("whole.mcap");
  (void)cut_recording(whole, span_of(std::nullopt, 2.0), file("begin.mcap"));
  mcap::Text about = content_of(file("begin.mcap")).metadata[kRecordingMetadata];
  EXPECT_EQ(about.at(kWholeUntil), "1999999999");
  EXPECT_EQ(about.count(kBeginsLate), 0U);
  (void)cut_recording(whole, span_of(1.5, std::nullopt), file("end.mcap"));
  about = content_of(file("end.mcap")).metadata[kRecordingMetadata];
  EXPECT_EQ(about.at(kBeginsLate), "1.5");
  EXPECT_EQ(about.count(kWholeUntil), 0U);
}

TEST_F(RecordingEdit, ASpanWithoutMessagesIsRefused) {
  VERIFIES("LASSO-REC-011~1");
  const auto whole = write("whole.mcap");
  const auto error_of = [&](double from_s, double to_s) {
    try {
      (void)cut_recording(whole, span_of(from_s, to_s), file("cut.mcap"));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_NE(error_of(20, 30).find("of those from 1 to 3.5 s"), std::string::npos) << error_of(20, 30);
  EXPECT_NE(error_of(3, 2).find("expected a time behind --from"), std::string::npos);
  EXPECT_NE(error_of(-1, 2).find("--from: expected seconds"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(file("cut.mcap")));
  EXPECT_FALSE(std::filesystem::exists(file("cut.mcap.part")));
}

// Frames whose chunk is whole before the cut are all there, and nothing else.
TEST_F(RecordingEdit, ACutFileIsRecoveredUpToItsLastWholeChunk) {
  VERIFIES("LASSO-REC-012~1");
  const std::string whole = bytes_of(write("whole.mcap"));
  const HeldContent all = content_of(file("whole.mcap"));
  std::vector<std::size_t> ends;  // of chunks
  for (std::size_t at = 0; (at = whole.find("zstd", at)) != std::string::npos; ++at) {
    std::uint64_t length = 0;
    std::memcpy(&length, whole.data() + at - 40, sizeof length);
    if (whole[at - 41] == '\x06') ends.push_back(at - 32 + length);
  }
  ASSERT_EQ(ends.size(), 6U);
  sim::Random random(11);
  for (int trial = 0; trial < 1000; ++trial) {
    const auto size = static_cast<std::size_t>(random.uniform(60, static_cast<double>(whole.size())));
    put(file("part.mcap"), std::string_view(whole).substr(0, size));
    std::filesystem::remove(file("whole_again.mcap"));
    const EditReport report = recover_recording(file("part.mcap"), file("whole_again.mcap"));
    const HeldContent part = content_of(file("whole_again.mcap"));
    EXPECT_TRUE(part.damage.empty() && holds_no_other(part, all)) << size;
    const auto chunks = std::count_if(ends.begin(), ends.end(), [&](std::size_t end) { return end <= size; });
    EXPECT_EQ(part.messages.size(), chunks == 0 ? 0U : static_cast<std::size_t>(6 * chunks + 1)) << size;
    EXPECT_EQ(report.damage.empty(), part.metadata.count("recovered") == 0);
  }
}

// A damaged byte costs its own chunk, attachment or record. Nothing is ever another than it was, but for the header's two names, and then
// damage is told.
TEST_F(RecordingEdit, ADamagedByteCostsItsOwnChunkAndIsTold) {
  VERIFIES("LASSO-REC-012~1");
  const std::string whole = bytes_of(write("whole.mcap"));
  const HeldContent all = content_of(file("whole.mcap"));
  const std::size_t data_end = whole.rfind(std::string("\x0f\x04\0\0\0\0\0\0\0", 9));
  ASSERT_NE(data_end, std::string::npos);
  sim::Random random(12);
  int refused = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const auto at = static_cast<std::size_t>(random.uniform(0, static_cast<double>(data_end)));
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << (random.bits() % 8)));
    put(file("part.mcap"), damaged);
    std::filesystem::remove(file("whole_again.mcap"));
    try {
      const EditReport report = recover_recording(file("part.mcap"), file("whole_again.mcap"));
      const HeldContent part = content_of(file("whole_again.mcap"));
      EXPECT_FALSE(report.damage.empty()) << at;
      EXPECT_TRUE(part.damage.empty() && holds_no_other(part, all)) << at;
      EXPECT_GE(part.messages.size() + 7, all.messages.size()) << at;
      for (const auto& [name, content] : part.attachments) EXPECT_EQ(content, all.attachments.at(name)) << at;
      const auto about = part.metadata.find(kRecordingMetadata);
      EXPECT_TRUE(about == part.metadata.end() || about->second.at("seed") == "7") << at;
    } catch (const InputError&) {
      EXPECT_LT(at, 40U);
      ++refused;
    }
  }
  EXPECT_LT(refused, 20);
}

}  // namespace
}  // namespace lasso::mdat
