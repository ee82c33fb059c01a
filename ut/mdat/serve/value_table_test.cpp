#include "mdat/serve/value_table.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "ut/mdat/serve/small_recording.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::serve {
namespace {

ConstBytes view(const std::string& bytes) { return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}; }

const PacketRow& pose_row() {
  const std::string packet = SmallRecording::packet(PoseTelemetry{});
  return *telemetry_row(view(packet));
}

std::map<std::string, Value> by_id(const PacketColumns& columns) {
  std::map<std::string, Value> values;
  for (const Value& value : columns.values()) values[value.id] = value;
  return values;
}

TEST(ValueTable, EachNumberOfAPacketIsAValue) {
  VERIFIES("LASSO-WEB-009~1");
  EXPECT_STREQ(pose_row().name, "pose");
  const PacketColumns columns(pose_row(), 3);
  std::size_t elements = 0;
  for (const ItemRow& item : pose_row().items) elements += item.count;
  EXPECT_EQ(columns.values().size(), elements);
  std::set<std::string> ids;
  for (const Value& value : columns.values()) {
    ids.insert(value.id);
    EXPECT_FALSE(value.unit.empty() || value.label.empty() || value.group.empty()) << value.id;
    EXPECT_EQ(value.unit.find(','), std::string::npos) << value.id;
    EXPECT_EQ(value.table, 3U);
  }
  EXPECT_EQ(ids.size(), elements);
}

TEST(ValueTable, NumbersAreThoseOfThePacket) {
  VERIFIES("LASSO-WEB-009~1");
  const PacketColumns columns(pose_row(), 0);
  ValueTable table;
  const PoseTelemetry told = SmallRecording{}.told(3);
  const std::string packet = SmallRecording::packet(told);
  columns.add(1.5, view(packet), table);
  auto values = by_id(columns);
  const auto number = [&](const std::string& id) { return table.columns.at(values.at(id).column).at(0); };
  EXPECT_EQ(table.time_s, std::vector<double>{1.5});
  EXPECT_EQ(number("pose.inliers"), 293);
  EXPECT_EQ(number("pose.rms_m"), told.rms_m);
  EXPECT_EQ(number("pose.p_sensor_target_m.2"), static_cast<float>(told.p_sensor_target_m[2]));
  EXPECT_EQ(number("pose.filter_omega_radps.1"), static_cast<float>(told.filter_omega_radps[1]));
  EXPECT_EQ(number("pose.mode"), 2);
  EXPECT_STREQ(values.at("pose.mode").choices->choices[2].name, "tracking");
  EXPECT_EQ(values.at("pose.inliers").choices, nullptr);
}

// Row by row of the upper triangle, by counting.
TEST(ValueTable, UnitsOfACovarianceAreThoseOfItsRowAndColumn) {
  VERIFIES("LASSO-WEB-009~1");
  const PacketColumns columns(pose_row(), 0);
  auto values = by_id(columns);
  std::size_t element = 0;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column, ++element) {
      const Value& value = values.at("pose.covariance." + std::to_string(element));
      EXPECT_EQ(value.unit, column < 3 ? "rad^2" : row < 3 ? "rad m" : "m^2") << element;
      EXPECT_EQ(value.label.find("translation z with translation z") != std::string::npos, row == 5) << value.label;
    }
  }
  EXPECT_EQ(values.at("pose.filter_sigma_pose.2").unit, "rad");
  EXPECT_EQ(values.at("pose.filter_sigma_pose.3").unit, "m");
  EXPECT_EQ(values.at("pose.filter_sigma_rates.5").unit, "m/s");
  EXPECT_EQ(values.at("pose.bearing.1").unit, "rad");
  EXPECT_EQ(values.at("pose.bearing.2").unit, "m");
  EXPECT_EQ(values.at("pose.bearing.3").unit, "rad/s");
  EXPECT_EQ(values.at("pose.bearing.5").unit, "m/s");
}

TEST(ValueTable, PacketsOfNobodyAreNone) {
  VERIFIES("LASSO-WEB-009~1");
  const std::string packet = SmallRecording::packet(PoseTelemetry{});
  EXPECT_EQ(telemetry_row(view(packet.substr(0, packet.size() - 1))), nullptr);
  EXPECT_EQ(telemetry_row(view(packet + "x")), nullptr);
  EXPECT_EQ(telemetry_row(view("")), nullptr);
  std::string other = packet;
  other[7] = '\x55';
  EXPECT_EQ(telemetry_row(view(other)), nullptr);
}

}  // namespace
}  // namespace lasso::mdat::serve
