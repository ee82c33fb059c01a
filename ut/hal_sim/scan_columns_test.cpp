#include "hal_sim/scan_columns.hpp"

#include <gtest/gtest.h>

#include "ut/hal_sim/scan_files.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

using test::expect_refused;
using test::Folder;

std::vector<std::string> warnings_of(const std::string& text) {
  const Folder folder;
  std::vector<std::string> lines;
  for (const ScanWarning& warning : read_raw_scan(folder.write("a.csv", text)).warnings)
    lines.push_back(warning.place.substr(folder.path().string().size() + 1) + ": " + warning.text);
  return lines;
}

// A ray that missed, by a name that is not read: its direction would be a return at 1 m.
TEST(ScanColumns, AColumnThatMayTellMissesFromReturnsIsRefused) {
  VERIFIES("LASSO-SIM-071~2");
  expect_refused("a.csv", "t_s,x_m,y_m,z_m,ok\n0,0,0,4,1\n0,0.6,0,0.8,0\n0,0,0,4,1\n",
                 ":1:17: column \"ok\" is not known, and tells rows in two kinds, \"1\" and \"0\"", "name it valid (1 a return; 0 a ray");
  expect_refused("a.csv", "# made elsewhere\n# x ; hit; y;z\n0;yes;0;4\n0;no;0;1\n", ":2:7: column \"hit\" is not known", "remove it");
  expect_refused("a.csv", "x,y,z,intensity,state\n0,0,4,7,0\n0,0,1,9,1\n", ":1:17: column \"state\"",
                 "known are t_s, t_ms, t_us, t_ns or t;");
}

// Whatever its name: directions, greatest ranges, and directions beside a target that is about as far away as they are long.
TEST(ScanColumns, TwoValuesWhosePointsLieApartAreRefused) {
  VERIFIES("LASSO-SIM-071~2");
  expect_refused("a.csv", "x,y,z,kind\n0,0,4,bus\n0,0.1,1,none\n0,0,5,bus\n0,0.4,1,none\n", ":1:7: column \"kind\"", "remove it");
  expect_refused("a.csv", "x,y,z,kind\n0,0,4,bus\n0,0,100,none\n0,0,5,bus\n", ":1:7: column \"kind\"", "remove it");
  expect_refused("a.csv", "x,y,z,kind\n0,0,0.9,bus\n0.61,0,0.8,none\n0,0,1.2,bus\n0,0.6,0.79,none\n", ":1:7: column \"kind\"", "remove it");
}

// As labels and other flags have them. Under a name for returns they are refused all the same.
TEST(ScanColumns, TwoValuesWhosePointsMixAreToldAlone) {
  VERIFIES("LASSO-SIM-071~2 LASSO-MDT-124~1");
  for (const char* name : {"label", "is_panel", "return"}) {
    const std::vector<std::string> told = warnings_of(std::string("x,y,z,") + name + "\n0,0,4,0\n0,0,5,1\n0,0,6,0\n0,0,5.5,1\n");
    ASSERT_EQ(told.size(), 1U) << name;
    EXPECT_EQ(told[0].find(std::string("a.csv:1:7: not known, and not read: column \"") + name), 0U) << told[0];
  }
  for (const char* name : {"ok", "Is Valid", "hit"})
    expect_refused("a.csv", std::string("x,y,z,") + name + "\n0,0,4,0\n0,0,5,1\n0,0,6,0\n0,0,5.5,1\n", ":1:7: column", "name it valid");
}

TEST(ScanColumns, ASecondColumnOfANameThatIsReadIsRefused) {
  VERIFIES("LASSO-SIM-021~1");
  expect_refused("a.csv", "x,y,z,valid,Valid\n0,0,4,1,1\n", ":1:13: a second column \"valid\"", "remove one of them");
  expect_refused("a.csv", "x,y,z,X\n0,0,4,1\n", ":1:7: a second column \"x\"", "name it otherwise");
  EXPECT_TRUE(warnings_of("x_m,y_m,z_m,x,y,z\n0,0,4,1,1,1\n").empty());
}

