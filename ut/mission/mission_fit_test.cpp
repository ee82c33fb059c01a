#include "fsw/mission/mission_fit.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

class MissionFit : public ::testing::Test {
 protected:
  MissionFit() {
    mission_->parameters = preset_parameters();
    EXPECT_TRUE(mission_->sensors.push_back(mission_->parameters));
  }
  const char* fault(std::size_t sensors = 1) const { return fault_of(*mission_, *parts_, sensors); }

  std::unique_ptr<Mission> mission_ = std::make_unique<Mission>();
  std::unique_ptr<Parts> parts_ = std::make_unique<Parts>();
};

TEST_F(MissionFit, NamesWhatDoesNotFit) {
  VERIFIES("LASSO-IMG-013~1");
  EXPECT_EQ(fault(), nullptr);
  EXPECT_STREQ(fault(0), "the mission has more sensors than are connected");
  MissionParameters& p = mission_->parameters;
  p.short_range_enter_m = 2;
  EXPECT_STREQ(fault(), "short_range.leave_m is not above short_range.enter_m");
  p.short_range_leave_m = 3;
  EXPECT_EQ(fault(), nullptr);
  p.duration_s = 2 * p.period_s;
  EXPECT_STREQ(fault(), "scan.duration_s exceeds filter.period_s");
  p.duration_s = p.period_s / 2;
  Part part;
  part.mission.parameters = p;
  part.mission.parameters.duration_s = 2 * p.period_s;
  ASSERT_TRUE(parts_->push_back(part));
  EXPECT_STREQ(fault(), "scan.duration_s exceeds filter.period_s");
  (*parts_)[0].mission.parameters.duration_s = p.period_s;
  EXPECT_EQ(fault(), nullptr) << "as long as the period is not too long";
  p.duration_s = 2 * p.period_s;
  EXPECT_STREQ(fault(), "scan.duration_s exceeds filter.period_s") << "the whole's alone";
}

TEST_F(MissionFit, NamesRangesThatAreNone) {
  VERIFIES("LASSO-IMG-013~1");
  mission_->sensors[0].range_min_m = mission_->sensors[0].range_max_m;
  EXPECT_STREQ(fault(), "sensor.range_min_m is not below sensor.range_max_m");
  mission_->sensors[0] = mission_->parameters;
  mission_->sensors[0].use_from_m = mission_->sensors[0].use_to_m;
  EXPECT_STREQ(fault(), "sensor.use_from_m is not below sensor.use_to_m");
}

TEST_F(MissionFit, NamesASensorThatReachesTooFarForAPart) {
  VERIFIES("LASSO-IMG-021~1");
  Part part;
  part.mission.parameters = mission_->parameters;
  part.mission.radius_m = FlightNumber::kFarthest_m - mission_->sensors[0].range_max_m - 1;
  ASSERT_TRUE(parts_->push_back(part));
  EXPECT_TRUE(mission_->sensors.push_back(mission_->parameters));
  EXPECT_EQ(fault(2), nullptr);
  mission_->sensors[1].range_max_m += 2;
  ASSERT_NE(fault(2), nullptr);
  EXPECT_NE(std::string(fault(2)).find("sensor.range_max_m and the model's radius"), std::string::npos) << fault(2);
}

TEST_F(MissionFit, AFrameStaysAsLongAsItIs) {
  VERIFIES("LASSO-IMG-013~1");
  const auto next = std::make_unique<Mission>(*mission_);
  EXPECT_EQ(fault_of_change(*mission_, *next), nullptr);
  next->parameters.period_s *= 2;
  EXPECT_STREQ(fault_of_change(*mission_, *next), "filter.period_s is not that of the active image");
}

TEST_F(MissionFit, ATrackIsKeptForTheSameTarget) {
  VERIFIES("LASSO-IMG-013~1");
  const auto next = std::make_unique<Mission>(*mission_);
  const auto next_parts = std::make_unique<Parts>();
  EXPECT_TRUE(keeps_track(*mission_, *parts_, *next, *next_parts));
  next->id = 99;
  EXPECT_FALSE(keeps_track(*mission_, *parts_, *next, *next_parts));
  *next = *mission_;
  ASSERT_TRUE(next->sensors.push_back(mission_->parameters));
  EXPECT_FALSE(keeps_track(*mission_, *parts_, *next, *next_parts));
  ASSERT_TRUE(next_parts->push_back(Part{}));
  EXPECT_FALSE(keeps_track(*mission_, *parts_, *mission_, *next_parts));
}

}  // namespace
}  // namespace lasso
