#include "mdat/serve/recording.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "mdat/common/errors.hpp"
#include "ut/mdat/serve/small_recording.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::serve {
namespace {

TEST(OpenRecording, EachReportIsAFrame) {
  VERIFIES("LASSO-WEB-008~1");
  const TestFolder folder;
  const Recording recording(SmallRecording{}.write(folder.path() / "a.mcap"));
  ASSERT_EQ(recording.frames().size(), 6U);
  EXPECT_TRUE(recording.own() && recording.has_truth() && recording.image() != nullptr);
  EXPECT_TRUE(recording.damage().empty());
  for (std::size_t n = 0; n < 6; ++n) {
    const Frame& frame = recording.frames()[n];
    EXPECT_NEAR(frame.time_s, 1.1 + 0.2 * static_cast<double>(n), 1e-9);
    EXPECT_EQ(frame.valid, n != 2 && n != 4) << n;
    EXPECT_EQ(frame.wrong, std::optional(n == 3)) << n;
    EXPECT_EQ(recording.told(n).value().inliers, n == 2 ? 7 : 290 + n) << n;
    EXPECT_EQ(recording.truth(n).value().p, SmallRecording::truth(n).p) << n;
  }
  const Value* inliers = recording.value("pose.inliers");
  ASSERT_NE(inliers, nullptr);
  EXPECT_EQ(recording.column(*inliers), (std::vector<float>{290, 291, 7, 293, 294, 295}));
  EXPECT_EQ(recording.value("pose.nothing"), nullptr);
}

// Where a file that is being written may be looked at: at the ends of records, but not between a chunk and its indexes.
std::vector<std::uint64_t> record_ends(const std::string& bytes) {
  constexpr std::size_t kMagicBytes = 8, kHead = 9;
  constexpr char kMessageIndex = 7;
  std::vector<std::uint64_t> ends;
  for (std::size_t at = kMagicBytes; at + kHead <= bytes.size();) {
    std::uint64_t length = 0;
    std::memcpy(&length, bytes.data() + at + 1, sizeof length);
    if (length > bytes.size() - at - kHead) break;
    at += kHead + length;
    if (at < bytes.size() && bytes[at] != kMessageIndex) ends.push_back(at);
  }
  return ends;
}

// Whatever was known before stays, and in the end all is known: as by the file opened whole.
TEST(OpenRecording, OneThatIsWrittenGrows) {
  VERIFIES("LASSO-WEB-021~1");
  const TestFolder folder;
  const std::filesystem::path file = SmallRecording{}.write(folder.path() / "a.mcap");
  const Recording whole(file);
  const std::vector<std::uint64_t> ends = record_ends(bytes_of_file(file));
  auto growing = std::make_shared<const Recording>(file, ends.front());
  EXPECT_TRUE(growing->frames().empty());
  for (const std::uint64_t end : ends) {
    const std::shared_ptr<const Recording> before = growing;
    const std::size_t frames = before->frames().size();
    growing = before->grown(end);
    EXPECT_EQ(before->frames().size(), frames);
    EXPECT_GE(growing->frames().size(), frames);
    EXPECT_TRUE(growing->damage().empty());
  }
  ASSERT_EQ(growing->frames().size(), whole.frames().size());
  EXPECT_EQ(growing->has_truth(), whole.has_truth());
  EXPECT_EQ(growing->own(), whole.own());
  EXPECT_NE(growing->image(), nullptr);
  EXPECT_EQ(growing->events().size(), whole.events().size());
  ASSERT_EQ(growing->values().size(), whole.values().size());
  for (std::size_t i = 0; i < whole.values().size(); ++i) EXPECT_EQ(growing->values()[i].id, whole.values()[i].id);
  for (std::size_t n = 0; n < whole.frames().size(); ++n) {
    EXPECT_EQ(growing->frames()[n].wrong, whole.frames()[n].wrong) << n;
    EXPECT_EQ(growing->told(n).value().inliers, whole.told(n).value().inliers) << n;
    EXPECT_EQ(growing->message(n, "/scan"), whole.message(n, "/scan")) << n;
  }
}

TEST(OpenRecording, EventsBelongToTheLastFrameBeforeThem) {
  VERIFIES("LASSO-WEB-008~1");
  const TestFolder folder;
  const Recording recording(SmallRecording{}.write(folder.path() / "a.mcap"));
  ASSERT_EQ(recording.events().size(), 1U);
  const RecordedEvent& event = recording.events()[0];
  EXPECT_NEAR(event.time_s, 1.8, 1e-9);  // 0.3 s behind frame 2, which is at 1.5 s
  EXPECT_EQ(event.frame, 3U);            // at 1.7 s
  EXPECT_EQ(event.name, "scan_lost");
}

TEST(OpenRecording, WithoutATruthNothingIsSaidOfErrors) {
  VERIFIES("LASSO-WEB-008~1");
  const TestFolder folder;
  SmallRecording small;
  small.with_truth = false;
  const Recording recording(small.write(folder.path() / "a.mcap"));
  EXPECT_FALSE(recording.has_truth());
  EXPECT_EQ(recording.frames().at(3).wrong, std::nullopt);
  EXPECT_EQ(recording.value("error.position"), nullptr);
  EXPECT_NE(recording.value("sigma.position"), nullptr);
}

// As in safe mode: each report states the time of the last scan. The frames have times of their own all the same, and no scan.
TEST(OpenRecording, ReportsWithoutAScanFollowTheLastOne) {
  VERIFIES("LASSO-WEB-008~1");
  const TestFolder folder;
  SmallRecording small;
  small.last_scan = 3;
  const Recording recording(small.write(folder.path() / "a.mcap"));
  ASSERT_EQ(recording.frames().size(), 6U);
  for (std::size_t n = 0; n < 6; ++n) {
    EXPECT_NEAR(recording.frames()[n].time_s, 1.1 + 0.2 * static_cast<double>(n), 1e-9) << n;
    EXPECT_EQ(recording.told(n).value().scan_id, n) << n;
    EXPECT_EQ(recording.message(n, "/scan").empty(), n > 3) << n;
  }
}

// A link that is recorded while its component is safe: the last scan was long before.
TEST(OpenRecording, ReportsOfAScanFromBeforeHaveTimesOfTheirBoundaries) {
  VERIFIES("LASSO-WEB-008~1");
  const TestFolder folder;
  SmallRecording small;
  small.last_scan = 0;
  small.scan_before_us = 100'000;
  const Recording recording(small.write(folder.path() / "a.mcap"));
  ASSERT_EQ(recording.frames().size(), 6U);
  for (std::size_t n = 0; n < 6; ++n) EXPECT_NEAR(recording.frames()[n].time_s, 1.4 - 0.5 + 0.2 * static_cast<double>(n), 1e-9) << n;
}

TEST(OpenRecording, OfAnotherProgramsCloudsEachIsAFrame) {
  VERIFIES("LASSO-WEB-008~1");
  const TestFolder folder;
  SmallRecording small;
  small.own = small.with_image = false;
  const Recording recording(small.write(folder.path() / "a.mcap"));
  EXPECT_FALSE(recording.own());
  ASSERT_EQ(recording.frames().size(), 5U);  // one scan is not there
  EXPECT_EQ(recording.told(0), std::nullopt);
  const std::size_t last = 4;
  EXPECT_EQ(recording.other_pose(last).value().p, SmallRecording::truth(5).p);
  const Value* z = recording.value("/truth.z");
  ASSERT_NE(z, nullptr);
  EXPECT_EQ(recording.column(*z).at(2), static_cast<float>(SmallRecording::truth(2).p.z()));
  EXPECT_EQ(recording.frames()[4].time_ns, static_cast<std::uint64_t>(SmallRecording::time_us(5)) * 1000);
}

// Whatever is left of a file is shown up to its last whole chunk, with the damage told.
// A small file may unpack to any size: chunks are unpacked some 64 MB at a time, and nothing between them is lost.
TEST(OpenRecording, ChunksOfAnySizeAreTakenOneBehindTheOther) {
  VERIFIES("LASSO-WEB-011~1");
  constexpr std::size_t kEvents = 20;
  const TestFolder folder;
  const std::filesystem::path file = folder.path() / "large.mcap";
  mcap::Writer writer(file, "ros2", "test");
  const auto add = [&](const char* topic, const RosSchema& schema) {
    return writer.add_channel(topic, writer.add_schema(schema.name, "ros2msg", schema.text), "cdr");
  };
  const std::uint16_t events = add("/events", ros::log()), packets = add("/packets", ros::packet());
  const std::string large = ros::packet_bytes({1, ""}, std::string(std::size_t{8} << 20, '\0'));
  for (std::size_t i = 1; i <= kEvents; ++i) {
    writer.write(events, i * 1'000'000, ros::log_bytes(static_cast<TimeUs>(i) * 1000, ros::LogLevel::kInfo, std::to_string(i), ""));
    writer.write(packets, i * 1'000'000, large);
  }
  writer.close();
  const Recording recording(file);
  EXPECT_TRUE(recording.damage().empty());
  ASSERT_EQ(recording.events().size(), kEvents);
  for (std::size_t i = 1; i <= kEvents; ++i) EXPECT_EQ(recording.events()[i - 1].name, std::to_string(i));
}

TEST(OpenRecording, ACutRecordingIsShownAsFarAsItIsWhole) {
  VERIFIES("LASSO-WEB-015~1");
  const TestFolder folder;
  const std::filesystem::path file = SmallRecording{}.write(folder.path() / "a.mcap");
  const std::string whole = bytes_of_file(file);
  std::size_t before = 0;
  for (std::size_t part = 1; part <= 20; ++part) {
    const std::filesystem::path cut = folder.path() / "cut.mcap";
    std::ofstream(cut, std::ios::binary) << whole.substr(0, std::max<std::size_t>(200, whole.size() * part / 21));
    const Recording recording(cut);
    EXPECT_FALSE(recording.damage().empty()) << part;
    EXPECT_GE(recording.frames().size(), before) << part;
    before = recording.frames().size();
    for (std::size_t n = 0; n < before; ++n) EXPECT_EQ(recording.told(n).value().scan_id, n) << part;
  }
  EXPECT_EQ(before, 6U);  // the image is what is cut last
  std::ofstream(folder.path() / "none.mcap") << "no recording";
  EXPECT_THROW((void)Recording(folder.path() / "none.mcap"), InputError);
}

}  // namespace
}  // namespace lasso::mdat::serve
