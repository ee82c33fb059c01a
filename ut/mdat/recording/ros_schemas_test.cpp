#include "mdat/recording/ros_schemas.hpp"

#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "mdat/recording/packet_messages.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// What a reader does that knows no message: each type that a field has is defined in the text, or is one of the language's own.
void expect_complete(const RosSchema& schema) {
  static const std::set<std::string> kOwn = {"bool",  "byte",   "uint8", "int8",    "uint16",  "int16", "uint32",
                                             "int32", "uint64", "int64", "float32", "float64", "string"};
  std::set<std::string> defined, used;
  std::istringstream lines(schema.text);
  for (std::string line; std::getline(lines, line);) {
    const bool defines = line.rfind("MSG: ", 0) == 0;
    if (defines) {
      EXPECT_TRUE(defined.insert(line.substr(5)).second) << line;
    } else if (line[0] != '=') {
      used.insert(line.substr(0, std::min(line.find(' '), line.find('['))));
    }
  }
  for (const std::string& type : used) EXPECT_TRUE(kOwn.count(type) + defined.count(type) == 1) << schema.name << ": " << type;
  for (const std::string& type : defined) EXPECT_EQ(used.count(type), 1U) << schema.name << ": " << type;
}

TEST(RosSchemas, DefineEachTypeThatTheyUse) {
  VERIFIES("LASSO-REC-001~1");
  for (const RosSchema& schema : {ros::tf_message(), ros::point_cloud(), ros::pose_stamped(), ros::pose_with_covariance(), ros::odometry(),
                                  ros::log(), ros::scene_update(), ros::packet(), ros::compressed_image(), ros::camera_info()}) {
    EXPECT_NE(schema.name.find("/msg/"), std::string::npos);
    EXPECT_FALSE(schema.text.empty()) << schema.name;
    expect_complete(schema);
  }
  for (const PacketRow* packet : told_packets()) expect_complete(packet_schema(*packet));
}

}  // namespace
}  // namespace lasso::mdat
