#include "fsw/mission/image_records.hpp"

#include <gtest/gtest.h>

#include "ut/support/box_frames.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

// A table of the words, in the image's order of bytes.
struct TestTable {
  TestTable(const test::Words& words, std::uint32_t a_record) {
    for (const std::uint32_t word : words) {
      for (const int shift : {24, 16, 8, 0}) bytes.push_back(static_cast<std::uint8_t>(word >> shift));
    }
    table = {bytes.data(), a_record, static_cast<std::uint32_t>(words.size()) / a_record};
  }
  std::vector<std::uint8_t> bytes;
  ImageTable table;
};

TEST(ImageRecords, ReadEachValueAtItsPlace) {
  VERIFIES("LASSO-IMG-001~1 LASSO-LNK-050~1");
  test::Generator random(50);
  MissionParameters parameters{};
  test::Words words;
  for (const ParameterRow& row : parameter_rows()) test::append_value(parameters.*row.member = random.uniform(-1e6, 1e6), words);
  const TestTable of_mission(words, 2);
  const MissionParameters read = parameters_of(of_mission.table);
  for (const ParameterRow& row : parameter_rows()) EXPECT_EQ(read.*row.member, parameters.*row.member) << row.key;

  words.clear();
  SensorParameters first{}, second{};
  for (SensorParameters* sensor : {&first, &second}) {
    for (const ParameterRow& row : sensor_rows()) sensor->*sensor_member(row) = random.uniform(-1e6, 1e6);
    test::append_sensor(*sensor, words);
  }
  const TestTable of_sensors(words, kSensorWords);
  ASSERT_EQ(of_sensors.table.records, 2U);
  for (const ParameterRow& row : sensor_rows())
    EXPECT_EQ(sensor_of(of_sensors.table, 1).*sensor_member(row), second.*sensor_member(row)) << row.key;

  words.clear();
  const NamedFrame put = test::grapple_in_port();
  for (const NamedFrame& frame : {NamedFrame{}, put}) test::append_named_frame(frame, words);
  const NamedFrame found = named_frame_of(TestTable(words, kNamedFrameWords).table, 1);
  EXPECT_EQ(found.T_target_of.q.coeffs(), put.T_target_of.q.coeffs());
  EXPECT_EQ(found.T_in_sensor.p, put.T_in_sensor.p);
}

}  // namespace
}  // namespace lasso
