#include "hal_sim/scan_file.hpp"

#include <gtest/gtest.h>

#include "ut/hal_sim/scan_files.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

using test::Folder;

const std::string kOnePoint = "t_s,x_m,y_m,z_m,valid\n0,0,0,1,1\n";
const std::string kOnePly =
    "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 2\n";

template <class Action>
void expect_error(Action action, const std::string& begin, const std::string& part) {
  try {
    action();
    ADD_FAILURE() << "no error about " << part;
  } catch (const ScanFileError& error) {
    EXPECT_EQ(std::string(error.what()).find(begin), 0u) << error.what();
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(RecordedScans, AreListedInNameOrder) {
  VERIFIES("LASSO-SIM-019~1");
  const Folder folder;
  for (const char* name : {"scan_010.csv", "scan_002.csv", "scan_001.csv"}) folder.write(name, kOnePoint);
  folder.write("scan_005.ply", kOnePly);
  folder.write("notes.txt", "not a scan");
  std::filesystem::create_directory(folder.path() / "scan_000.csv");
  const RecordedScans scans(folder.path());
  ASSERT_EQ(scans.size(), 4u);
  EXPECT_EQ(scans.stem(0), "scan_001");
  EXPECT_EQ(scans.stem(1), "scan_002");
  EXPECT_EQ(scans.stem(2), "scan_005");
  EXPECT_EQ(scans.stem(3), "scan_010");
  EXPECT_EQ(scans.read(2).samples[0].range_m, 2);
  EXPECT_EQ(scans.read(3).scan_id, 3u);
  EXPECT_EQ(scans.read(3).samples[0].range_m, 1);
}

TEST(RecordedScans, AFolderThatHoldsNoSequenceIsRefused) {
  VERIFIES("LASSO-SIM-021~1");
  const Folder folder;
  const std::string place = folder.path().string();
  expect_error([&] { RecordedScans scans(folder.path() / "none"); }, place + "/none: ", "not a folder");
  folder.write("readme.md", "");
  expect_error([&] { RecordedScans scans(folder.path()); }, place + ": ", "no scan");
  folder.write("a.csv", kOnePoint);
  folder.write("a.ply", kOnePly);
  expect_error([&] { RecordedScans scans(folder.path()); }, place + "/a.", "has the stem \"a\" too");
}

TEST(ScanFile, WhatIsNoScanFileIsRefused) {
  VERIFIES("LASSO-SIM-021~1");
  const Folder folder;
  const std::string place = folder.path().string();
  expect_error([&] { (void)read_scan_file(folder.path() / "a.csv"); }, place + "/a.csv: ", "not a file");
  expect_error([&] { (void)read_scan_file(folder.path()); }, place, "expected .csv, .ply or .pcd");
  const auto text = folder.write("a.xyz", "0 0 1");
  expect_error([&] { (void)read_scan_file(text); }, text.string() + ": ", "expected .csv, .ply or .pcd");
  const auto large = folder.write("large.csv", kOnePoint);
  std::filesystem::resize_file(large, (64u << 20) + 1);  // sparse
  expect_error([&] { (void)read_scan_file(large); }, large.string() + ": has 67108865 bytes", "64 MiB");
}

}  // namespace
}  // namespace lasso::sim
