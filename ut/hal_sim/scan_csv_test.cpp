#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "fsw/geometry/types.hpp"
#include "hal_sim/scan_file.hpp"
#include "ut/hal_sim/scan_files.hpp"
#include "ut/hal_sim/shapes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

using test::expect_refused;
using test::Folder;

const std::string kHeader = "t_s,x_m,y_m,z_m,valid\n";

TEST(ScanCsv, ReadsHitsAndMissesWithTheirTimes) {
  VERIFIES("LASSO-SIM-019~2");
  const Folder folder;
  const auto file = folder.write("a.csv", kHeader + "-0.5,0.3,-0.4,1.2,1\n0.0,0.6,0,0.8,0\n 0.0 , +3e-1,-.4, 1.2 ,1\n12.3456789,0,0,2,1\n");
  const RangeImage image = read_scan_file(file);
  ASSERT_EQ(image.samples.size(), 4u);
  EXPECT_TRUE(image.misses_known);
  EXPECT_EQ(image.samples[0].state, RayState::kHit);
  EXPECT_EQ(image.samples[0].t_us, -500000);
  EXPECT_FLOAT_EQ(image.samples[0].range_m, 1.3F);
  EXPECT_FLOAT_EQ(image.samples[0].direction[0], 0.3F / 1.3F);
  EXPECT_FLOAT_EQ(image.samples[0].direction[1], -0.4F / 1.3F);
  EXPECT_FLOAT_EQ(image.samples[0].direction[2], 1.2F / 1.3F);
  EXPECT_EQ(image.samples[1].state, RayState::kMiss);
  EXPECT_EQ(image.samples[1].range_m, 0);
  EXPECT_FLOAT_EQ(image.samples[1].direction[0], 0.6F);
  EXPECT_FLOAT_EQ(image.samples[2].range_m, 1.3F);
  EXPECT_EQ(image.samples[3].t_us, 12345679);
  EXPECT_EQ(image.reference_time_us(), -500000 + (12345679 + 500000) / 2);
}

TEST(ScanCsv, ReadsWhatSpreadsheetsWrite) {
  VERIFIES("LASSO-SIM-019~2");
  const Folder folder;
  const auto file = folder.write("a.csv", "\xEF\xBB\xBFt_s,x_m,y_m,z_m,valid\r\n0,0,0,1,1\r\n0,0,0,2,1\r\n\r\n");
  EXPECT_EQ(read_scan_file(file).samples.size(), 2u);
  EXPECT_EQ(read_scan_file(folder.write("c.csv", kHeader + "\n0,0,0,1,1\n\n0,0,0,2,1\n\n\n,,,,\n")).samples.size(), 2u);
  EXPECT_EQ(read_scan_file(folder.write("b.CSV", kHeader + "0,0,0,1,1")).samples.size(), 1u);  // no line end at the end
}

TEST(ScanCsv, TakesColumnsInAnyOrderAndDoesWithoutTimesOrMisses) {
  VERIFIES("LASSO-SIM-019~2");
  const Folder folder;
  const RangeImage image =
      read_scan_file(folder.write("a.csv", "# valid;z_m;intensity;y_m;x_m;t_ms\n\n0;0,8;7;0;0,6;1000\n1;1,2;9;-0,4;0,3;1000,5\n"));
  ASSERT_EQ(image.samples.size(), 2u);
  EXPECT_TRUE(image.misses_known);
  EXPECT_EQ(image.samples[0].state, RayState::kMiss);
  EXPECT_FLOAT_EQ(image.samples[0].direction[0], 0.6F);
  EXPECT_EQ(image.samples[0].t_us, 1000000) << "milliseconds by the column's name";
  EXPECT_EQ(image.samples[1].t_us, 1000500);
  EXPECT_FLOAT_EQ(image.samples[1].range_m, 1.3F);
  EXPECT_FLOAT_EQ(image.samples[1].direction[1], -0.4F / 1.3F);
  const RangeImage cloud = read_scan_file(folder.write("b.csv", "x,y,z\n0.3,-0.4,1.2\n"));
  EXPECT_FALSE(cloud.misses_known);
  EXPECT_FLOAT_EQ(cloud.samples[0].range_m, 1.3F);
}

