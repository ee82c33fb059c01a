// A laser camera and stereo cameras in the light of an orbit.
#include <gtest/gtest.h>

#include <filesystem>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

// A few coarse pictures: two frames of the approach, and two places of an orbit, 90 deg before noon and after it.
std::string short_availability(const std::string& more) {
  return "availability " + source_path("cfg/missions/day_and_night.toml") +
         " --frames 2 --angles 2 --betas 20 --set stereo.pixels=240 --set stereo.lamp_Wpsr=50 " + more;
}

TEST(Availability, FliesEachHeadInTheSameLight) {
  VERIFIES("LASSO-AVA-001~1 LASSO-AVA-003~1");
  const WorkFolder work;
  const Answer answer = work.mdat(short_availability("--jobs 2 --out one"));
  if (is_refused_by_fixed_point(answer)) return;
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const Json results = Json::parse(work.read("one/results.json"));
  EXPECT_EQ(results.at("laser_in_each_light"), "same_bits");
  for (const char* head : {"laser_camera", "stereo", "stereo_lamp"}) {
    EXPECT_EQ(results.at("heads").at(head).at("approach").at("day").at("frames"), 2) << head;
    EXPECT_EQ(results.at("heads").at(head).at("orbits").at("all").at("frames"), 2) << head;
    EXPECT_EQ(results.at("heads").at(head).at("orbits").at("by_beta").size(), 1U) << head;
  }
  EXPECT_EQ(results.at("heads").at("laser_camera").at("approach").at("all").at("available"), 2);
  EXPECT_EQ(results.at("heads").at("laser_camera").at("orbits").at("all").at("available"), 2);
  EXPECT_LT(results.at("heads").at("laser_camera").at("orbits").at("all").at("worst_mm").get<double>(), 2);
  const std::string page = work.read("one/availability.html");
  EXPECT_NE(page.find("What the heads see"), std::string::npos);
  EXPECT_EQ(page.find("class='missing'"), std::string::npos) << "every figure is drawn";
  EXPECT_EQ(page.find("src='http"), std::string::npos) << "the page opens offline";
  const Answer again = work.mdat(short_availability("--out one"));
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_NE(again.err.find("--force replaces them"), std::string::npos) << again.err;
  ASSERT_EQ(work.mdat(short_availability("--jobs 1 --no-report --out two")).exit_code, 0);
  EXPECT_EQ(work.read("one/frames.csv"), work.read("two/frames.csv")) << "threads change nothing";
}

// With sunlight in its model a laser is not the same in each light: the comparison can tell.
TEST(Availability, ALaserThatSeesTheSunDiffersWithTheLight) {
  VERIFIES("LASSO-AVA-003~1");
  const WorkFolder work;
  const std::string detector =
      "--set sensor.detector.reference_electrons=12000 --set sensor.detector.reference_range_m=5 --set sensor.detector.width_m=0.05 --set "
      "sensor.detector.noise_electrons=50 --set sensor.detector.threshold_electrons=400 --set sensor.detector.bandpass_nm=100 --set "
      "sensor.detector.energy_uJ=1 --set sensor.detector.field_mrad=5 --set sensor.detector.gate_us=5 ";
  const Answer answer = work.mdat(short_availability("--no-report --out sunlit " + detector));
  if (is_refused_by_fixed_point(answer)) return;
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_EQ(Json::parse(work.read("sunlit/results.json")).at("laser_in_each_light"), "other_bits") << answer.out;
}

TEST(Availability, RefusesWhatHasNoLightOfAnOrbit) {
  VERIFIES("LASSO-AVA-002~1");
  const WorkFolder work;
  const Answer answer = work.mdat("availability missions/test.toml --approach spin --out none");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_NE(answer.err.find("missions/test.toml: scenario spin has no light of an orbit"), std::string::npos) << answer.err;
  EXPECT_EQ(lines_of(answer.err).size(), 1U) << answer.err;
  EXPECT_FALSE(std::filesystem::exists(work / "none"));
  EXPECT_EQ(work.mdat(short_availability("--betas 95")).exit_code, 2);
}

// A pose behind the sensor to start from.
TEST(Availability, WhatTheComponentRefusesIsBadInput) {
  VERIFIES("LASSO-AVA-002~1");
  const WorkFolder work;
  const Answer answer = work.mdat(short_availability("--no-report --out none --set scenario.approach.prior_shift_m=[0,0,-8]"));
  if (is_refused_by_fixed_point(answer)) {
    EXPECT_EQ(answer.exit_code, 2);
    return;
  }
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_NE(answer.err.find("refuses the pose to start from (out_of_reach): the scenario's prior_turn_deg and prior_shift_m"),
            std::string::npos)
      << answer.err;
  EXPECT_EQ(lines_of(answer.err).size(), 1U) << answer.err;
}

}  // namespace
}  // namespace lasso::ft
