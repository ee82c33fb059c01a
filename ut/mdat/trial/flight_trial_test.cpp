#include "mdat/trial/flight_trial.hpp"

#include <gtest/gtest.h>

#include "mdat/common/errors.hpp"
#include "ut/support/places.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

std::string refusal_of(const std::string& name, const std::string& scenario) {
  const CompiledMission mission{load_mission_input(test::source_folder() / "cfg/missions" / name, {}, scenario), {}, {}, {}, 0};
  FlightTrialOptions options;
  options.scenario = scenario;
  try {
    static_cast<void>(try_flights(mission, options));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(FlightTrial, NeedsAStereoHeadAndOneRange) {
  VERIFIES("LASSO-STE-017~1");
  const std::string laser = refusal_of("hubble_tenth.toml", "spin");
  EXPECT_NE(laser.find("hubble_tenth.toml: has no stereo head to fly: sensor.kind = \"stereo\" makes one"), std::string::npos) << laser;
}

TEST(FlightTrial, AFrameIsAPoseWithItsVerdict) {
  VERIFIES("LASSO-STE-017~1");
  FrameError frame;
  frame.frame = 7;
  frame.reason = PoseReason::kValid;
  frame.valid = true;
  frame.wrong = true;
  frame.returns = 321;
  frame.registration.translation_m = Vec3(0.003, 0, -0.004);
  frame.registration.rotation_rad = 0.01;
  frame.sigma_m = 0.002;
  frame.nees = 5;
  const TrialPose pose = flown_pose(frame);
  EXPECT_TRUE(pose.valid() && pose.wrong);
  EXPECT_EQ(pose.scan, 7U);
  EXPECT_EQ(pose.returns, 321U);
  EXPECT_NEAR(pose.off_m, 0.005, 1e-12);
  EXPECT_EQ(pose.off_rad, 0.01);
  EXPECT_EQ(pose.sigma_m, 0.002);
  EXPECT_EQ(pose.nees, 5);
  frame.valid = false;
  EXPECT_FALSE(flown_pose(frame).valid());
}

}  // namespace
}  // namespace lasso::mdat
