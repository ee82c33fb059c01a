#include "hal_sim/sensor_recording.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

SensorRecording two_scans() {
  SensorRecording recording(2);
  for (std::size_t i = 0; i < 2; ++i) {
    SensorScan& scan = recording[i];
    scan.sensor = static_cast<std::uint8_t>(i);
    scan.plan.scan_id = static_cast<std::uint32_t>(40 + i);
    scan.plan.points = 18;
    scan.plan.cycles_a = 5;
    scan.plan.cycles_b = 3;
    scan.plan.phase_turns = 0.375;
    scan.plan.center_x = 0.01;
    scan.plan.duration_us = 17'000;
    scan.aimed = {{0.01F, -0.02F}, {0.03F, 0.04F}};
    scan.t_start_us = 5'000'000;
    scan.end = i == 0 ? Status::kOk : Status::kBadOrder;
    RangeSample sample;
    sample.direction[0] = 0.6F;
    sample.direction[2] = 0.8F;
    sample.range_m = 3.25F;
    sample.t_us = 5'000'123;
    sample.state = RayState::kHit;
    sample.sigma_factor = 5;
    scan.samples.assign(3 + i, sample);
  }
  return recording;
}

SensorRecording read(const std::vector<std::uint8_t>& bytes) { return recording_of(ConstBytes(bytes.data(), bytes.size())); }

std::string refusal(const std::vector<std::uint8_t>& bytes) {
  try {
    read(bytes);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(SensorRecording, ComesBackFromItsBytes) {
  VERIFIES("LASSO-SNS-031~1");
  const SensorRecording sent = two_scans(), got = read(to_bytes(sent));
  ASSERT_EQ(got.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(got[i].sensor, sent[i].sensor);
    EXPECT_EQ(got[i].plan.scan_id, sent[i].plan.scan_id);
    EXPECT_EQ(got[i].plan.points, 18);
    EXPECT_EQ(got[i].plan.phase_turns, 0.375);
    EXPECT_EQ(got[i].plan.center_x, 0.01);
    EXPECT_EQ(got[i].plan.duration_us, 17'000);
    ASSERT_EQ(got[i].aimed.size(), 2U);
    EXPECT_EQ(got[i].aimed[1].y, 0.04F);
    EXPECT_EQ(got[i].t_start_us, 5'000'000);
    EXPECT_EQ(got[i].end, sent[i].end);
    ASSERT_EQ(got[i].samples.size(), 3 + i);
    EXPECT_EQ(got[i].samples[2].range_m, 3.25F);
    EXPECT_EQ(got[i].samples[2].direction[0], 0.6F);
    EXPECT_EQ(got[i].samples[2].t_us, 5'000'123);
    EXPECT_EQ(got[i].samples[2].state, RayState::kHit);
    EXPECT_EQ(got[i].samples[2].sigma_factor, 5);
  }
  EXPECT_EQ(to_bytes(got), to_bytes(sent));
}

TEST(SensorRecording, SaysWhatIsWrongAndWhere) {
  const std::vector<std::uint8_t> good = to_bytes(two_scans());
  const auto changed = [&](std::size_t place, std::uint8_t byte) {
    std::vector<std::uint8_t> bytes = good;
    bytes.at(place) = byte;
    return refusal(bytes);
  };
  EXPECT_NE(changed(0, 'X').find("not what a sensor gave"), std::string::npos);
  EXPECT_NE(changed(7, 9).find("version 9, expected 2"), std::string::npos);
  EXPECT_NE(changed(8, 200).find("sensor 200"), std::string::npos);
  EXPECT_NE(changed(8 + 6, 0xFF).find("a plan that no scan can have"), std::string::npos);
  EXPECT_NE(changed(8 + 60, 0xFF).find("aimed rays, expected at most"), std::string::npos);
  EXPECT_NE(changed(good.size() - 5, 9).find("scan 1, byte"), std::string::npos);
  EXPECT_NE(changed(good.size() - 5, 9).find("state is 9"), std::string::npos);
  EXPECT_NE(changed(good.size() - 4, 0xC0).find("sigma factor is -5"), std::string::npos);
  for (std::size_t size = 0; size < good.size(); ++size) {
    const std::string said = refusal({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)});
    const bool between_scans = size == 8 || size == 8 + 73 + 2 * 8 + 3 * 29;
    EXPECT_EQ(said.empty(), between_scans) << size << said;
  }
}

TEST(SensorRecording, RefusesScansThatNoSensorGives) {
  VERIFIES("LASSO-SNS-031~1");
  const auto changed = [](auto change) {
    SensorRecording recording = two_scans();
    change(recording[1]);
    return refusal(to_bytes(recording));
  };
  const auto says = [](const std::string& said, const std::string& words) {
    return said.rfind("scan 1, byte ", 0) == 0 && said.find(words) != said.npos;
  };
  EXPECT_TRUE(says(changed([](SensorScan& s) { s.end = static_cast<Status>(17); }), "end is 17, expected 0 to 16"));
  EXPECT_EQ(changed([](SensorScan& s) { s.end = Status::kOffPlan; }), "");
  for (const float odd : {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()}) {
    EXPECT_TRUE(says(changed([&](SensorScan& s) { s.samples[1].range_m = odd; }), "not finite"));
    EXPECT_TRUE(says(changed([&](SensorScan& s) { s.samples[3].direction[1] = odd; }), "not finite"));
    EXPECT_TRUE(says(changed([&](SensorScan& s) { s.aimed[0].x = odd; }), "a plan that no scan can have"));
    EXPECT_TRUE(says(changed([&](SensorScan& s) { s.plan.center_y = static_cast<double>(odd); }), "a plan that no scan can have"));
  }
}

TEST(SensorRecording, RefusesTimesThatAreNotOfTheScan) {
  VERIFIES("LASSO-SNS-031~1");
  const auto with_time = [](std::size_t sample, TimeUs t_us) {
    SensorRecording recording = two_scans();
    recording[1].samples[sample].t_us = t_us;
    return refusal(to_bytes(recording));
  };
  constexpr TimeUs kStart = 5'000'000, kEnd = kStart + 17'000 + kRecordingToleranceUs;
  EXPECT_EQ(with_time(0, kStart - kRecordingToleranceUs), "");
  EXPECT_NE(with_time(0, kStart - kRecordingToleranceUs - 1), "");
  EXPECT_EQ(with_time(3, kEnd), "");
  EXPECT_NE(with_time(3, kEnd + 1).find("5117001, expected 5000123 to 5117000 us"), std::string::npos) << with_time(3, kEnd + 1);
  EXPECT_NE(with_time(2, 5'000'122), "") << "before its predecessor";
  for (const TimeUs extreme : {std::numeric_limits<TimeUs>::min(), std::numeric_limits<TimeUs>::max()}) {
    EXPECT_NE(with_time(1, extreme), "");
    SensorRecording recording = two_scans();
    recording[1].t_start_us = extreme;
    EXPECT_NE(refusal(to_bytes(recording)).find("a start at " + std::to_string(extreme)), std::string::npos);
  }
}

}  // namespace
}  // namespace lasso::sim
