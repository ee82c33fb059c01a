#include "ut/mdat/missiondb/rules_support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

class TargetRules : public RuleTest {};

const std::string kFiveAway = "ranges_m = [5]\n";

TEST_F(TargetRules, CellsFitTheTarget) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_edge("target.cell_size_m = 0.0045", "target.cell_size_m = 0.0044", "warning: ", "455 cells along it");
  expect_edge("target.cell_size_m = 0.16", "target.cell_size_m = 0.2", "warning: ", "10 cells along it");
  expect_edge("target.cell_size_m = 0.02", "target.cell_size_m = 0.001", "error: ", "take larger cells, about 0.0182 m");
}

TEST_F(TargetRules, TheInitialPoseIsInReachAndInTheField) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  const std::string present = "tracking.initial.present = true\ntracking.initial.z_m = ";
  // half of the box's diagonal is 1.22 m
  expect_edge(present + "21.2", present + "21.3", "tracking.initial.z_m: 21.3", "wholly outside the ranges");
  expect_edge(present + "5\ntracking.initial.x_m = 1.33", present + "5\ntracking.initial.x_m = 1.35", "tracking.initial.x_m: 1.35",
              "15.1 deg off the boresight");
  expect_edge("tracking.start_sigma_m = 2.5", "tracking.start_sigma_m = 3", "tracking.start_sigma_m: 3", "60 % of the range of 5 m");
}

TEST_F(TargetRules, TheTargetIsInTheField) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_scenario_edge(kFiveAway + "offset_m = [1.33, 0]", kFiveAway + "offset_m = [1.35, 0]",
                       "warning: ", "at 5 m the target's middle is outside of the field: its middle is 15.1 deg off");
  expect_scenario_edge(kFiveAway + "offset_m = [0, -1.33]", kFiveAway + "offset_m = [0, -5]",
                       "warning: ", "wholly outside of the field: its middle is 45 deg off");
}

TEST_F(TargetRules, TheMiddleOfAMeshThatIsNotAboutItsOriginCounts) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  folder_.write("box.toml", "[[part]]\nkind = 'box'\nsize = [2, 1, 1]\nplace = [{move = [0, 8, 0]}]\n");
  // The target's y is the sensor's x where tilt and turn are none.
  expect_scenario_edge(kFiveAway + "tilt_deg = 0\nboresight_deg = 0\noffset_m = [-8, 0]",
                       kFiveAway + "tilt_deg = 0\nboresight_deg = 0\noffset_m = [0, 0]", "scenario.s.offset_m",
                       "wholly outside of the field: its middle is 58 deg off");
}

TEST_F(TargetRules, ADriftStaysInTheField) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  // 1.34 m beside the boresight at 0.1 m/s: 13.4 s
  expect_scenario_edge(kFiveAway + "offset_m = [0, 0]\ndrift_mps = [0.1, 0, 0]\nframes = 67",
                       kFiveAway + "offset_m = [0, 0]\ndrift_mps = [0.1, 0, 0]\nframes = 80", "scenario.s.drift_mps",
                       "after 13.4 s, in frame 67 of 80");
}

