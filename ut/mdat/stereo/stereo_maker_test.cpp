#include "mdat/stereo/stereo_maker.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "fsw/sense/pattern.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/run/simulation.hpp"
#include "ut/support/places.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

MissionInput shipped_stereo(const std::vector<std::string>& settings = {}) {
  return load_mission_input(test::source_folder() / "cfg/missions/hubble_stereo.toml", settings);
}

std::string refusal_of(const MissionInput& mission) {
  try {
    static_cast<void>(stereo_without_pictures(mission, 1, "campaigns"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// Two scans, 0.2 s apart, of a few rays within 8 degrees of the axis.
std::vector<RangeSample> scans_of(const MissionInput& mission, std::uint64_t seed) {
  const CaseSetup setup = plain_case(mission.source, scenario_of(mission.source, "spin"), 3, 2);
  const std::unique_ptr<MadeSensor> made = stereo_without_pictures(mission, 3, "tests")(setup, seed);
  ScanPlan plan;
  plan.points = 128;
  plan.cycles_a = 7;
  plan.cycles_b = 5;
  plan.half_x = plan.half_y = 0.14;
  std::vector<RangeSample> samples(256);
  for (int scan = 0; scan < 2; ++scan) {
    const TimeUs t_us = kEpochUs + 200000 * scan;
    EXPECT_EQ(made->sensor().start(plan, t_us), Status::kOk) << made->failure();
    EXPECT_EQ(made->sensor().poll(t_us, {samples.data() + 128 * scan, 128}).count, 128U);
  }
  return samples;
}

TEST(StereoMaker, OfManyCasesHasNoPictures) {
  VERIFIES("LASSO-STE-018~1");
  const std::string refusal = refusal_of(shipped_stereo());
  EXPECT_NE(refusal.find("hubble_stereo.toml: stereo.model: rendered: pictures take seconds a frame, and campaigns fly stereo cameras by "
                         "fitted errors alone: --set stereo.model=fitted"),
            std::string::npos)
      << refusal;
  EXPECT_EQ(refusal_of(shipped_stereo({"stereo.model=fitted"})), "");
  const MissionInput laser = load_mission_input(test::source_folder() / "cfg/missions/hubble_tenth.toml");
  EXPECT_FALSE(stereo_without_pictures(laser, 1, "campaigns")) << "has no stereo head, and needs none";
  EXPECT_FALSE(has_stereo_head(laser.source));
}

TEST(StereoMaker, FittedErrorsAreThoseOfTheSeed) {
  VERIFIES("LASSO-STE-016~1");
  const MissionInput mission = shipped_stereo({"stereo.model=fitted", "stereo.pixels=400"});
  const std::vector<RangeSample> once = scans_of(mission, 5), again = scans_of(mission, 5), other = scans_of(mission, 6);
  std::size_t returns = 0, differing = 0;
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(std::memcmp(&once[i].range_m, &again[i].range_m, sizeof once[i].range_m), 0);
    EXPECT_EQ(once[i].state, again[i].state);
    EXPECT_NE(once[i].state, RayState::kMiss) << "a hole is no miss";
    if (once[i].state != RayState::kHit) continue;
    ++returns;
    EXPECT_NEAR(once[i].range_m, 3, 1) << "the target is at 3 m";
    if (once[i].range_m != other[i].range_m) ++differing;
  }
  EXPECT_GT(returns, 60U);
  EXPECT_GT(differing, returns / 2);
}

}  // namespace
}  // namespace lasso::mdat
