// mdat/recording/export_poses.cpp: trajectories and ephemerides.
#include <cstdio>
#include <sstream>

#include "mdat/common/errors.hpp"
#include "mdat/recording/recording_export.hpp"
#include "mdat/scene/ccsds.hpp"
#include "ut/mdat/recording/small_recording.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using ExportPoses = SmallRecording;

TEST_F(ExportPoses, TumLinesAreTimePlaceAndQuaternion) {
  VERIFIES("LASSO-REC-014~1");
  const ExportedFiles exported = export_tum(write("run.mcap"), {});
  ASSERT_EQ(exported.files.size(), 2U);
  std::istringstream lines(exported.files.at("pose.tum"));
  for (int i = 0; i < 6; ++i) {
    double t_s = 0, v[7] = {};
    lines >> t_s;
    for (double& value : v) lines >> value;
    const Pose pose = small_pose(1 + 0.5 * i);
    EXPECT_EQ(t_s, 1 + 0.5 * i);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(v[k], pose.p[k]);
    const double q[] = {pose.q.x(), pose.q.y(), pose.q.z(), pose.q.w()};
    for (int k = 0; k < 4; ++k) EXPECT_EQ(v[3 + k], q[k]);
  }
  EXPECT_TRUE(lines.good());
}

// Read again by the reader of ephemerides, which tests of its own compare with examples of the standard.
TEST_F(ExportPoses, EphemeridesAreReadAgainAsTheTrajectory) {
  VERIFIES("LASSO-REC-014~1");
  const auto run = write("run.mcap");
  ExportOptions options;
  options.epoch = "2026-12-31T23:59:58.5";  // over the end of a year
  const scene::Ephemeris orbit = scene::parse_oem(export_oem(run, options), "run.oem", {"SENSOR"});
  const scene::Ephemeris attitude = scene::parse_aem(export_aem(run, options), "run.aem", {"SENSOR"});
  EXPECT_NEAR(scene::seconds_between(*scene::parse_epoch(options.epoch), orbit.first), 1, 1e-6);
  ASSERT_EQ(orbit.table.times_s.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    const double t_s = 1 + 0.5 * static_cast<double>(i);
    EXPECT_NEAR(orbit.table.times_s[i], t_s - 1, 1e-6);
    EXPECT_LT((orbit.table.positions_m[i] - small_pose(t_s).p).norm(), 1e-9);
    EXPECT_LT((orbit.table.velocities_mps[i] - small_velocity(t_s)).norm(), 1e-9);
    EXPECT_LT(log_so3(attitude.table.attitudes[i].conjugate() * small_pose(t_s).q).norm(), 1e-9);
  }
}

// Positions that are a parabola in time have these derivatives.
TEST_F(ExportPoses, VelocitiesOfATopicWithoutThemAreDerivatives) {
  VERIFIES("LASSO-REC-014~1");
  ExportOptions options;
  options.topic = "/pose";
  const std::string text = export_oem(write("run.mcap"), options);
  EXPECT_NE(text.find("COMMENT velocities are derivatives of parabolas"), std::string::npos);
  const scene::Ephemeris orbit = scene::parse_oem(text, "run.oem", {"SENSOR"});
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_LT((orbit.table.velocities_mps[i] - small_velocity(1 + 0.5 * static_cast<double>(i))).norm(), 1e-9) << i;
}

TEST_F(ExportPoses, ATopicThatIsNotThereIsNamedWithThoseThatAre) {
  VERIFIES("LASSO-REC-008~2");
  ExportOptions options;
  options.topic = "/nowhere";
  try {
    (void)export_tum(write("run.mcap"), options);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("/odom (nav_msgs/msg/Odometry), /pose"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace lasso::mdat
