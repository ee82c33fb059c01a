// mdat/recording/recording_merge.cpp.
#include <map>

#include "mdat/common/errors.hpp"
#include "mdat/recording/recording_edit.hpp"
#include "mdat/recording/topic_reader.hpp"
#include "ut/mdat/recording/small_recording.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using RecordingMerge = SmallRecording;

std::map<std::string, std::vector<TopicMessage>> merged_messages(const std::filesystem::path& file) {
  std::map<std::string, std::vector<TopicMessage>> messages;
  (void)read_topics(
      file, {}, [](const TopicName&) { return true; }, [&](const TopicMessage& message) { messages[message.topic].push_back(message); });
  return messages;
}

// The second file begins 1 s later; after merging at the same time, in its messages too.
TEST_F(RecordingMerge, TwoRunsHaveTopicsFramesAndAZeroThatGoTogether) {
  VERIFIES("LASSO-REC-013~1");
  (void)cut_recording(write("first.mcap"), {}, file("one.mcap"));
  (void)cut_recording(file("first.mcap"), span_of(2.0, std::nullopt), file("two.mcap"));
  const EditReport report = merge_recordings({file("one.mcap"), file("two.mcap")}, {{"a", "b"}}, file("both.mcap"));
  EXPECT_EQ(report.shift_ns, -1'000'000'000);
  auto messages = merged_messages(file("both.mcap"));
  ASSERT_EQ(messages["/a/pose"].size(), 6U);
  ASSERT_EQ(messages["/b/pose"].size(), 4U);
  EXPECT_EQ(messages["/b/pose"][0].t_ns, 1'000'000'000U);
  const auto& header = messages["/b/pose"][0].value.at("header");
  EXPECT_EQ(header.at("stamp").at("sec"), 1);
  EXPECT_EQ(header.at("frame_id"), "b/sensor");
  EXPECT_EQ(messages["/b/pose"][0].value.at("pose").at("position").at("x"), small_pose(2).p.x());
  std::map<std::string, std::string> parents;
  for (const TopicMessage& message : messages["/tf"]) {
    for (const auto& transform : message.value.at("transforms"))
      parents[transform.at("child_frame_id").get<std::string>()] = transform.at("header").at("frame_id").get<std::string>();
  }
  EXPECT_EQ(parents, (std::map<std::string, std::string>{
                         {"a/sensor", "world"}, {"a/target", "a/sensor"}, {"b/sensor", "world"}, {"b/target", "b/sensor"}}));
  EXPECT_EQ(messages["/b/scene"][0].value.at("entities")[0].at("frame_id"), "b/target");
}

TEST_F(RecordingMerge, TimesMayBeKept) {
  VERIFIES("LASSO-REC-013~1");
  (void)cut_recording(write("one.mcap"), span_of(2.0, std::nullopt), file("two.mcap"));
  MergeOptions options{{"x", "y"}};
  options.keep_times = true;
  EXPECT_EQ(merge_recordings({file("one.mcap"), file("two.mcap")}, options, file("both.mcap")).shift_ns, 0);
  EXPECT_EQ(merged_messages(file("both.mcap"))["/y/pose"][0].t_ns, 2'000'000'000U);
}

TEST_F(RecordingMerge, WhatDoesNotGoTogetherIsRefused) {
  VERIFIES("LASSO-REC-016~1");
  (void)write("one.mcap");
  (void)write("other.mcap", 3, 2);
  const auto error_of = [&](const std::string& second, const MergeOptions& options) {
    try {
      (void)merge_recordings({file("one.mcap"), file(second)}, options, file("both.mcap"));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_NE(error_of("other.mcap", {{"a", "b"}}).find("other.mcap: is a run of another target than"), std::string::npos);
  EXPECT_NE(error_of("one.mcap", {{"a", "a"}}).find("is that of both files"), std::string::npos);
  EXPECT_NE(error_of("one.mcap", {{"a", "b/c"}}).find("expected a name of letters"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(file("both.mcap")));
  MergeOptions allowed{{"a", "b"}};
  allowed.different_targets = true;
  EXPECT_EQ(error_of("other.mcap", allowed), "none");
}

}  // namespace
}  // namespace lasso::mdat
