#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "mdat/scene/ccsds.hpp"
#include "mdat/scene/orbit.hpp"
#include "mdat/scene/tree.hpp"
#include "ut/mdat/scene/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::scene {
namespace {

const std::vector<std::string> kFrames{"EME2000", "RTN"};

std::string oem_header(const std::string& more = "") {
  return "CCSDS_OEM_VERS = 2.0\n"
         "COMMENT written by hand\n"
         "CREATION_DATE = 2026-11-27T00:00:00\n"
         "ORIGINATOR = LASSO\n"
         "META_START\n"
         "OBJECT_NAME = chaser 1\n"
         "OBJECT_ID = 2026-001A\n"
         "CENTER_NAME = EARTH\n"
         "REF_FRAME = EME2000\n"
         "TIME_SYSTEM = UTC\n"
         "START_TIME = 2026-11-27T00:00:00\n"
         "STOP_TIME = 2026-11-27T01:00:00\n" +
         more + "META_STOP\n";
}

std::string oem_refusal(const std::string& text) {
  return problems_of([&] { parse_oem(text, "c.oem", kFrames); });
}

TEST(Oem, ReadsPositionsAndVelocitiesInKilometres) {
  VERIFIES("LASSO-SCN-018~1");
  const Ephemeris oem = parse_oem(oem_header() +
                                      "COMMENT data\n\n"
                                      "2026-11-27T23:59:30.0 7000.5 -1 2 0.1 7.5 -0.2\n"
                                      "2026-11-28T00:00:30.5Z  6999 450 -10 -0.5 7.4 -0.1 0.001 0 0\n"
                                      "COVARIANCE_START\nEPOCH = 2026-11-27T23:59:30\n1\n2 3\nCOVARIANCE_STOP\n",
                                  "c.oem", kFrames);
  EXPECT_EQ(oem.object, "CHASER_1");
  EXPECT_EQ(oem.frame, "EME2000");
  EXPECT_EQ(oem.time_system, "UTC");
  EXPECT_EQ(oem.table.times_s, (std::vector<double>{0, 60.5}));
  EXPECT_EQ(oem.table.positions_m[0], Vec3(7000500, -1000, 2000));
  EXPECT_NEAR((oem.table.velocities_mps[1] - Vec3(-500, 7400, -100)).norm(), 0, 1e-9);
  EXPECT_EQ(oem.table.lines, (std::vector<int>{16, 17}));
  EXPECT_TRUE(oem.table.attitudes.empty());
}

TEST(Oem, InterpolatesAsItSays) {
  VERIFIES("LASSO-SCN-018~1");
  std::string rows;
  for (int i = 0; i < 6; ++i) rows += "2026-001T00:0" + std::to_string(i) + ":00 7000 0 0 0 1 0\n";
  const auto table = [&](const std::string& more) { return parse_oem(oem_header(more) + rows, "c.oem", kFrames).table; };
  EXPECT_EQ(table("").degree, 3);
  EXPECT_EQ(table("").interpolation, Interpolation::kHermite);
  EXPECT_EQ(table("INTERPOLATION = HERMITE\nINTERPOLATION_DEGREE = 7\n").degree, 7);
  EXPECT_EQ(table("INTERPOLATION = lagrange\nINTERPOLATION_DEGREE = 5\n").interpolation, Interpolation::kLagrange);
  EXPECT_EQ(table("INTERPOLATION = LINEAR\n").degree, 1);
  EXPECT_EQ(table("INTERPOLATION = LINEAR\nINTERPOLATION_DEGREE = 1\n").interpolation, Interpolation::kLagrange);
  const auto told = [&](const std::string& more) { return oem_refusal(oem_header(more) + rows); };
  EXPECT_EQ(told("INTERPOLATION = HERMITIAN\n"), "c.oem:13:1: INTERPOLATION: HERMITIAN: expected one of HERMITE, LAGRANGE, LINEAR");
  EXPECT_EQ(told("INTERPOLATION = HERMITE\n"), "c.oem: INTERPOLATION_DEGREE: is missing: expected it beside INTERPOLATION");
  EXPECT_EQ(told("INTERPOLATION = LAGRANGE\nINTERPOLATION_DEGREE = 6\n"),
            "c.oem:14:1: degree: 6: needs 7 rows, and there are 6: lower the degree of interpolation, or add rows");
  EXPECT_EQ(told("INTERPOLATION_DEGREE = 17\n"), "c.oem:13:1: degree: 17: expected a degree of interpolation from 1 to 15");
  EXPECT_EQ(told("INTERPOLATION_DEGREE = 7.5\n"), "c.oem:13:1: INTERPOLATION_DEGREE: 7.5: expected a whole number");
  EXPECT_EQ(told("INTERPOLATION = LINEAR\nINTERPOLATION_DEGREE = 3\n"), "c.oem:14:1: INTERPOLATION_DEGREE: 3: expected 1 beside LINEAR");
}

// A chaser 100 m ahead of its target, each with rows of its own times: both are 7,000 km away, and yet their distance is right.
TEST(Oem, TwoOrbitsGiveTheirRelativeMotion) {
  VERIFIES("LASSO-SCN-018~1");
  const double radius_m = kEarthRadius_m + 400e3, n = Orbit({400e3, 0, 0}).mean_motion_radps();
  const auto at = [&](double angle) {
    const Vec3 outward(std::cos(angle), std::sin(angle), 0), along(-std::sin(angle), std::cos(angle), 0);
    return std::pair<Vec3, Vec3>(radius_m * outward, radius_m * n * along);
  };
  const auto file = [&](double lead_rad, double begin_s, int step_s) {
    std::string text = oem_header("INTERPOLATION = HERMITE\nINTERPOLATION_DEGREE = 7\n");
    for (int i = 0; i < 30; ++i) {
      const double t_s = begin_s + step_s * i;
      const auto [p, v] = at(lead_rad + n * t_s);
      char row[200];
      std::snprintf(row, sizeof row, "2026-331T%02d:%02d:%04.1f %.12f %.12f 0 %.12f %.12f 0\n", static_cast<int>(t_s) / 3600,
                    static_cast<int>(t_s) / 60 % 60, std::fmod(t_s, 60), p.x() / 1e3, p.y() / 1e3, v.x() / 1e3, v.y() / 1e3);
      text += row;
    }
    return parse_oem(text, "c.oem", kFrames);
  };
  const Ephemeris target = file(0, 0, 60);
  Ephemeris chaser = file(100 / radius_m, 12.5, 47);
  for (double& t_s : chaser.table.times_s) t_s += seconds_between(target.first, chaser.first);
  const auto node = [](const std::string& name, MotionTable table) {
    Node result;
    result.name = name;
    result.parent = "earth";
    result.motion = std::make_shared<TableMotion>(std::move(table));
    return result;
  };
  const Tree tree("earth", {node("target", target.table), node("chaser", chaser.table)});
  for (const double t_s : {13.0, 100.25, 777.125, 1300.0}) {
    const MotionState state = tree.state(tree.need("chaser"), tree.need("target"), std::llround(1e6 * t_s));
    const auto [p, v] = at(n * t_s);
    const auto [p_ahead, v_ahead] = at(n * t_s + 100 / radius_m);
    EXPECT_NEAR((state.T_a_b.p - (p_ahead - p)).norm(), 0, 1e-5) << t_s;
    EXPECT_NEAR((state.rates.v_mps - (v_ahead - v)).norm(), 0, 1e-6) << t_s;
  }
}

TEST(Oem, SaysEveryProblemAtOnce) {
  VERIFIES("LASSO-SCN-017~1");
  EXPECT_EQ(oem_refusal("CCSDS_OEM_VERS = 4.0\n"
                        "META_START\n"
                        "OBJECT_NAME = X\n"
                        "OBJECT_NAME = Y\n"
                        "a line of words\n"
                        "REF_FRAME = EME200\n"
                        "TIME_SYSTEM = UT1\n"
                        "META_STOP\n"
                        "2026-11-27T00:00:60 1 2 3 4 5 6\n"
                        "2026-11-27T00:01:00 1 2 3 4 5\n"
                        "2026-11-27T00:02:00 1 2 nan 4 x 6\n"
                        "2026-11-27T00:04:00 7000 0 0 0 1 0\n"
                        "2026-11-27T00:03:00 7000 0 0 0 1 0\n"),
            "c.oem:1:1: CCSDS_OEM_VERS: 4.0: expected one of 1.0, 2.0, 3.0\n"
            "c.oem:4:1: OBJECT_NAME: is written in line 3, too: remove one\n"
            "c.oem:5:1: \"a line of words\": stands before META_STOP: expected KEY = VALUE\n"
            "c.oem:6:1: REF_FRAME: EME200: is no frame that the mission knows: these are EME2000, RTN; did you mean EME2000?\n"
            "c.oem:7:1: TIME_SYSTEM: UT1: expected one of UTC, TAI, TT, GPS\n"
            "c.oem:9:1: \"2026-11-27T00:00:60\": is no epoch: expected such as 2026-11-27T08:15:30.25 or 2026-331T08:15:30.25, and no 60th "
            "second "
            "(use TAI there)\n"
            "c.oem:10:1: has 5 numbers: expected X Y Z X_DOT Y_DOT Z_DOT, in km and km/s, and perhaps accelerations\n"
            "c.oem:11:1: number 3 is \"nan\", expected a finite decimal number such as 1.25\n"
            "c.oem:11:1: number 5 is \"x\", expected a finite decimal number such as 1.25\n"
            "c.oem:13:1: time: -60 s: is not after 0 s of the row before: sort the rows by time, each time once");
}

TEST(Oem, SaysWhatFormItHasNot) {
  VERIFIES("LASSO-SCN-017~1");
  const std::string row = "2026-11-27T00:00:00 7000 0 0 0 1 0\n";
  EXPECT_EQ(oem_refusal("<?xml version=\"1.0\"?>\n<oem>"), "c.oem:1:1: is XML: expected the OEM in key-value notation (KVN)");
  EXPECT_EQ(oem_refusal(oem_header() + row + "META_START\nOBJECT_NAME = X\nMETA_STOP\n" + row),
            "c.oem:15:1: META_START: begins another segment: write each segment to a file of its own");
  EXPECT_EQ(oem_refusal(oem_header()), "c.oem: has no row: expected at least one");
  EXPECT_EQ(oem_refusal(""),
            "c.oem: has no META_STOP: expected a segment of an OEM\nc.oem: CCSDS_OEM_VERS: is missing: expected one of 1.0, 2.0, 3.0\n"
            "c.oem: REF_FRAME: is missing: expected a frame\nc.oem: TIME_SYSTEM: is missing: expected one of UTC, TAI, TT, GPS");
  EXPECT_TRUE(problems_of([] { read_oem("/nowhere.oem", kFrames); }).starts_with("/nowhere.oem: "));
}

// Whatever bytes are changed or cut off, the file is read or refused.
TEST(Oem, NoDamageEndsTheProgram) {
  VERIFIES("LASSO-SCN-017~1");
  std::string good = oem_header("INTERPOLATION = HERMITE\nINTERPOLATION_DEGREE = 3\n");
  for (int i = 0; i < 9; ++i) good += "2026-11-27T00:00:0" + std::to_string(i) + " 7000 1e-3 -2 0 1.5 0\n";
  test::Generator random(101);
  int read = 0, refused = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::string text = good;
    for (std::uint64_t i = random.below(4); i > 0; --i) text[random.below(text.size())] = static_cast<char>(random.below(256));
    if (random.below(4) == 0) text.resize(random.below(text.size()));
    const std::string told = oem_refusal(text);
    (told.empty() ? read : refused) += 1;
  }
  EXPECT_GT(read, 100);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace lasso::mdat::scene