TEST(ScanCsv, RowsWithoutAMeasurementAreCountedAndAreNoMisses) {
  VERIFIES("LASSO-SIM-036~1");
  const Folder folder;
  const auto file = folder.write("a.csv", kHeader +
                                              "1,nan,NaN,nan,0\n2,0,0,0,0\n3,0,0,1,0\n4,,,,1\n5,inf,-inf,inf,1\n6,0,0,0,1\n7,0,0,2,1\n8,-"
                                              "NaN,nan(ind),N/A,0\n9,0,nan,1,1\n9,0,0,-inf,0\n");
  const RawScan scan = read_raw_scan(file);
  EXPECT_EQ(scan.unmeasured, 8u);
  ASSERT_EQ(scan.rays.size(), 2u);
  EXPECT_FALSE(scan.rays[0].hit);
  EXPECT_TRUE(scan.rays[1].hit);
  const RangeImage image = read_scan_file(file);
  ASSERT_EQ(image.samples.size(), 2u);
  EXPECT_EQ(image.samples[0].t_us, 3000000);
}

TEST(ScanCsv, AScanWithoutAnyMeasurementSaysNothingAtItsTime) {
  VERIFIES("LASSO-SIM-036~1");
  const Folder folder;
  const RangeImage image = read_scan_file(folder.write("a.csv", kHeader + "5,nan,nan,nan,0\n6,0,0,0,0\n"));
  ASSERT_EQ(image.samples.size(), 1u);
  EXPECT_EQ(image.samples[0].state, RayState::kInvalid);
  EXPECT_EQ(image.reference_time_us(), 5000000);
}

