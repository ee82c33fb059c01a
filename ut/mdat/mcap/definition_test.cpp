#include "mdat/mcap/definition.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "ut/support/verifies.hpp"

namespace lasso::mdat::mcap {
namespace {

// What ROS 2 may write: constants, comments, bounds, presets, types without their package.
TEST(RosDefinition, TakesWhatRosWrites) {
  VERIFIES("LASSO-REC-009~1");
  const Definition definition =
      parse_definition("a_msgs/msg/Thing",
                       "# a comment\nuint8 KIND=3\nstring NAME = \"x\"\nHeader header\nPart part  # its part\nfloat64[36] covariance\n"
                       "string<=10 label \"preset\"\nint32[<=5] some\nuint8[] data\n"
                       "====\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n"
                       "====\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n"
                       "====\nMSG: a_msgs/msg/Part\nint64 number\n");
  const std::vector<Field>& fields = definition.types[0].fields;
  ASSERT_EQ(fields.size(), 6U);
  EXPECT_EQ(definition.types[fields[0].type].name, "std_msgs/Header");
  EXPECT_EQ(definition.types[fields[1].type].name, "a_msgs/Part");
  EXPECT_EQ(fields[2].many, Field::Many::kFixed);
  EXPECT_EQ(fields[2].count, 36U);
  EXPECT_EQ(fields[3].basic, Basic::kText);
  EXPECT_EQ(fields[4].many, Field::Many::kSequence);
  EXPECT_EQ(fields[5].basic, Basic::kUint8);
}

TEST(RosDefinition, WhatIsNoneIsRefusedWithItsLine) {
  VERIFIES("LASSO-REC-008~2");
  const auto error_of = [](const std::string& text) {
    try {
      (void)parse_definition("a/msg/B", text);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_EQ(error_of("int32 x\nnowhere/Type y\n"), "'nowhere/Type y': the type nowhere/Type is not defined");
  EXPECT_EQ(error_of("B again\n"), "'B again': types hold each other without end");
  EXPECT_EQ(error_of("int32\n"), "'int32': a field has no name");
  EXPECT_EQ(error_of("int32[x] y\n"), "'int32[x] y': no number of elements");
  EXPECT_EQ(error_of("int32[0] y\n"), "'int32[0] y': an array of no elements");
}

}  // namespace
}  // namespace lasso::mdat::mcap
