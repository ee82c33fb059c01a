#include "mdat/scene/motion_csv.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "ut/mdat/scene/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::scene {
namespace {

std::string csv_refusal(const std::string& text) {
  return problems_of([&] { parse_motion_csv(text, "m.csv"); });
}

TEST(MotionCsv, ReadsWhatItsHeaderNames) {
  VERIFIES("LASSO-SCN-016~1");
  const MotionTable table = parse_motion_csv(
      "# of a simulator\n"
      "qw,TIME_S, x_m ,y_m,z_m,qx,qy,qz,vx_mps,vy_mps,vz_mps,wx_radps,wy_radps,wz_radps,mode\n"
      "0.5,-1.5,1,2,3,0.5,-0.5,0.5,4,5,6,0.07,0.08,0.09,far\n"
      "\n"
      "1,0.5,10,20,30,0,0,0,40,50,60,0.7,0.8,0.9,near\n",
      "m.csv");
  EXPECT_EQ(table.times_s, (std::vector<double>{-1.5, 0.5}));
  EXPECT_EQ(table.lines, (std::vector<int>{3, 5}));
  EXPECT_EQ(table.positions_m[1], Vec3(10, 20, 30));
  EXPECT_EQ(table.velocities_mps[0], Vec3(4, 5, 6));
  EXPECT_EQ(table.attitudes[0].coeffs(), Quat(0.5, 0.5, -0.5, 0.5).coeffs());
  EXPECT_EQ(table.omegas_radps[0], Vec3(0.07, 0.08, 0.09));
  const TableMotion motion(table);
  EXPECT_EQ(motion.at(500'000).T_a_b.p, Vec3(10, 20, 30));
}

TEST(MotionCsv, TakesPositionsOrAttitudesAlone) {
  VERIFIES("LASSO-SCN-016~1");
  const MotionTable positions = parse_motion_csv("time_s;x_m;y_m;z_m\n0;1,5;2;3\n", "m.csv");
  EXPECT_EQ(positions.positions_m[0], Vec3(1.5, 2, 3)) << "decimal commas";
  EXPECT_TRUE(positions.attitudes.empty() && positions.velocities_mps.empty() && positions.omegas_radps.empty());
  const MotionTable attitudes = parse_motion_csv("time_s,qx,qy,qz,qw\n0,0,0,1,0\n", "m.csv");
  EXPECT_TRUE(attitudes.positions_m.empty());
}

TEST(MotionCsv, SaysWhichColumnsAreMissingOrOfAnotherUnit) {
  VERIFIES("LASSO-SCN-017~1");
  const std::string header = "is missing: expected a header such as time_s,x_m,y_m,z_m,qx,qy,qz,qw";
  const auto meant = [](const std::string& name, const std::string& known) {
    return "m.csv:2:1: " + name + ": is no column of a motion; did you mean " + known + "? Units are s, m, m/s and rad/s\n";
  };
  EXPECT_EQ(csv_refusal("# flown in March\ntime_ms,x_km,y_m,z_m,wx_degps,q_x\n"),
            meant("q_x", "qx") + meant("time_ms", "time_s") + "m.csv:2:1: time_s: " + header + "\n" + meant("wx_degps", "wx_radps") +
                meant("x_km", "x_m") + "m.csv:2:1: x_m: " + header);
  EXPECT_EQ(csv_refusal("time_s,wy_radps,qx,qy,qz,x_m,y_m,z_m,range_m\n"),
            "m.csv:1:1: qw: " + header + "\nm.csv:1:1: wx_radps: " + header + "\nm.csv:1:1: wz_radps: " + header);
  EXPECT_EQ(csv_refusal("time_s,range_m\n1,2\n"), "m.csv:1:1: has neither positions (x_m, y_m, z_m) nor attitudes (qx, qy, qz, qw)");
  EXPECT_EQ(csv_refusal(""), "m.csv:1:1: the file is empty, expected the header \"time_s,x_m,y_m,z_m,qx,qy,qz,qw\"");
}

TEST(MotionCsv, SaysEveryProblemOfItsRows) {
  VERIFIES("LASSO-SCN-017~1");
  EXPECT_EQ(csv_refusal("time_s,x_m,y_m,z_m,qx,qy,qz,qw\n"
                        "0,1,2,3,0,0,0,1\n"
                        "1,abc,nan,3,0,0,0,1\n"
                        "2,1,2\n"
                        "5,1,2,3,0,0,0,2\n"
                        "4,1,2,3,0,0,0,1\n"),
            "m.csv:3:3: x_m is \"abc\", expected a finite decimal number such as 1.25\n"
            "m.csv:3:7: y_m is \"nan\", expected a finite decimal number such as 1.25\n"
            "m.csv:4:1: the row has 3 fields, expected 8 as the header; the row is \"2,1,2\"\n"
            "m.csv:5:1: quaternion: length 2: expected a quaternion of unit length, the scalar last\n"
            "m.csv:6:1: time: 4 s: is not after 5 s of the row before: sort the rows by time, each time once");
  EXPECT_EQ(csv_refusal("time_s,x_m,y_m,z_m\n"), "m.csv: has no row: expected at least one");
}

TEST(MotionCsv, TellsTheFirstFiftyProblems) {
  VERIFIES("LASSO-SCN-017~1");
  std::string text = "time_s,x_m,y_m,z_m\n";
  for (int i = 0; i < 200; ++i) text += "1,x,2,3\n";
  const std::string told = csv_refusal(text);
  EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 50);
  EXPECT_TRUE(told.starts_with("m.csv: 151 more problems\n")) << told.substr(0, 100);
}

TEST(MotionCsv, AFileThatIsNotThereIsSaid) {
  VERIFIES("LASSO-SCN-017~1");
  const std::string told = problems_of([] { read_motion_csv("/nowhere/at all.csv"); });
  EXPECT_TRUE(told.starts_with("/nowhere/at all.csv: ")) << told;
}

}  // namespace
}  // namespace lasso::mdat::scene
