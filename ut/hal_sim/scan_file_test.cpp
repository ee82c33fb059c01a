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

TEST(RecordedScans, AreListedInNaturalOrder) {
  VERIFIES("LASSO-SIM-019~2");
  const Folder folder;
  for (const char* name : {"scan_10.csv", "scan_2.csv", "scan_1.csv"}) folder.write(name, kOnePoint);
  folder.write("scan_05.ply", kOnePly);
  folder.write("notes.txt", "not a scan");
  std::filesystem::create_directory(folder.path() / "scan_0.csv");
  const RecordedScans scans(folder.path());
  ASSERT_EQ(scans.size(), 4u);
  EXPECT_EQ(scans.stem(0), "scan_1");
  EXPECT_EQ(scans.stem(1), "scan_2");
  EXPECT_EQ(scans.stem(2), "scan_05");
  EXPECT_EQ(scans.stem(3), "scan_10");
  EXPECT_EQ(scans.read(2).samples[0].range_m, 2);
  EXPECT_EQ(scans.read(3).scan_id, 3u);
  EXPECT_EQ(scans.read(3).samples[0].range_m, 1);
}

// Numbers by their value, however long; other text by its bytes; a name before those that it begins.
TEST(RecordedScans, NumbersInNamesCompareAsNumbers) {
  VERIFIES("LASSO-SIM-019~2");
  const Folder folder;
  const char* const names[] = {"a", "a1b2", "a1b10", "a01b11", "a2", "a100", "a99999999999999999999998", "a99999999999999999999999", "b"};
  for (const char* name : names) folder.write(std::string(name) + ".csv", kOnePoint);
  const RecordedScans scans(folder.path());
  ASSERT_EQ(scans.size(), std::size(names));
  for (std::size_t i = 0; i < scans.size(); ++i) EXPECT_EQ(scans.stem(i), names[i]);
}

TEST(RecordedScans, AreReadInTheUnitOfTimeThatIsSet) {
  VERIFIES("LASSO-SIM-038~1");
  const Folder folder;
  folder.write("a.csv",
               "t_s,x_m,y_m,z_m,valid\n1700000000000000000,0,0,1,1\n1700000000180000000,nan,nan,nan,0\n1700000000180000000,0,0,1,1\n");
  RecordedScans scans(folder.path());
  const std::vector<ScanFacts> facts = scans.survey();
  ASSERT_EQ(facts.size(), 1u);
  EXPECT_EQ(facts[0].hits, 2u);
  EXPECT_EQ(facts[0].unmeasured, 1u);
  EXPECT_EQ(facts[0].last_time - facts[0].first_time, 180000000);
  scans.set_time_unit(1e-9, facts);
  EXPECT_EQ(scans.read(0).reference_time_us(), 1700000000090000);
  expect_error([&] { scans.set_time_unit(1e-3, facts); }, folder.path().string() + "/a.csv: ", "check their unit");
}

TEST(RecordedScans, TheColumnOfSecondsIsTold) {
  VERIFIES("LASSO-SIM-038~1");
  const Folder folder;
  folder.write("a.csv", "t_s,x,y,z\n0,0,0,1\n");
  folder.write("b.csv", "t,x,y,z\n0,0,0,1\n");
  const std::vector<ScanFacts> facts = RecordedScans(folder.path()).survey();
  EXPECT_TRUE(facts.at(0).seconds_named);
  EXPECT_FALSE(facts.at(1).seconds_named);
}

TEST(ScanFile, EachExtensionThatIsToldIsReadAndLeftOutOfAStem) {
  VERIFIES("LASSO-SIM-019~2");
  EXPECT_EQ(scan_extensions(), ".csv, .ply, .pcd, .asc, .xyz, .pts, .png");
  for (const char* name : {"a.1.csv", "a.1.ply", "a.1.pcd", "a.1.asc", "a.1.xyz", "a.1.PTS", "a.1.png", "a.1"})
    EXPECT_EQ(scan_stem(name), "a.1") << name;
}

TEST(RecordedScans, HiddenFilesAreNoScans) {
  VERIFIES("LASSO-SIM-021~1");
  const Folder folder;
  folder.write("a.csv", "t_s,x,y,z\n0,0,0,1\n");
  folder.write("._a.csv", std::string("\0\5\x16\7", 4));
  EXPECT_EQ(RecordedScans(folder.path()).survey().size(), 1u);
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
  expect_error([&] { (void)read_scan_file(folder.path()); }, place, "expected .csv, .ply, .pcd");
  const auto text = folder.write("a.dat", "0 0 1");
  expect_error([&] { (void)read_scan_file(text); }, text.string() + ": ", "expected .csv, .ply, .pcd");
  const auto large = folder.write("large.csv", kOnePoint);
  std::filesystem::resize_file(large, (std::uintmax_t{4} << 30) + 1);  // sparse
  expect_error([&] { (void)read_scan_file(large); }, large.string() + ": has 4294967297 bytes", "4 GiB");
}

}  // namespace
}  // namespace lasso::sim