// A box of 6 x 4 x 4 m; z of the target points away from the sensor where it is not tilted.
TEST_F(TargetRules, TheSensorIsOutsideOfTheTarget) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  const auto is_refused = [&](const std::string& box_z, const std::string& scenario) {
    folder_.write("box.toml", "[[part]]\nkind = 'box'\nsize = [6, 4, 4]\nplace = [{move = [0, 0, " + box_z + "]}]\n");
    const std::string text =
        said("sensor.range_min_m = 0.1\ntarget.cell_size_m = 0.05", "tilt_deg = 0\nboresight_deg = 0\n" + scenario + "\n");
    const bool inside = text.find("the sensor would be in the target, which is 6 by 4 by 4 m") != std::string::npos;
    EXPECT_EQ(text.rfind("error: ", 0) == 0, inside) << text;
    return inside;
  };
  const std::string at = "ranges_m = ", in_depth = "times_s = [0, 100]\nframes = 500\nnavigation_from_s = 0";
  EXPECT_FALSE(is_refused("0", at + "[2.1]"));
  EXPECT_TRUE(is_refused("0", at + "[1.9]"));
  EXPECT_FALSE(is_refused("0", at + "[1.9]\noffset_m = [2.1, 0]")) << "beside it";
  EXPECT_FALSE(is_refused("0", at + "[1]\ncenter_m = [0, 0, -2]"));
  EXPECT_TRUE(is_refused("0", at + "[1]\ncenter_m = [0, 0, 2]"));
  EXPECT_TRUE(is_refused("0", at + "[1.9]\ndrawn = true"));
  EXPECT_FALSE(is_refused("0", at + "[2.1]\ndrawn = true")) << "outside in some attitudes";
  // The origin is in the face towards the sensor, then in the opposite one.
  const std::string docking = "autonomous = true\nranges_m = [10, 1.5]\n" + in_depth;
  EXPECT_FALSE(is_refused("2", docking));
  EXPECT_TRUE(is_refused("-2", docking));
}

TEST_F(TargetRules, TheSensorWhoseFieldIsMissedIsNamed) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  const std::string near =
      "further_sensor.near.use_to_m = 6\nfurther_sensor.near.fov_half_x_deg = 3\nfurther_sensor.near.fov_half_y_deg = 3";
  expect_said(said(near, kFiveAway + "offset_m = [0.5, 0]"),
              "warning: ", "outside of the field of further_sensor.near: its middle is 5.71 deg off");
}

TEST_F(TargetRules, TheBeamIsNarrowAgainstTheTarget) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_scenario_edge(kFiveAway + "edge_mixing_m = 0.01", kFiveAway + "edge_mixing_m = 0.05", "scenario.s.edge_mixing_m: 0.05",
                       "radius of 50 mm at 5 m");
  expect_scenario_edge(kFiveAway + "beam_divergence_rad = 0.0019", kFiveAway + "beam_divergence_rad = 0.01", "scenario.s.edge_mixing_m",
                       "radius of 50 mm at 5 m");
}

TEST_F(TargetRules, CreasesAreInDegrees) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_edge("target.crease_angle_deg = 2", "target.crease_angle_deg = 0.5", "target.crease_angle_deg: 0.5", "0.5 rad are 28.6 deg");
  EXPECT_EQ(said("target.crease_angle_deg = 0"), "");
}

TEST_F(TargetRules, ABearingHasTheReturnsOfAFullField) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  // A mean shadow of 2.5 m2 of a field of 7.2 m2, 2.68 m squared: 357 rays of 1024.
  const std::string search = "start.fifth = 'search'\nbearing.returns_min = ";
  expect_edge(search + "350", search + "360", "bearing.returns_min: 360", "some 357 rays meet the target at 5 m",
              kFiveAway + "prior = false");
}

TEST_F(TargetRules, PartsServeWhereTheTargetIs) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  const std::string range = "short_range.enter_m = 5.1\nshort_range.leave_m = 6\n";
  const std::string part = range + "part.a.box_m = [-1, -0.5, -0.5, 0, 0.5, 0.5]\npart.a.view = [0, 0, -1]\n";
  expect_edge(part + "part.a.range_m = [0.5, 5.1]", part + "part.a.range_m = [0.5, 4]",
              "warning: ", "nearer than 5 m, where these parts do not serve, by their range_m: a");
  expect_edge(part + "part.a.range_m = [0.5, 6]\npart.a.cone_deg = 5", part + "part.a.range_m = [0.5, 6]\npart.a.cone_deg = 1.3",
              "warning: ", "by their cone_deg: a");
  const std::string far =
      "part.a.box_m = [-1, -0.5, -0.5, 0, 0.5, 0.5]\npart.a.view = [0, 0, -1]\npart.a.range_m = [0.5, 6]\nshort_range.leave_m = "
      "6\nshort_range.enter_m = ";
  expect_edge(far + "5", far + "4.9", "short_range.enter_m: 4.9", "nearer than 5 m: its parts are never looked at");
}

}  // namespace
}  // namespace lasso::mdat
