#include <gtest/gtest.h>

#include "ut/hal_sim/scan_files.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

using test::expect_refused;
using test::Folder;

void expect_two_points(const RangeImage& image) {
  ASSERT_EQ(image.samples.size(), 2u);
  EXPECT_FALSE(image.misses_known);
  EXPECT_FLOAT_EQ(image.samples[0].range_m, 1.3F);
  EXPECT_FLOAT_EQ(image.samples[0].direction[0], 0.3F / 1.3F);
  EXPECT_FLOAT_EQ(image.samples[0].direction[1], -0.4F / 1.3F);
  EXPECT_FLOAT_EQ(image.samples[0].direction[2], 1.2F / 1.3F);
  EXPECT_FLOAT_EQ(image.samples[1].range_m, 2.5F);
  EXPECT_EQ(image.samples[1].direction[2], 1);
  for (const RangeSample& sample : image.samples) {
    EXPECT_EQ(sample.state, RayState::kHit);
    EXPECT_EQ(sample.t_us, 0);
  }
}

std::string header(const std::string& format, const std::string& properties, const std::string& count = "2") {
  return "ply\nformat " + format + " 1.0\nelement vertex " + count + "\n" + properties + "end_header\n";
}
const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";

TEST(ScanPly, ReadsAsciiWithOtherPropertiesAndElements) {
  VERIFIES("LASSO-SIM-020~2");
  const Folder folder;
  expect_two_points(read_scan_file(folder.write("a.ply", header("ascii", kXyz) + "0.3 -0.4 1.2\n0 0 2.5\n")));
  const std::string rich =
      "ply\r\nformat ascii 1.0\r\ncomment made elsewhere\r\nobj_info 1\r\nelement vertex 2\r\nproperty uchar red\r\nproperty double z\r\n"
      "property float32 y\r\nproperty float64 x\r\nelement face 1\r\nproperty list uchar int vertex_indices\r\nend_header\r\n"
      "255 1.2 -0.4 0.3\r\n0 2.5 0 0\r\n3 0 1 0\r\n";
  expect_two_points(read_scan_file(folder.write("b.PLY", rich)));
}

// 0.3, -0.4, 1.2, 2.5 as IEEE binary32: 3E99999A, BECCCCCD, 3F99999A, 40200000; 1.2, 2.5 as binary64: 3FF3333333333333, 4004000000000000.
TEST(ScanPly, ReadsBothBinaryForms) {
  VERIFIES("LASSO-SIM-020~2");
  const Folder folder;
  const std::string big("\x3E\x99\x99\x9A\xBE\xCC\xCC\xCD\x3F\x99\x99\x9A\0\0\0\0\0\0\0\0\x40\x20\0\0", 24);
  expect_two_points(read_scan_file(folder.write("big.ply", header("binary_big_endian", kXyz) + big)));
  const std::string little("\x9A\x99\x99\x3E\xCD\xCC\xCC\xBE\x9A\x99\x99\x3F\0\0\0\0\0\0\0\0\0\0\x20\x40", 24);
  expect_two_points(read_scan_file(folder.write("little.ply", header("binary_little_endian", kXyz) + little)));
  const std::string mixed_properties = "property uchar red\nproperty float x\nproperty float y\nproperty short s\nproperty double z\n";
  const std::string mixed(
      "\x7F\x9A\x99\x99\x3E\xCD\xCC\xCC\xBE\x11\x22\x33\x33\x33\x33\x33\x33\xF3\x3F"
      "\x7F\0\0\0\0\0\0\0\0\x11\x22\0\0\0\0\0\0\x04\x40 trailing",
      38 + 9);
  expect_two_points(read_scan_file(folder.write("mixed.ply", header("binary_little_endian", mixed_properties) + mixed)));
}

// A camera before the points, with a list; a list in each point; whole numbers.
TEST(ScanPly, PassesOverListsAndOtherElements) {
  VERIFIES("LASSO-SIM-020~2");
  const Folder folder;
  const std::string before =
      " 1.0\nelement camera 2\nproperty uchar id\nproperty list uchar short pixels\nelement pose 1\nproperty double t\nelement vertex 2\n";
  const std::string vertex = "property float x\nproperty list uchar ushort d\nproperty float y\nproperty float z\nend_header\n";
  expect_two_points(read_scan_file(
      folder.write("a.ply", "ply\nformat ascii" + before + vertex + "1 2 5 6\n2 0\n0.5\n0.3 3 9 9 9 -0.4 1.2\n0 0 0 2.5\n")));
  const std::string data(
      "\x01\x02\x05\0\x06\0\x02\0"
      "12345678"
      "\x9A\x99\x99\x3E\x01\x09\x09\xCD\xCC\xCC\xBE\x9A\x99\x99\x3F"
      "\0\0\0\0\0\0\0\0\0\0\0\x20\x40",
      8 + 8 + 15 + 13);
  expect_two_points(read_scan_file(folder.write("b.ply", "ply\nformat binary_little_endian" + before + vertex + data)));
  const std::string whole = header("binary_big_endian", "property short x\nproperty int8 y\nproperty uint z\n", "1");
  const RawScan scan = read_raw_scan(folder.write("c.ply", whole + std::string("\xFF\xFE\xFD\xFF\xFF\xFF\xFF", 7)));
  ASSERT_EQ(scan.rays.size(), 1u);
  EXPECT_EQ(scan.rays[0].place, Vec3(-2, -3, 4294967295.0));
}