TEST(ScanColumns, AColumnOfOneValueOrManyIsToldAlone) {
  VERIFIES("LASSO-SIM-071~2 LASSO-MDT-124~1");
  for (const char* rows : {"0,0,4,1\n0,0,5,1\n", "0,0,4,1\n0,0,5,2\n0,0,6,3\n", "0,0,4,1\nnan,nan,nan,0\n0,0,0,0\n0,0,5,1\n"}) {
    const std::vector<std::string> told = warnings_of(std::string("x,y,z,ok\n") + rows);
    ASSERT_EQ(told.size(), 1U) << rows;
    EXPECT_EQ(told[0],
              "a.csv:1:7: not known, and not read: column \"ok\"; rename what is one of those that are known: t_s, t_ms, t_us, t_ns or t; "
              "x_m or x; y_m or y; z_m or z; valid; of others none is read");
  }
  const std::vector<std::string> told = warnings_of("x,y,z,valid,ok,c2,c3,c4,c5,c6,c7\n0,0,4,1,1,0,0,0,0,0,0\n0,0,1,0,0,0,0,0,0,0,0\n");
  ASSERT_EQ(told.size(), 1U) << "returns are known by their column";
  EXPECT_NE(told[0].find(":1:13: not known, and not read: column \"ok\", \"c2\", \"c3\", \"c4\", \"c5\" and 2 more;"), std::string::npos)
      << told[0];
}

TEST(ScanColumns, WhatOthersWriteBesideCoordinatesIsTakenWithoutAWord) {
  VERIFIES("LASSO-MDT-124~1");
  EXPECT_TRUE(warnings_of("x,y,z,Intensity,reflectivity,ring,r,g,b\n0,0,4,1,0,0,255,0,0\n0,0,5,0,1,1,0,255,0\n").empty());
  for (const char* header : {"X,Y,Z,Intensity,ReturnNumber,NumberOfReturns,ScanDirectionFlag,EdgeOfFlightLine,Classification,PointSourceId",
                             "x,y,z,Target Index,target_count,scan-angle,Reflectance,Deviation,ClassID,tag",
                             "X,Y,Z,laser_id,azimuth,vertical_angle,dual_distance,Range (mm),Near IR,Original_cloud_index"}) {
    const std::string one = ",1,1,1,1,1,1,1\n", other = ",2,2,2,2,2,2,2\n";
    EXPECT_TRUE(warnings_of(header + ("\n0,0,4" + one) + "0,0,5" + other).empty()) << header;
  }
  EXPECT_TRUE(warnings_of("t_s,x_m,y_m,z_m,valid\n0,0,0,4,1\n0,0,0,1,0\n").empty());
  EXPECT_TRUE(warnings_of("t_us,x,y,z,timestamp\n0,0,0,4,1\n0,0,0,4,2\n").empty()) << "times are known";
}

TEST(ScanColumns, TimesOfAnotherNameAreTold) {
  VERIFIES("LASSO-MDT-124~1");
  const std::vector<std::string> told = warnings_of("time,x,y,z\n0,0,0,4\n0.1,0,0,4\n");
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].find("a.csv:1:1: column \"time\" is not read, and all rays are taken at one time; "), 0U) << told[0];
  EXPECT_NE(told[0].find("name it t_s, t_ms, t_us or t_ns"), std::string::npos) << told[0];
  for (const char* name : {"GpsTime", "Time [s]", "TIMESTAMP (ns)", "adjustedtime", "sec"}) {
    const std::vector<std::string> of_others = warnings_of(std::string("x,y,z,") + name + "\n0,0,4,7\n0,0,5,8\n");
    ASSERT_EQ(of_others.size(), 1U) << name;
    EXPECT_NE(of_others[0].find(" is not read, and all rays are taken at one time"), std::string::npos) << of_others[0];
  }
}

// `directions` rows (0.6, 0, 0.8) among returns 4 m away.
std::string table_of(int returns, int directions, const char* header, const char* end) {
  std::string text = header;
  for (int i = 0; i < returns; ++i) text += std::string("0,0,4") + end;
  for (int i = 0; i < directions; ++i) text += std::string("0.6,0,0.80004") + end;
  return text;
}

TEST(ScanColumns, ManyPointsOfUnitLengthAreRefusedWhereReturnsAreNotNamed) {
  VERIFIES("LASSO-SIM-071~2");
  expect_refused("a.csv", table_of(144, 16, "x,y,z\n", "\n"), ":146: 16 of 160 points, this one first, have the length 1",
                 "add a column valid");
  expect_refused("a.csv", table_of(0, 16, "x,y,z\n", "\n"), ":2: 16 of 16 points", "add a column valid");
  const Folder folder;
  EXPECT_EQ(read_raw_scan(folder.write("few.csv", table_of(0, 15, "x,y,z\n", "\n"))).rays.size(), 15U);
  EXPECT_EQ(read_raw_scan(folder.write("part.csv", table_of(145, 16, "x,y,z\n", "\n"))).rays.size(), 161U);
  folder.write("said.csv", table_of(144, 16, "x,y,z,valid\n", ",1\n"));
  EXPECT_EQ(RecordedScans(folder.path()).survey().back().directions, 16U) << "returns by their column";
}

}  // namespace
}  // namespace lasso::sim
