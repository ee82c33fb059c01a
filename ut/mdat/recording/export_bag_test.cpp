#include <gtest/gtest.h>

#include "mdat/common/errors.hpp"
#include "mdat/recording/bag_scans.hpp"
#include "mdat/recording/recording_export.hpp"
#include "ut/mdat/recording/small_recording.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using ExportBag = SmallRecording;

bool says(const std::string& text, const std::string& line) { return text.find(line + "\n") != std::string::npos; }

// Six frames half a second apart, of which the last one is at 3.5 s.
TEST_F(ExportBag, IsTheRecordingAndWhatIsInIt) {
  VERIFIES("LASSO-REC-025~1");
  const auto recording = write("small.mcap");
  export_bag(recording, {}, file("bag"));
  EXPECT_EQ(bytes_of(file("bag") / "bag_0.mcap"), bytes_of(recording));
  const std::string metadata = bytes_of(file("bag") / "metadata.yaml");
  EXPECT_EQ(
      metadata.rfind("rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: mcap\n  duration:\n    nanoseconds: 2500000000\n"
                     "  starting_time:\n    nanoseconds_since_epoch: 1000000000\n",
                     0),
      0U)
      << metadata;
  EXPECT_TRUE(says(metadata,
                   "        name: \"/pose\"\n        type: \"geometry_msgs/msg/PoseStamped\"\n        serialization_format: \"cdr\"\n"
                   "        offered_qos_profiles: \"\"\n      message_count: 6"))
      << metadata;
  EXPECT_TRUE(says(metadata, "  relative_file_paths:\n    - \"bag_0.mcap\""));
  EXPECT_TRUE(is_bag(file("bag")));
}

TEST_F(ExportBag, OfASpanIsThatSpan) {
  VERIFIES("LASSO-REC-025~1");
  ExportOptions options;
  options.span = span_of(1.5, 3.0);
  export_bag(write("small.mcap"), options, file("part/"));
  const std::string metadata = bytes_of(file("part") / "metadata.yaml");
  EXPECT_TRUE(says(metadata, "    nanoseconds_since_epoch: 1500000000")) << metadata;
  EXPECT_TRUE(says(metadata,
                   "        type: \"geometry_msgs/msg/PoseStamped\"\n        serialization_format: \"cdr\"\n"
                   "        offered_qos_profiles: \"\"\n      message_count: 3"))
      << metadata;
}

TEST_F(ExportBag, OfNothingIsRefused) {
  VERIFIES("LASSO-REC-025~1");
  put(file("empty.mcap"), "");
  EXPECT_THROW(export_bag(file("empty.mcap"), {}, file("bag")), InputError);
}

}  // namespace
}  // namespace lasso::mdat
