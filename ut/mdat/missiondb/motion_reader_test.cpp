#include "mdat/missiondb/motion_reader.hpp"

#include <cmath>

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/so3.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

const std::string kMotionHead = "[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmodel = 'box.toml'\n";  // 6 lines
constexpr TimeUs kTimesUs[] = {-1'300'000, 0, 700'001, 2'500'000, 61'000'000};

class MotionReaderTest : public ::testing::Test {
 protected:
  MotionReaderTest() { folder_.write("box.toml", "[[part]]\nkind = 'box'\nsize = [1, 1, 1]\n"); }
  MissionSource load(const std::string& text) { return load_mission(folder_.write("m.toml", kMotionHead + text)); }
  scene::MotionPtr motion(const std::string& text) { return load("[motion.m]\n" + text).scene.motions.at("m"); }
  std::string problems(const std::string& text) {
    return mission_error_of([&] { static_cast<void>(load(text)); });
  }
  Folder folder_;
};

TEST_F(MotionReaderTest, RatesTurnAboutAPivotThatDrifts) {
  VERIFIES("LASSO-SCN-020~2");
  const auto rates = motion(
      "kind = 'rates'\nposition_m = [1, 2, 3]\nquaternion = [0.48, -0.36, 0, 0.8]\nvelocity_mps = [0.1, 0, -0.2]\n"
      "spin_degps = [3, -4, 5]\npivot_m = [0.5, 0, 0.25]\n");
  const Quat q0(0.8, 0.48, -0.36, 0);
  const Vec3 spin = Vec3(3, -4, 5) * kRadPerDeg, pivot(0.5, 0, 0.25);
  for (const TimeUs t_us : kTimesUs) {
    const double t_s = to_seconds(t_us);
    const Quat q = q0 * Quat(Eigen::AngleAxisd(spin.norm() * t_s, spin.normalized()));  // about axes that turn with the node
    const Vec3 p = Vec3(1, 2, 3) + t_s * Vec3(0.1, 0, -0.2) - q * pivot;
    const scene::MotionState state = rates->at(t_us);
    EXPECT_LT(q.angularDistance(state.T_a_b.q), 1e-9);
    EXPECT_LT((state.T_a_b.p - p).norm(), 1e-9);
    EXPECT_LT((state.rates.omega_radps - q0 * spin).norm(), 1e-12);
    EXPECT_LT((state.rates.v_mps - (Vec3(0.1, 0, -0.2) - (q0 * spin).cross(q * pivot))).norm(), 1e-12);
  }
}

TEST_F(MotionReaderTest, StepsTurnAtTheBeginOfEachPeriod) {
  VERIFIES("LASSO-SCN-020~2");
  const auto steps = motion("kind = 'steps'\naxis = [0, 0, 2]\nstep_deg = 15\nperiod_s = 0.5\nposition_m = [0, 1, 4]\n");
  for (const auto& [t_us, deg] : {std::pair<TimeUs, double>{0, 0}, {499'999, 0}, {500'000, 15}, {1'700'000, 45}, {-1, -15}}) {
    const Quat q(Eigen::AngleAxisd(deg * kRadPerDeg, Vec3::UnitZ()));
    EXPECT_LT(q.angularDistance(steps->at(t_us).T_a_b.q), 1e-9) << t_us;
    EXPECT_EQ(steps->at(t_us).T_a_b.p, Vec3(0, 1, 4));
  }
}

TEST_F(MotionReaderTest, WaypointsAreReachedSmoothlyAndAtRest) {
  VERIFIES("LASSO-SCN-020~2");
  const auto way = motion(
      "kind = 'waypoints'\nquaternion = [0, 0, 0.6, 0.8]\nat = [{time_s = 10, position_m = [0, 0, 8]}, {time_s = 14, position_m = [1, 0, "
      "4]}]\n");
  for (const double u : {0.0, 0.2, 0.5, 0.9, 1.0}) {
    const scene::MotionState state = way->at(static_cast<TimeUs>(std::llround(1e6 * (10 + 4 * u))));
    const double share = u * u * (3 - 2 * u);
    EXPECT_LT((state.T_a_b.p - Vec3(share, 0, 8 - 4 * share)).norm(), 1e-12);
    EXPECT_LT((state.rates.v_mps - 6 * u * (1 - u) / 4 * Vec3(1, 0, -4)).norm(), 1e-12);
    EXPECT_LT(Quat(0.8, 0, 0, 0.6).angularDistance(state.T_a_b.q), 1e-9);
  }
  EXPECT_EQ(way->at(0).T_a_b.p, Vec3(0, 0, 8));
}

TEST_F(MotionReaderTest, MotionsOfAnOrbitAreThoseOfItsHillFrame) {
  VERIFIES("LASSO-SCN-020~2");
  const MissionSource source = load(
      "[orbit]\naltitude_km = 400\nbeta_deg = 20\nangle_deg = 30\n"
      "[motion.fixed]\nkind = 'inertial'\nquaternion = [0, 0.6, 0, 0.8]\n"
      "[motion.plan]\nkind = 'clohessy_wiltshire'\nposition_m = [0, -50, 0]\n"
      "legs = [{kind = 'hold', duration_s = 10}, {kind = 'transfer', duration_s = 100, to_m = [1, -20, 2]}]\n"
      "[motion.sun]\nkind = 'sun_pointing'\naxis = [0, 0, 3]\n"
      "[motion.both]\nkind = 'chain'\nof = ['plan', 'fixed']\n");
  const scene::Orbit& orbit = *source.scene.orbit;
  const double n = std::sqrt(3.986004418e14 / std::pow(6371008.8 + 400e3, 3));
  const auto turned = source.scene.motions.at("fixed")->at(100'000'000).T_a_b.q;
  EXPECT_LT((Quat(Eigen::AngleAxisd(-100 * n, Vec3::UnitZ())) * Quat(0.8, 0, 0.6, 0)).angularDistance(turned), 1e-9);
  EXPECT_EQ(source.scene.motions.at("plan")->at(5'000'000).T_a_b.p, Vec3(0, -50, 0));
  EXPECT_LT((source.scene.motions.at("plan")->at(200'000'000).T_a_b.p - Vec3(1, -20, 2)).norm(), 1e-9);
  EXPECT_LT((source.scene.motions.at("sun")->at(7'000'000).T_a_b.q * Vec3::UnitZ() - orbit.sun_hill(7'000'000)).norm(), 1e-12);
  const Pose both = source.scene.motions.at("both")->at(200'000'000).T_a_b;
  EXPECT_LT((both.p - Vec3(1, -20, 2)).norm(), 1e-9);
  EXPECT_LT((Quat(Eigen::AngleAxisd(-200 * n, Vec3::UnitZ())) * Quat(0.8, 0, 0.6, 0)).angularDistance(both.q), 1e-9);
}

TEST_F(MotionReaderTest, TablesAndEphemeridesComeFromTheirFiles) {
  VERIFIES("LASSO-SCN-020~2");
  folder_.write("way.csv", "time_s,x_m,y_m,z_m\n0,0,0,10\n5,1,0,10\n10,2,0,10\n");
  folder_.write(
      "chaser.oem",
      "CCSDS_OEM_VERS = 2.0\nCREATION_DATE = 2026-01-01T00:00:00\nORIGINATOR = TEST\nMETA_START\nOBJECT_NAME = C\nOBJECT_ID = C\n"
      "CENTER_NAME = EARTH\nREF_FRAME = RTN\nTIME_SYSTEM = UTC\nSTART_TIME = 2026-01-01T00:00:00\nSTOP_TIME = 2026-01-01T00:00:20\n"
      "META_STOP\n2026-01-01T00:00:00 0 -0.05 0 0 0.001 0\n2026-01-01T00:00:20 0 -0.03 0 0 0.001 0\n");
  const MissionSource source = load(
      "[motion.t]\nkind = 'table'\nfile = 'way.csv'\n[motion.o]\nkind = 'oem'\nfile = 'chaser.oem'\nframe = 'RTN'\n"
      "[motion.tumble]\nkind = 'torque_free'\nspin_degps = [0, 0, 6]\ninertia = [1, 2, 3]\n");
  EXPECT_LT((source.scene.motions.at("t")->at(2'500'000).T_a_b.p - Vec3(0.5, 0, 10)).norm(), 1e-12);
  EXPECT_LT((source.scene.motions.at("o")->at(10'000'000).T_a_b.p - Vec3(0, -40, 0)).norm(), 1e-9);
  const Quat third(Eigen::AngleAxisd(60 * kRadPerDeg, Vec3::UnitZ()));
  EXPECT_LT(third.angularDistance(source.scene.motions.at("tumble")->at(10'000'000).T_a_b.q), 1e-9);
  EXPECT_NE(std::find(source.named_files.begin(), source.named_files.end(), folder_.path() / "way.csv"), source.named_files.end());
}

TEST_F(MotionReaderTest, TablesAreWithinTheLimitsOfMissions) {
  VERIFIES("LASSO-SCN-024~1");
  folder_.write("far.csv", "time_s,x_m,y_m,z_m\n0,0,0,0\n2,1e20,0,0\n");
  EXPECT_NE(problems("[motion.t]\nkind = 'table'\nfile = 'far.csv'\n")
                .find("far.csv:3:1: position: expected finite numbers, each from -1e9 to 1e9"),
            std::string::npos);
}

TEST_F(MotionReaderTest, EveryProblemIsToldWithItsPlace) {
  VERIFIES("LASSO-SCN-024~1");
  const std::string said = problems(
      "[motion.a]\nkind = 'rate'\n"
      "[motion.b]\nkind = 'rates'\nspin_radps = [1, 2, 3]\nquaternion = [0, 0, 0, 0.5]\n"
      "[motion.c]\nkind = 'clohessy_wiltshire'\nlegs = [{kind = 'hold'}]\n"
      "[motion.d]\nkind = 'table'\nfile = 'none.csv'\n"
      "[motion.e]\nkind = 'chain'\nof = ['f']\n[motion.f]\nkind = 'chain'\nof = ['e']\n"
      "[motion.g]\nkind = 'chain'\nof = ['bb']\n"
      "[motion.h]\nkind = 'waypoints'\n"
      "[motion.i]\nkind = 'waypoints'\nat = [{time_s = 2, position_m = [0, 0, 0]}, {time_s = 1, position_m = [0, 0, 1]}]\n"
      "[orbit]\naltitude_km = -5\n");
  for (const char* expected : {"m.toml:8:8: motion.a.kind: \"rate\": expected one of still, rates,", "did you mean rates?",
                               "m.toml:11:1: motion.b.spin_radps: unknown key; see cfg/mission.schema.json",
                               "motion.b.quaternion: [0, 0, 0, 0.5]: expected x, y, z, w of unit length",
                               "motion.c.legs[0].duration_s: is missing", "motion.d.file: \"none.csv\": no such file",
                               "motion.e.of: is part of itself", "motion.g.of: there is no motion \"bb\"; did you mean",
                               "motion.h.at: expected a list of tables", "orbit.altitude_km: -5: out of range"}) {
    EXPECT_NE(said.find(expected), std::string::npos) << expected << "\nin:\n" << said;
  }
  EXPECT_NE(said.find("motion.i, time: 1 s: is not after 2 s of the row before"), std::string::npos) << said;
}

TEST_F(MotionReaderTest, ChainsAreShortAndKeepTheAxesThatTheirLinksNeed) {
  VERIFIES("LASSO-SCN-024~1");
  std::string nested = "[motion.c0]\nkind = 'still'\n";
  for (int i = 1; i <= 7; ++i) {
    const std::string before = "'c" + std::to_string(i - 1) + "'";
    nested +=
        "[motion.c" + std::to_string(i) + "]\nkind = 'chain'\nof = [" + before + ", " + before + ", " + before + ", " + before + "]\n";
  }
  EXPECT_NE(problems(nested).find("motion.c4.of: has 256 motions: expected at most 64"), std::string::npos) << problems(nested);
  const std::string lost = problems("[motion.f]\nkind = 'chain'\nof = ['nn']\n[motion.g]\nkind = 'chain'\nof = ['f']\n");
  EXPECT_NE(lost.find("motion.f.of: there is no motion \"nn\""), std::string::npos) << lost;
  EXPECT_EQ(lost.find("part of itself"), std::string::npos) << lost;
  const std::string turned = problems(
      "[orbit]\n[motion.spin]\nkind = 'rates'\nspin_degps = [1, 0, 0]\n[motion.sun]\nkind = 'sun_pointing'\n[motion.c]\nkind = 'chain'\n"
      "of = ['spin', 'sun']\n");
  EXPECT_NE(turned.find("\"sun\" is a motion in the Hill frame's axes"), std::string::npos) << turned;
}

TEST_F(MotionReaderTest, RelativeMotionNeedsAnOrbitAndLegsTheirOwnKeys) {
  VERIFIES("LASSO-SCN-024~1");
  EXPECT_NE(problems("[motion.m]\nkind = 'inertial'\n").find("motion.m.kind: \"inertial\": needs the mission's orbit: add [orbit]"),
            std::string::npos);
  const std::string said =
      problems("[orbit]\n[motion.m]\nkind = 'clohessy_wiltshire'\nlegs = [{kind = 'hold', duration_s = 1, to_m = [1, 2, 3]}]\n");
  EXPECT_NE(said.find("motion.m.legs[0].to_m: has no effect in a leg of this kind"), std::string::npos) << said;
  const std::string missing = problems("[orbit]\n[motion.m]\nkind = 'clohessy_wiltshire'\nlegs = [{kind = 'transfer', duration_s = 1}]\n");
  EXPECT_NE(missing.find("motion.m.legs[0].to_m: is missing: a leg of this kind needs it"), std::string::npos) << missing;
}

}  // namespace
}  // namespace lasso::mdat
