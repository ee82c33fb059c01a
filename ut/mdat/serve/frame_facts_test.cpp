#include "mdat/serve/frame_facts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "ut/mdat/serve/small_recording.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::serve {
namespace {

std::map<std::string, double> facts_of(const PoseTelemetry& told, const std::optional<Pose>& truth) {
  ValueTable table;
  add_facts(0, FrameFacts(told, truth), table);
  std::map<std::string, double> numbers;
  for (const Value& value : fact_values(0)) numbers[value.id] = static_cast<double>(table.columns.at(value.column).at(0));
  return numbers;
}

// The estimate is 3 and -4 mm and 0.2 deg off by construction; sigmas are 1, 2, 3 mrad and 4, 5, 6 mm.
TEST(FrameFacts, ErrorsAndSigmasAreThoseOfTheConstruction) {
  VERIFIES("LASSO-WEB-008~1");
  const auto facts = facts_of(SmallRecording{}.told(1), SmallRecording::truth(1));
  EXPECT_NEAR(facts.at("error.position"), 5, 1e-4);
  EXPECT_NEAR(facts.at("error.x"), 3, 1e-4);
  EXPECT_NEAR(facts.at("error.z"), -4, 1e-4);
  EXPECT_NEAR(facts.at("error.angle"), 0.2, 1e-5);
  EXPECT_NEAR(facts.at("error.filtered_position"), 0, 1e-4);
  EXPECT_NEAR(facts.at("sigma.position"), std::sqrt(16 + 25 + 36), 1e-4);
  EXPECT_NEAR(facts.at("sigma.angle"), std::sqrt(1 + 4 + 9) * 1e-3 / kRadPerDeg, 1e-6);
  EXPECT_NEAR(facts.at("residual.rms"), 2, 1e-4);
  EXPECT_NEAR(facts.at("rate.linear"), 1e3 * SmallRecording::rates().v_mps.norm(), 1e-3);
  EXPECT_NEAR(facts.at("range.true"), SmallRecording::truth(1).p.norm(), 1e-6);
  EXPECT_EQ(facts.at("error.wrong"), 0);
  // 0.2 deg about z of sigma 3 mrad; 3 mm of 4, -4 mm of 6
  const double turn = 0.2 * kRadPerDeg / 3e-3;
  EXPECT_NEAR(facts.at("error.normalised_squared"), turn * turn + 9.0 / 16 + 16.0 / 36, 1e-4);
}

TEST(FrameFacts, AValidPoseThatIsFarOffIsWrong) {
  VERIFIES("LASSO-WEB-008~1");
  EXPECT_EQ(facts_of(SmallRecording{}.told(3), SmallRecording::truth(3)).at("error.wrong"), 1);
}

TEST(FrameFacts, WhatIsNotKnownIsNoNumber) {
  VERIFIES("LASSO-WEB-008~1");
  const auto without = facts_of(SmallRecording{}.told(1), std::nullopt);
  for (const char* id : {"error.position", "error.wrong", "error.normalised_squared", "range.true", "truth.qw"})
    EXPECT_TRUE(std::isnan(without.at(id))) << id;
  EXPECT_NEAR(without.at("sigma.position"), std::sqrt(77), 1e-4);
  const auto lost = facts_of(SmallRecording{}.told(4), SmallRecording::truth(4));  // its registration did not run
  for (const char* id : {"error.position", "sigma.position", "residual.rms"}) EXPECT_TRUE(std::isnan(lost.at(id))) << id;
  EXPECT_NEAR(lost.at("error.filtered_position"), 0, 1e-4);
}

}  // namespace
}  // namespace lasso::mdat::serve
