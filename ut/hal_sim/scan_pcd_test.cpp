#include <gtest/gtest.h>

#include "ut/hal_sim/scan_files.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

using test::expect_refused;
using test::Folder;

// A header of which one line may be replaced (an empty replacement drops it).
std::string header(const std::string& data, const std::string& line = "", const std::string& replacement = "") {
  std::string text =
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH 2\n"
      "HEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA " +
      data + "\n";
  if (!line.empty()) {
    const std::size_t begin = text.find("\n" + line) + 1;
    const std::size_t end = text.find('\n', begin) + 1;
    text.replace(begin, end - begin, replacement);
  }
  return text;
}

void expect_two_points(const RangeImage& image) {
  ASSERT_EQ(image.samples.size(), 2u);
  EXPECT_FALSE(image.misses_known);
  EXPECT_FLOAT_EQ(image.samples[0].range_m, 1.3F);
  EXPECT_FLOAT_EQ(image.samples[0].direction[1], -0.4F / 1.3F);
  EXPECT_FLOAT_EQ(image.samples[1].range_m, 2.5F);
  EXPECT_EQ(image.samples[1].direction[2], 1);
  EXPECT_EQ(image.samples[1].t_us, 0);
}

TEST(ScanPcd, ReadsAscii) {
  VERIFIES("LASSO-SIM-020~2");
  const Folder folder;
  expect_two_points(read_scan_file(folder.write("a.pcd", header("ascii") + "0.3 -0.4 1.2 4294967295\n0 0 2.5 0\n")));
  const std::string other_order = header("ascii", "FIELDS", "FIELDS rgb z y x\n");
  const std::string typed =
      other_order.substr(0, other_order.find("TYPE")) + "TYPE U F F F\n" + other_order.substr(other_order.find("COUNT"));
  expect_two_points(read_scan_file(folder.write("b.pcd", typed + "1 1.2 -0.4 0.3\n1 2.5 0 0\n")));
}

TEST(ScanPcd, ReadsBinary) {
  VERIFIES("LASSO-SIM-020~2");
  const Folder folder;
  const std::string points("\x9A\x99\x99\x3E\xCD\xCC\xCC\xBE\x9A\x99\x99\x3F\xFF\xFF\xFF\xFF\0\0\0\0\0\0\0\0\0\0\x20\x40\xFF\xFF\xFF\xFF",
                           32);
  expect_two_points(read_scan_file(folder.write("a.pcd", header("binary") + points)));
  // A padding field of 3 bytes and a z in double precision.
  const std::string wide =
      "VERSION .7\nFIELDS x _ y z\nSIZE 4 1 4 8\nTYPE F U F F\nCOUNT 1 3 1 1\nWIDTH 1\nHEIGHT 2\nPOINTS 2\nDATA binary\n";
  const std::string data("\x9A\x99\x99\x3Epad\xCD\xCC\xCC\xBE\x33\x33\x33\x33\x33\x33\xF3\x3F\0\0\0\0pad\0\0\0\0\0\0\0\0\0\0\x04\x40", 38);
  expect_two_points(read_scan_file(folder.write("wide.pcd", wide + data)));
}

// The values of a field are beside each other there: 0.3 0, -0.4 0, 1.2 2.5, and eight bytes of colours, which LZF packs.
TEST(ScanPcd, ReadsTheCompressedForm) {
  VERIFIES("LASSO-SIM-020~2");
  const Folder folder;
  const std::string literal("\x17\x9A\x99\x99\x3E\0\0\0\0\xCD\xCC\xCC\xBE\0\0\0\0\x9A\x99\x99\x3F\0\0\x20\x40", 25);
  const std::string colours("\0\xFF\xA0\0", 4);
  const std::string lengths("\x1D\0\0\0\x20\0\0\0", 8);
  expect_two_points(read_scan_file(folder.write("a.pcd", header("binary_compressed") + lengths + literal + colours)));
}

// As organised clouds have them where nothing came back.
TEST(ScanPcd, RowsWithoutAMeasurementAreCounted) {
  VERIFIES("LASSO-SIM-036~1");
  const Folder folder;
  const std::string four = "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 2\nHEIGHT 2\nPOINTS 4\nDATA ascii\n";
  const RawScan scan = read_raw_scan(folder.write("a.pcd", four + "nan nan nan\n\n0 0 0\n0 0 2.5\n1 nan 1\n\n\n"));
  EXPECT_EQ(scan.unmeasured, 3u);
  ASSERT_EQ(scan.rays.size(), 1u);
  EXPECT_EQ(scan.rays[0].place, Vec3(0, 0, 2.5));
}