TEST(ScanPly, RowsWithoutAMeasurementAreCounted) {
  VERIFIES("LASSO-SIM-036~1");
  const Folder folder;
  const RawScan ascii = read_raw_scan(folder.write("a.ply", header("ascii", kXyz, "4") + "nan nan nan\n\n0 0 2\n0 0 0\n1 -inf 1\n"));
  EXPECT_EQ(ascii.unmeasured, 3u);
  ASSERT_EQ(ascii.rays.size(), 1u);
  const std::string nan("\x3F\x80\0\0\x3F\x80\0\0\x3F\x80\0\0\0\0\0\0\x7F\xC0\0\0\x3F\x80\0\0", 24);
  const RawScan binary = read_raw_scan(folder.write("b.ply", header("binary_big_endian", kXyz) + nan));
  EXPECT_EQ(binary.unmeasured, 1u);
  ASSERT_EQ(binary.rays.size(), 1u);
}

TEST(ScanPly, EachErrorNamesItsPlaceAndItsRemedy) {
  VERIFIES("LASSO-SIM-021~1");
  const std::string ascii = header("ascii", kXyz);
  expect_refused("a.ply", "", ":1: ", "not a PLY file");
  expect_refused("a.ply", "solid x\n", ":1: ", "not a PLY file");
  expect_refused("a.ply", "ply\n", ":1: ", "ends");
  expect_refused("a.ply", "ply\nformat ascii 2.0\n", ":2: ", "format ascii 1.0");
  expect_refused("a.ply", "ply\nformat zip 1.0\n", ":2: ", "format ascii 1.0");
  expect_refused("a.ply", "ply\nformat ascii 1.0\nnonsense 3\n", ":3: header keyword \"nonsense\"", "not known");
  expect_refused("a.ply", "ply\nformat ascii 1.0\nelement face 3\nend_header\n", ":4: the header declares no element \"vertex\"", "");
  expect_refused("a.ply", "ply\nformat ascii 1.0\nelement vertex\n", ":3: ", "element NAME COUNT");
  expect_refused("a.ply", "ply\nformat ascii 1.0\nproperty float x\n", ":3: ", "before the first element");
  expect_refused("a.ply", header("ascii", kXyz, "two"), ":3: the number of vertices is \"two\"", "whole number");
  expect_refused("a.ply", header("ascii", kXyz, "-1"), ":3: the number of vertices is \"-1\"", "whole number");
  expect_refused("a.ply", header("ascii", kXyz, "0"), ":3: the file declares no point", "at least one");
  expect_refused("a.ply", header("ascii", kXyz, "2000000000"), ":3: the file declares 2000000000 points", "at most 1e9");
  expect_refused("a.ply", header("ascii", "property float x\nproperty float y\n"), ":6: the vertex has no property \"z\"", "expected");
  expect_refused("a.ply", header("ascii", kXyz + "property float x\n"), ":8: coordinate \"x\" is declared twice", "");
  expect_refused("a.ply", header("ascii", "property half x\n"), ":4: property type \"half\"", "float or double");
  expect_refused("a.ply", header("ascii", "property list uchar k\n"), ":4: ", "property list TYPE TYPE NAME");
  expect_refused("a.ply", header("ascii", "property list float int k\n"), ":4: the length of a list is of type \"float\"", "integer");
  expect_refused("a.ply", "ply\nformat ascii 1.0\nelement vertex 2\n" + kXyz, ":6: ", "end_header");
  expect_refused("a.ply", ascii + "1 2 3\n", ":8: the file ends after 1 of 2 points", "");
  expect_refused("a.ply", ascii + "1 2 3\n1 2\n", ":9: the point has 2 values", "expected 3");
  expect_refused("a.ply", ascii + "1 2 x\n", ":8: z is \"x\"", "decimal number");
  expect_refused("a.ply", header("binary_big_endian", kXyz) + std::string(23, 'a'), ": the file is truncated: 23 bytes", "need 24");
  const std::string list = header("binary_little_endian", kXyz + "property list int short k\n", "1");
  expect_refused("a.ply", list + std::string(12, 'a') + std::string("\xFF\xFF\xFF\x7F", 4),
                 ": the file is truncated: ", "within an element");
}

}  // namespace
}  // namespace lasso::sim