TEST(ScanCsv, ValidIsWrittenAsOtherProgramsDo) {
  VERIFIES("LASSO-SIM-036~1");
  const Folder folder;
  const RawScan scan = read_raw_scan(folder.write("a.csv", kHeader + "1,0,0,2,1.0\n2,0,0,1,0.0\n3,0,0,2,True\n4,0,0,1,False\n"));
  ASSERT_EQ(scan.rays.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(scan.rays[i].hit, i % 2 == 0) << i;
}

TEST(ScanCsv, EachErrorNamesItsPlaceAndItsRemedy) {
  VERIFIES("LASSO-SIM-021~1");
  const std::string good = "0.1,0,0,1,1\n";
  expect_refused("a.csv", "", ":1:1: ", "expected the header");
  expect_refused("a.csv", kHeader, ":1: ", "at least one");
  expect_refused("a.csv", kHeader + "\n", ":2: ", "at least one");
  expect_refused("a.csv", "t,x,y,w,valid\n" + good, ":1:1: the header is \"t,x,y,w,valid\"", "expected \"t_s,x_m,y_m,z_m,valid\"");
  expect_refused("a.csv", kHeader + good + "0.1,0,0,1\n", ":3: the row has 4 fields", "expected 5");
  expect_refused("a.csv", kHeader + good + "0.1,0,0,1,1,7\n", ":3: the row has 6 fields", "expected 5");
  expect_refused("a.csv", kHeader + "0.1,abc,0,1,1\n", ":2:5: x_m is \"abc\"", "decimal number");
  expect_refused("a.csv", kHeader + "0.1,0,1.5x,1,1\n", ":2:7: y_m is \"1.5x\"", "decimal number");
  expect_refused("a.csv", kHeader + "0.1,0,0,,1\n", ":2:9: z_m is \"\"", "decimal number");
  expect_refused("a.csv", kHeader + "0.1,0,0,+-1,1\n", ":2:9: z_m is \"+-1\"", "decimal number");
  expect_refused("a.csv", kHeader + "0.1,0,nan,a,1\n", ":2:11: z_m is \"a\"", "finite");
  expect_refused("a.csv", kHeader + "0.1,0,0,1e999,1\n", ":2:9: z_m is \"1e999\"", "finite");
  expect_refused("a.csv", kHeader + "nan,0,0,1,1\n", ":2:1: t_s is \"nan\"", "finite");
  expect_refused("a.csv", kHeader + "1e12,0,0,1,1\n", ":2: the time is 1e+12 s", "seconds");
  expect_refused("a.csv", kHeader + good + "0.09,0,0,1,1\n", ":3:1: t_s is \"0.09\"", "sort the rows");
  expect_refused("a.csv", kHeader + "0.1,0,0,1,2\n", ":2:11: valid is \"2\"", "1 (yes; a hit) or 0 (no; a miss)");
  expect_refused("a.csv", kHeader + "0.1,0,0,1.01,0\n", ":2: the direction of a ray that missed (valid 0) has length 1.01", "divide");
  expect_refused("a.csv", kHeader + "0.1,0,0,4e6,1\n", ":2: the point is 4e+06 m away", "metres");
  expect_refused("a.csv", kHeader + "0.1,0,0,1e300,1\n", ":2: the point is 1e+300 m away", "metres");
  expect_refused("a.csv", kHeader + std::string("0.1,0,0,\x01\xFF\0,1\n", 14), ":2:9: z_m is \"???\"", "decimal number");
  expect_refused("a.csv", std::string(1000, 'x'), ":1:1: the header is \"" + std::string(40, 'x') + "...\"", "expected");
}

TEST(ScanCsv, TheLinesOfFurtherErrorsAreNamed) {
  VERIFIES("LASSO-SIM-021~1");
  const std::string good = "0.1,0,0,1,1\n", bad = "0.1,0,abc,1,1\n";
  expect_refused("a.csv", kHeader + bad + good + "0.1,0,0,1\n", ":2:7: y_m is \"abc\"", "such as 1.25; further bad lines: 4");
  expect_refused("a.csv", kHeader + good + bad + bad + bad + bad + bad, ":3:7: y_m", "; further bad lines: 4, 5, 6, 7");
  std::string rows;
  for (std::size_t i = 0; i < 2 * kMaxRays; ++i) rows += bad;
  expect_refused("a.csv", kHeader + rows, ":2:7: y_m", "; further bad lines: 3, 4, 5, 6 and 8187 more");
}

RangeImage random_image() {
  RangeImage image;
  test::Generator generator(8);
  TimeUs t_us = -123456789;
  for (int i = 0; i < 500; ++i) {
    RangeSample sample;
    const Vec3 direction = test::random_unit(generator);
    for (int axis = 0; axis < 3; ++axis) sample.direction[axis] = static_cast<float>(direction[axis]);
    sample.state = i % 7 == 3 ? RayState::kInvalid : i % 3 == 0 ? RayState::kMiss : RayState::kHit;
    sample.range_m = sample.state == RayState::kHit ? static_cast<float>(generator.uniform(0.5, 20)) : 0;
    sample.t_us = t_us;
    t_us += static_cast<TimeUs>(generator.below(400000) * (i % 5 == 0 ? 0 : 1) + (i > 250 ? 30 : 0));
    if (!image.samples.push_back(sample)) ADD_FAILURE();
  }
  return image;
}

TEST(ScanCsv, WhatIsWrittenReadsBackTheSame) {
  VERIFIES("LASSO-SIM-022~1");
  const Folder folder;
  const RangeImage image = random_image();
  write_scan_csv(folder.path() / "scan.csv", image);
  const RangeImage back = read_scan_file(folder.path() / "scan.csv");
  std::size_t k = 0;
  for (const RangeSample& sample : image.samples) {
    if (sample.state == RayState::kInvalid) continue;
    ASSERT_LT(k, back.samples.size());
    const RangeSample& read = back.samples[k++];
    ASSERT_EQ(read.t_us, sample.t_us);
    ASSERT_EQ(read.state, sample.state);
    ASSERT_EQ(read.range_m, sample.range_m);
    for (int axis = 0; axis < 3; ++axis) ASSERT_NEAR(read.direction[axis], sample.direction[axis], 1.2e-7);
  }
  EXPECT_EQ(k, back.samples.size());
}

TEST(ScanCsv, AFailedWriteLeavesNothingBehind) {
  VERIFIES("LASSO-SIM-023~1");
  const Folder folder;
  EXPECT_THROW(write_scan_csv(folder.path() / "missing" / "scan.csv", random_image()), ScanFileError);
  EXPECT_THROW(write_scan_csv(folder.path() / "scan.csv", RangeImage{}), ScanFileError);
  std::filesystem::create_directories(folder.path() / "taken.csv" / "inside");
  EXPECT_THROW(write_scan_csv(folder.path() / "taken.csv", random_image()), ScanFileError);
  std::size_t entries = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) ++entries;
  EXPECT_EQ(entries, 1u);
}

}  // namespace
}  // namespace lasso::sim
