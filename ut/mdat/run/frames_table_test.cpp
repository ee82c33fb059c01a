#include "mdat/run/frames_table.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line + ",");
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

// A run of two frames, of which the second is not reported.
SimulationResult two_frames() {
  SimulationResult result;
  result.sensors = {"laser_camera", "lidar"};
  result.parts = {"whole", "bay"};
  FrameError frame;
  frame.frame = 7;
  frame.t_s = 1.49;
  frame.range_m = 3.5;
  frame.mode = TrackingMode::kTracking;
  frame.reason = PoseReason::kValid;
  frame.told = frame.reported = frame.valid = frame.wrong = true;
  frame.registration.translation_m = Vec3(0.003, -0.004, 0.012);
  frame.registration.yaw_pitch_roll = Vec3(0.5, -1, 2) * kRadPerDeg;
  frame.registration.rotation_rad = 2.5 * kRadPerDeg;
  frame.sigma_m = 0.002;
  frame.sigma_rad = 0.25 * kRadPerDeg;
  frame.nees = 36;
  frame.level = {0.008, 3 * kRadPerDeg};
  frame.returns = 900;
  frame.inliers = 850;
  frame.sensor = frame.part = 1;
  frame.estimate_us = 321;
  FrameError missing;
  missing.frame = 8;
  missing.t_s = 1.6;
  missing.range_m = 3.4;
  VariantResult variant;
  variant.variant = {"noisy", "with noise", true, true, false};
  variant.cases.resize(2);
  variant.cases[1].frames = {frame, missing};
  TableResult table;
  table.name = "side_on";
  table.variants.push_back(variant);
  result.tables.push_back(table);
  return result;
}

TEST(FramesTable, HasARowForEachFrameWithUnitsInTheNames) {
  VERIFIES("LASSO-MDT-034~1");
  std::istringstream in(frames_csv(two_frames()));
  std::string line;
  std::vector<std::vector<std::string>> rows;
  while (std::getline(in, line)) rows.push_back(cells_of(line));
  ASSERT_EQ(rows.size(), 3U);
  const auto cell = [&](std::size_t row, const std::string& name) {
    for (std::size_t i = 0; i < rows[0].size(); ++i) {
      if (rows[0][i] == name) return rows[row].at(i);
    }
    return "no column " + name;
  };
  EXPECT_EQ(rows[1].size(), rows[0].size());
  EXPECT_EQ(rows[2].size(), rows[0].size());
  const std::pair<const char*, const char*> expected[] = {
      {"table", "side_on"},  {"variant", "noisy"}, {"run", "2"},       {"frame", "7"},        {"t_s", "1.49"},     {"range_m", "3.5"},
      {"mode", "tracking"},  {"reported", "1"},    {"valid", "1"},     {"reason", "valid"},   {"wrong", "1"},      {"lost", "0"},
      {"x_mm", "3"},         {"y_mm", "-4"},       {"z_mm", "12"},     {"yaw_deg", "0.5"},    {"pitch_deg", "-1"}, {"roll_deg", "2"},
      {"error_mm", "13"},    {"error_deg", "2.5"}, {"sigma_mm", "2"},  {"sigma_deg", "0.25"}, {"nees", "36"},      {"level_mm", "8"},
      {"level_deg", "3"},    {"misleading", "1"},  {"returns", "900"}, {"inliers", "850"},    {"sensor", "lidar"}, {"part", "bay"},
      {"estimate_us", "321"}};
  for (const auto& [name, value] : expected) EXPECT_EQ(cell(1, name), value) << name;
  EXPECT_EQ(cell(2, "frame"), "8");
  EXPECT_EQ(cell(2, "range_m"), "3.4");
  EXPECT_EQ(cell(2, "reported"), "0");
  EXPECT_EQ(cell(2, "lost"), "1");
  EXPECT_EQ(cell(2, "misleading"), "0");
  for (const char* unknown : {"mode", "reason", "x_mm", "nees", "level_mm", "sensor", "estimate_us"})
    EXPECT_EQ(cell(2, unknown), "") << unknown;
}

}  // namespace
}  // namespace lasso::mdat
