#include "mdat/availability/results.hpp"

#include <gtest/gtest.h>

#include "ut/mdat/availability/frames.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

HeadComparison some_comparison() {
  HeadComparison comparison;
  comparison.mission = "a mission";
  comparison.approach = "approach";
  comparison.hold = "hold";
  for (const Head& head : heads_with(26)) comparison.heads.push_back({head, {}, {}, {}});
  comparison.heads[0].approach = {pose_in(kDayLight, 1, 0.1), pose_in(kNightLight, 2, 0.2)};
  comparison.heads[1].approach = {pose_in(kDayLight, 30, 1.5), nothing_in(kNightLight)};
  comparison.heads[2].approach = {pose_in(kDayLight, 20, 1), wrong_in(kNightLight)};
  for (HeadResult& head : comparison.heads) head.orbits = {{0.5, 1, head.approach[0]}, {0.5, 2, head.approach[1]}};
  comparison.laser = LaserInLight::kSameBits;
  return comparison;
}

std::string line_with(const std::string& text, const std::string& part) {
  const std::size_t at = text.find(part), begin = text.rfind('\n', at) + 1;
  return at == std::string::npos ? "" : text.substr(begin, text.find('\n', at) - begin);
}

TEST(AvailabilityResults, SetHeadsBesideEachOtherAndBesideThePaper) {
  VERIFIES("LASSO-AVA-001~1 LASSO-AVA-003~1");
  const std::string text = comparison_text(some_comparison());
  EXPECT_NE(line_with(text, "laser camera  ").find("1/1 (100 %)"), std::string::npos) << text;
  EXPECT_NE(text.find("2005 paper gives camera systems 80 %; what it counts is not known here"), std::string::npos);
  EXPECT_NE(text.find("same to the bit in the light of each sample"), std::string::npos);
  const std::string orbits = text.substr(text.find("Whole orbits"));
  EXPECT_NE(line_with(orbits, "stereo cameras, lamp").find("1/2 (50.0 %)"), std::string::npos) << orbits;
  EXPECT_NE(line_with(orbits, "laser camera").find("2/2 (100 %)"), std::string::npos) << orbits;
}

TEST(AvailabilityResults, LeaveALineForEachFrameAndSample) {
  VERIFIES("LASSO-AVA-001~1");
  const std::string csv = comparison_csv(some_comparison());
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 6 + 6);
  EXPECT_NE(csv.find("approach,stereo,,,0.000,0,day,1,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("orbit,stereo_lamp,28.6479,114.592,0.000,0,eclipse,0,"), std::string::npos) << csv;
  const auto commas = [](const std::string& line) { return std::count(line.begin(), line.end(), ','); };
  for (std::size_t at = 0; at < csv.size(); at = csv.find('\n', at) + 1) {
    const std::string line = csv.substr(at, csv.find('\n', at) - at);
    EXPECT_EQ(commas(line), 18) << line;
  }
}

TEST(AvailabilityResults, LeaveFiguresForPrograms) {
  VERIFIES("LASSO-AVA-001~1");
  const std::string json = comparison_json(some_comparison());
  EXPECT_NE(json.find("\"paper_camera_availability\": 0.8"), std::string::npos) << json;
  EXPECT_NE(json.find("\"laser_in_each_light\": \"same_bits\""), std::string::npos);
  EXPECT_NE(json.find("\"rms_mm\": null"), std::string::npos) << "of no pose";
}

TEST(AvailabilityResults, SayWhatLightChangesInALaser) {
  VERIFIES("LASSO-AVA-003~1");
  EXPECT_NE(laser_text(LaserInLight::kOtherBits).find("its detector sees the Sun"), std::string::npos);
  EXPECT_NE(laser_text(LaserInLight::kOtherMotion).find("not compared"), std::string::npos);
  EXPECT_NE(laser_text(LaserInLight::kNotCompared).find("not compared"), std::string::npos);
}

}  // namespace
}  // namespace lasso::mdat
