#include "mdat/run/integrity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

Integrity of_poses(std::size_t poses) {
  Integrity integrity;
  integrity.protection.poses = poses;
  integrity.protection.position_mm = {0, 1.234, 5.6};
  integrity.protection.attitude_deg = {0, 0.1, 0.25};
  return integrity;
}

Integrity with_wrong_poses() {
  Integrity integrity = of_poses(1000);
  integrity.wrong = 7;
  integrity.alert = {3, 1, 0.2, 0.6, 0.6, true};
  integrity.protection.misleading = 12;
  integrity.protection.position_mm.misleading = 10;
  return integrity;
}

TEST(Integrity, OfNoWrongPoseSaysHowManyThereMayBe) {
  VERIFIES("LASSO-GND-130~1");
  const std::vector<std::string> row = integrity_row("quiet", of_poses(500), "-");
  ASSERT_EQ(row.size(), integrity_head("").size());
  EXPECT_EQ(row[1], "no wrong pose, at most 0.60 %");  // 1 - 0.05^(1 / 500) = 0.5973 %
  EXPECT_EQ(row[2], "-");
  EXPECT_EQ(row[4], "-");
  EXPECT_EQ(integrity_row("none", of_poses(0), "-")[1], "no valid pose");
}

TEST(Integrity, ARowHasEpisodesTimesAndLevels) {
  VERIFIES("LASSO-GND-130~1");
  VERIFIES("LASSO-GND-131~1");
  const std::vector<std::string> row = integrity_row("loud", with_wrong_poses(), "-");
  const std::vector<std::string> expected = {
      "loud", "7 poses in 3 episodes, 1 censored", "0.2", "0.6", ">= 0.6", "12 of 1000, 0.62 % to 2.1 %", "1.2", "5.6", "0.1", "0.25"};
  EXPECT_EQ(row, expected);
}

TEST(Integrity, LargeLevelsHaveNoPowersOfTen) {
  VERIFIES("LASSO-GND-131~1");
  Integrity loose = of_poses(500);
  loose.protection.position_mm = {0, 99.4, 44696.2};
  loose.protection.attitude_deg = {0, 99.6, 180};
  const std::vector<std::string> row = integrity_row("loose", loose, "-");
  EXPECT_EQ(std::vector<std::string>(row.end() - 4, row.end()), (std::vector<std::string>{"99", "44696", "100", "180"}));
}

std::string list_text(const Integrity& integrity) {
  std::string text;
  for (const std::vector<std::string>& line : integrity_list(integrity)) text += line.at(0) + ": " + line.at(1) + "\n";
  return text;
}

TEST(Integrity, AListSaysItInWords) {
  VERIFIES("LASSO-GND-130~1 LASSO-GND-131~1");
  Integrity loud = with_wrong_poses();
  EXPECT_EQ(list_text(loud),
            "valid and wrong: 7 of 1000, 0.28 % to 1.5 %; 3 episodes, 1 censored\n"
            "time to alert: median 0.2 s, 95 % 0.6 s, worst >= 0.6 s\n"
            "misleading: 12 of 1000, 0.62 % to 2.1 %; by position 10, by attitude 0\n"
            "protection level, position: median 1.23 mm, worst 5.6 mm\n"
            "protection level, attitude: median 0.1 deg, worst 0.25 deg\n");
  loud.flights = 40;
  loud.wrong_flights = 2;
  EXPECT_NE(list_text(loud).find("; flights with one: 2 of 40, 0.61 % to 17.0 %\n"), std::string::npos) << list_text(loud);
  Integrity quiet = of_poses(500);
  quiet.flights = 40;
  quiet.protection.position_mm.worst = 11708.9;
  EXPECT_NE(list_text(quiet).find("position: median 1.23 mm, worst 11709 mm\n"), std::string::npos) << list_text(quiet);
  EXPECT_NE(list_text(quiet).find("valid and wrong: no wrong pose in 500, at most 0.60 %; flights with one: 0 of 40, at most 7.3 %\n"
                                  "time to alert: no wrong pose\nmisleading: 0 of 500, at most 0.60 %\n"),
            std::string::npos)
      << list_text(quiet);
}

TEST(Integrity, JsonHasTheSameFiguresAndNullOfWhatIsNotKnown) {
  VERIFIES("LASSO-GND-130~1");
  VERIFIES("LASSO-GND-131~1");
  const auto json = nlohmann::json::parse(integrity_json(with_wrong_poses()).dump());
  EXPECT_EQ(json["time_to_alert"]["episodes"], 3);
  EXPECT_EQ(json["time_to_alert"]["censored"], 1);
  EXPECT_EQ(json["time_to_alert"]["median_s"], 0.2);
  EXPECT_EQ(json["time_to_alert"]["worst_is_censored"], true);
  EXPECT_EQ(json["protection"]["risk"], 1e-4);
  EXPECT_EQ(json["protection"]["misleading_share"], 0.012);
  EXPECT_GT(json["protection"]["misleading_share_limits"][0], 0.006);
  EXPECT_EQ(json["protection"]["position"]["misleading"], 10);
  EXPECT_EQ(json["protection"]["position"]["worst_mm"], 5.6);
  EXPECT_EQ(json["protection"]["attitude"]["median_deg"], 0.1);
  const auto quiet = nlohmann::json::parse(integrity_json(of_poses(500)).dump());
  EXPECT_TRUE(quiet["time_to_alert"]["worst_s"].is_null());
  EXPECT_NEAR(quiet["time_to_alert"]["wrong_share_at_most"].get<double>(), 1 - std::pow(0.05, 1 / 500.0), 1e-12);
}

}  // namespace
}  // namespace lasso::mdat
