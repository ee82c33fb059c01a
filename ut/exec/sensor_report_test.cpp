#include "fsw/exec/sensor_report.hpp"

#include <set>

#include "fsw/link/dictionary.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

ScanTally numbered_tally() {
  ScanTally tally;
  tally.scans = 1000;
  for (std::size_t loss = 1; loss < kScanLosses; ++loss) tally.lost[loss] = static_cast<std::uint32_t>(100 + loss);
  tally.last_loss = ScanLoss::kStopped;
  return tally;
}

std::uint32_t value_of(const SensorTelemetry& report, const std::string& name) {
  for (const TypedRow<SensorTelemetry>& row : sensor_report_rows::kRows) {
    if (name != row.name) continue;
    std::uint8_t bytes[4] = {};
    ByteWriter out{Bytes(bytes)};
    row.write(report, out);
    ByteReader in{ConstBytes(bytes)};
    return row.type == WireType::kU8 ? in.u8() : in.u32();
  }
  ADD_FAILURE() << name;
  return 0;
}

// The item lost_NAME counts the loss that the enumeration calls NAME.
TEST(SensorReport, EachLossHasItsItem) {
  VERIFIES("LASSO-LCS-012~1");
  const SensorTelemetry report = make_sensor_report(2, numbered_tally(), SensorCounters{});
  EXPECT_EQ(report.sensor, 2);
  EXPECT_EQ(report.scans, 1000u);
  ASSERT_EQ(kScanLoss.choices.size(), kScanLosses);
  std::uint32_t sum = 0;
  for (std::size_t loss = 1; loss < kScanLosses; ++loss) {
    EXPECT_EQ(value_of(report, std::string("lost_") + kScanLoss.choices[loss].name), 100 + loss);
    sum += static_cast<std::uint32_t>(100 + loss);
  }
  EXPECT_EQ(report.lost, sum);
  EXPECT_STREQ(kScanLoss.choices[report.last_loss].name, "stopped");
}

TEST(SensorReport, EachCounterHasItsItemAndIsATrouble) {
  VERIFIES("LASSO-LCS-012~1");
  const std::pair<std::uint32_t SensorCounters::*, const char*> items[] = {{&SensorCounters::damaged_frames, "damaged_frames"},
                                                                           {&SensorCounters::missing_frames, "missing_frames"},
                                                                           {&SensorCounters::repeated_frames, "repeated_frames"},
                                                                           {&SensorCounters::unknown_frames, "unknown_frames"},
                                                                           {&SensorCounters::strayed, "strayed"},
                                                                           {&SensorCounters::samples_lost, "samples_lost"},
                                                                           {&SensorCounters::samples_refused, "samples_refused"},
                                                                           {&SensorCounters::bad_times, "bad_times"},
                                                                           {&SensorCounters::off_plan, "off_plan"},
                                                                           {&SensorCounters::clock_jumps, "clock_jumps"},
                                                                           {&SensorCounters::restarts, "restarts"}};
  for (const auto& [member, name] : items) {
    SensorCounters counters;
    counters.*member = 77;
    const SensorTelemetry report = make_sensor_report(0, ScanTally{}, counters);
    EXPECT_EQ(value_of(report, name), 77u) << name;
    EXPECT_EQ(troubles(report), 77u) << name;
  }
  SensorCounters right;
  right.frames = 5;
  right.samples_outside = 6;
  ScanTally scans;
  scans.scans = 9;
  EXPECT_EQ(make_sensor_report(0, scans, right).frames, 5u);
  EXPECT_EQ(make_sensor_report(0, scans, right).samples_outside, 6u);
  EXPECT_EQ(troubles(make_sensor_report(0, scans, right)), 0u) << "what is as it should be is no trouble";
  EXPECT_NE(troubles(make_sensor_report(0, numbered_tally(), right)), 0u);
}

}  // namespace
}  // namespace lasso
