#include "mdat/trial/flight_results.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TrialPose pose_of(std::size_t light, double off_mm, double nees) {
  TrialPose pose;
  pose.light = light;
  pose.reason = PoseReason::kValid;
  pose.off_m = 1e-3 * off_mm;
  pose.off_rad = 0.1 * off_mm * kRadPerDeg;
  pose.nees = nees;
  return pose;
}

FlightTrialResult two_flights() {
  FlightTrialResult result{"spin", 2, chosen_lights({"sun_behind", "lamp"}), {}, {}};
  result.rendered = {pose_of(0, 3, 4), pose_of(0, 5, 8), pose_of(1, 2, 3)};
  result.fitted = {pose_of(0, 4, 9), pose_of(1, 1, 3)};
  return result;
}

TEST(FlightResults, SetFittedErrorsBesideRenderedPairs) {
  VERIFIES("LASSO-STE-017~1");
  const FlightTrialResult result = two_flights();
  const auto json = nlohmann::ordered_json::parse(flights_json(result));
  EXPECT_NEAR(json.at("lights").at("sun_behind").at("rendered").at("rms_mm").get<double>(), std::sqrt(17), 1e-9);
  EXPECT_NEAR(json.at("lights").at("lamp").at("fitted").at("nees").get<double>(), 3, 1e-9);
  EXPECT_EQ(json.at("fitted").at("valid"), 2);
  const std::string text = flights_text(result);
  EXPECT_NE(text.find("rendered pairs"), std::string::npos) << text;
  EXPECT_NE(text.find("0.97"), std::string::npos) << "4 / sqrt(17) of the Sun behind: " << text;
  EXPECT_NE(text.find("0.50"), std::string::npos) << "of the lamp: " << text;
}

TEST(FlightResults, SayOneLineAFrame) {
  VERIFIES("LASSO-STE-017~1");
  const std::string csv = flights_csv(two_flights());
  EXPECT_EQ(csv.find("model,light,flight,draw,frame,reason"), 0U) << csv;
  EXPECT_NE(csv.find("\nrendered,lamp,0,0,0,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\nfitted,sun_behind,0,0,0,"), std::string::npos) << csv;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 6);
}

}  // namespace
}  // namespace lasso::mdat
