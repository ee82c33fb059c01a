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
  VERIFIES("LASSO-SIM-020~1");
  const Folder folder;
  expect_two_points(read_scan_file(folder.write("a.pcd", header("ascii") + "0.3 -0.4 1.2 4294967295\n0 0 2.5 0\n")));
  const std::string other_order = header("ascii", "FIELDS", "FIELDS rgb z y x\n");
  const std::string typed =
      other_order.substr(0, other_order.find("TYPE")) + "TYPE U F F F\n" + other_order.substr(other_order.find("COUNT"));
  expect_two_points(read_scan_file(folder.write("b.pcd", typed + "1 1.2 -0.4 0.3\n1 2.5 0 0\n")));
}

TEST(ScanPcd, ReadsBinary) {
  VERIFIES("LASSO-SIM-020~1");
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

TEST(ScanPcd, EachErrorNamesItsPlaceAndItsRemedy) {
  VERIFIES("LASSO-SIM-021~1");
  const std::string points = "1 2 3 4\n1 2 3 4\n";
  expect_refused("a.pcd", "", ":1: ", "not a PCD file");
  expect_refused("a.pcd", "hello world\n", ":1: header entry \"hello\"", "not a PCD file");
  expect_refused("a.pcd", "VERSION 0.7\nFIELDS x y z\n", ":2: ", "truncated");
  expect_refused("a.pcd", header("binary_compressed"), ":11: DATA binary_compressed is not read", "convert");
  expect_refused("a.pcd", header("zip"), ":11: DATA is \"zip\"", "ascii or binary");
  expect_refused("a.pcd", header("ascii", "SIZE") + points, ":10: ", "lacks");
  expect_refused("a.pcd", header("ascii", "FIELDS") + points, ":3: SIZE before FIELDS", "");
  expect_refused("a.pcd", header("ascii", "SIZE", "SIZE 4 4 4\n"), ":4: SIZE has 3 values", "4 FIELDS");
  expect_refused("a.pcd", header("ascii", "SIZE", "SIZE 4 4 3 4\n"), ":4: SIZE is \"3\"", "1, 2, 4 or 8");
  expect_refused("a.pcd", header("ascii", "SIZE", "SIZE 4 4 2 4\n"), ":11: field \"z\"", "TYPE F");
  expect_refused("a.pcd", header("ascii", "TYPE", "TYPE F I F U\n"), ":11: field \"y\"", "TYPE F");
  expect_refused("a.pcd", header("ascii", "COUNT", "COUNT 2 1 1 1\n"), ":11: field \"x\"", "COUNT 1");
  expect_refused("a.pcd", header("ascii", "COUNT", "COUNT 1 1 1 99999999999\n"), ":6: COUNT is \"99999999999\"", "at most 4096");
  expect_refused("a.pcd", header("ascii", "FIELDS", "FIELDS x y w rgb\n"), ":11: FIELDS has no \"z\"", "expected x y z");
  expect_refused("a.pcd", header("ascii", "FIELDS", "FIELDS x y z x\n"), ":11: field \"x\"", "");
  expect_refused("a.pcd", header("ascii", "COUNT", "FIELDS w\n"), ":6: FIELDS is declared twice", "");
  expect_refused("a.pcd", header("ascii", "VIEWPOINT", "VIEWPOINT 0 0 1 1 0 0 0\n"), ":9: ", "sensor's frame");
  expect_refused("a.pcd", header("ascii", "POINTS", "POINTS 0\n"), ":10: the file declares no point", "at least one");
  expect_refused("a.pcd", header("ascii", "POINTS", "POINTS 5000\n"), ":10: the file declares 5000 points", "thin it out");
  expect_refused("a.pcd", header("ascii", "POINTS", "POINTS x\n"), ":10: POINTS is \"x\"", "whole number");
  expect_refused("a.pcd", header("ascii", "POINTS", "POINTS 3\n"), ":11: POINTS is 3", "WIDTH times HEIGHT");
  expect_refused("a.pcd", header("ascii", "HEIGHT", "HEIGHT 0\n"), ":11: POINTS is 2", "WIDTH times HEIGHT");
  expect_refused("a.pcd", header("ascii", "WIDTH", "WIDTH\n"), ":7: WIDTH has 0 values", "expected 1");
  expect_refused("a.pcd", header("ascii") + "1 2 3 4\n", ":12: the file ends after 1 of 2 points", "");
  expect_refused("a.pcd", header("ascii") + "1 2 3\n", ":12: the point has 3 values", "expected 4");
  expect_refused("a.pcd", header("ascii") + "1 nan 3 4\n", ":12: y is \"nan\"", "finite");
  expect_refused("a.pcd", header("binary") + "abc", ": the file is truncated: 3 bytes", "need 32");
}

}  // namespace
}  // namespace lasso::sim