// The sensor stands at (1, 2, 3), a quarter turn about z: its x is the file's y.
TEST(ScanPcd, TakesPointsToTheSensorThatStoodAtTheViewpoint) {
  VERIFIES("LASSO-SIM-037~1");
  const Folder folder;
  const std::string turned = header("ascii", "VIEWPOINT", "VIEWPOINT 1 2 3 -0.70710678118654752 0 0 -0.70710678118654752\n");
  expect_two_points(read_scan_file(folder.write("a.pcd", turned + "1.4 2.3 4.2 0\n1 2 5.5 0\n")));
  const std::string same = header("ascii", "VIEWPOINT", "VIEWPOINT 0 0 0 -1 0 0 0\n");
  expect_two_points(read_scan_file(folder.write("b.pcd", same + "0.3 -0.4 1.2 0\n0 0 2.5 0\n")));
}

TEST(ScanPcd, EachErrorNamesItsPlaceAndItsRemedy) {
  VERIFIES("LASSO-SIM-021~1");
  const std::string points = "1 2 3 4\n1 2 3 4\n";
  expect_refused("a.pcd", "", ":1: ", "not a PCD file");
  expect_refused("a.pcd", "hello world\n", ":1: header entry \"hello\"", "not a PCD file");
  expect_refused("a.pcd", "VERSION 0.7\nFIELDS x y z\n", ":2: ", "truncated");
  expect_refused("a.pcd", header("binary_compressed"), ": the file is truncated: ", "compressed data");
  expect_refused("a.pcd", header("zip"), ":11: DATA is \"zip\"", "ascii, binary or binary_compressed");
  expect_refused("a.pcd", header("ascii", "SIZE") + points, ":10: ", "lacks");
  expect_refused("a.pcd", header("ascii", "FIELDS") + points, ":3: SIZE before FIELDS", "");
  expect_refused("a.pcd", header("ascii", "SIZE", "SIZE 4 4 4\n"), ":4: SIZE has 3 values", "4 FIELDS");
  expect_refused("a.pcd", header("ascii", "SIZE", "SIZE 4 4 3 4\n"), ":4: SIZE is \"3\"", "1, 2, 4 or 8");
  expect_refused("a.pcd", header("ascii", "SIZE", "SIZE 4 4 2 4\n"), ":11: field \"z\"", "TYPE F");
  expect_refused("a.pcd", header("ascii", "TYPE", "TYPE F X F U\n"), ":11: field \"y\"", "TYPE F");
  expect_refused("a.pcd", header("ascii", "COUNT", "COUNT 2 1 1 1\n"), ":11: field \"x\"", "COUNT 1");
  expect_refused("a.pcd", header("ascii", "COUNT", "COUNT 1 1 1 99999999999\n"), ":6: COUNT is \"99999999999\"", "at most 4096");
  expect_refused("a.pcd", header("ascii", "FIELDS", "FIELDS x y w rgb\n"), ":11: FIELDS has no \"z\"", "expected x y z");
  expect_refused("a.pcd", header("ascii", "FIELDS", "FIELDS x y z x\n"), ":11: field \"x\"", "");
  expect_refused("a.pcd", header("ascii", "COUNT", "FIELDS w\n"), ":6: FIELDS is declared twice", "");
  expect_refused("a.pcd", header("ascii", "VIEWPOINT", "VIEWPOINT 0 0 1 2 0 0 0\n"), ":9: VIEWPOINT has a quaternion", "length 2");
  expect_refused("a.pcd", header("ascii", "POINTS", "POINTS 0\n"), ":10: the file declares no point", "at least one");
  expect_refused("a.pcd", header("ascii", "POINTS", "POINTS 5000000000\n"), ":10: the file declares 5000000000 points", "at most 1e9");
  expect_refused("a.pcd", header("ascii", "POINTS", "POINTS x\n"), ":10: POINTS is \"x\"", "whole number");
  expect_refused("a.pcd", header("ascii", "POINTS", "POINTS 3\n"), ":11: POINTS is 3", "WIDTH times HEIGHT");
  expect_refused("a.pcd", header("ascii", "HEIGHT", "HEIGHT 0\n"), ":11: POINTS is 2", "WIDTH times HEIGHT");
  expect_refused("a.pcd", header("ascii", "WIDTH", "WIDTH\n"), ":7: WIDTH has 0 values", "expected 1");
  expect_refused("a.pcd", header("ascii") + "1 2 3 4\n", ":12: the file ends after 1 of 2 points", "");
  expect_refused("a.pcd", header("ascii") + "1 2 3\n", ":12: the point has 3 values", "expected 4");
  expect_refused("a.pcd", header("ascii", "VIEWPOINT", "VIEWPOINT 0 0 1\n"), ":9: VIEWPOINT has 3 values", "tx ty tz qw qx qy qz");
  const std::string lengths("\x02\0\0\0\x20\0\0\0", 8);
  expect_refused("a.pcd", header("binary_compressed") + lengths + "a", ": the file is truncated: 1 of 2 bytes", "");
  expect_refused("a.pcd", header("binary_compressed") + lengths + "\xE0\x01", ": the compressed data cannot be unpacked", "anew");
  expect_refused("a.pcd", header("binary") + "abc", ": the file is truncated: 3 bytes", "need 32");
}

}  // namespace
}  // namespace lasso::sim
