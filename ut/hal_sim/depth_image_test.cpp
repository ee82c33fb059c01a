#include "hal_sim/depth_image.hpp"

#include <gtest/gtest.h>

#include "ut/hal_sim/scan_files.hpp"
#include "ut/support/grey_png.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

const DepthCamera kCamera{2, 4, 1, 0.5, 1e-3, false};

TEST(DepthImage, PixelsAreReturnsByTheirDepthAndZerosMisses) {
  VERIFIES("LASSO-SIM-041~1");
  const RawScan scan = read_depth_image("a.png", test::grey_png(3, {0, 1000, 65535, 256, 1, 0}), kCamera);
  ASSERT_EQ(scan.rays.size(), 6u);
  EXPECT_TRUE(scan.misses_known);
  EXPECT_FALSE(scan.has_times);
  EXPECT_FALSE(scan.rays[0].hit);
  EXPECT_LT((scan.rays[0].place - Vec3(-0.5, -0.125, 1).normalized()).norm(), 1e-12);
  EXPECT_LT((scan.rays[1].place - Vec3(0, -0.125, 1)).norm(), 1e-12) << "one metre along z";
  EXPECT_LT((scan.rays[2].place - 65.535 * Vec3(0.5, -0.125, 1)).norm(), 1e-9);
  EXPECT_LT((scan.rays[3].place - 0.256 * Vec3(-0.5, 0.125, 1)).norm(), 1e-12) << "the second row";
  EXPECT_LT((scan.rays[4].place - 0.001 * Vec3(0, 0.125, 1)).norm(), 1e-12);
  EXPECT_FALSE(scan.rays[5].hit);
  EXPECT_EQ(scan.rays[5].row, 6u);
}

TEST(DepthImage, ValuesMayBeRanges) {
  VERIFIES("LASSO-SIM-041~1");
  DepthCamera camera = kCamera;
  camera.along_ray = true;
  const RawScan scan = read_depth_image("a.png", test::grey_png(3, {3000, 0, 0}), camera);
  EXPECT_NEAR(scan.rays[0].place.norm(), 3, 1e-12);
}

std::string refusal_of_image(const std::string& bytes) {
  try {
    static_cast<void>(read_depth_image("a.png", bytes, kCamera));
  } catch (const ScanFileError& error) {
    return error.what();
  }
  return "none";
}

TEST(DepthImage, OthersAreRefusedInOneLine) {
  VERIFIES("LASSO-SIM-021~1");
  const std::string good = test::grey_png(2, {1, 2, 3, 4});
  std::string damaged = good;
  damaged[50] ^= 1;
  for (const std::string& bad : {std::string(), std::string("hello"), good.substr(0, 20), good.substr(0, good.size() - 20), damaged,
                                 test::grey_png(4, {1, 2, 3, 4}, 8)}) {
    const std::string what = refusal_of_image(bad);
    EXPECT_EQ(what.find("a.png: cannot be read as a depth image: "), 0u) << what;
    EXPECT_NE(what.find("expected a PNG of 16-bit greyscale"), std::string::npos) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos);
  }
  std::string large = test::grey_png(2, {1, 2, 3, 4});
  large.replace(8, 25, test::png_chunk("IHDR", test::big_endian(16384) + test::big_endian(8192) + std::string("\x10\0\0\0\0", 5)));
  EXPECT_NE(refusal_of_image(large).find("it has more than 16777216 pixels"), std::string::npos) << refusal_of_image(large);
  std::string huge = test::grey_png(2, {1, 2, 3, 4});
  const std::string header = std::string("\x7F\xFF\xFF\xFF\x7F\xFF\xFF\xFF\x10\0\0\0\0", 13);
  huge.replace(8, 25, test::png_chunk("IHDR", header));
  EXPECT_NE(refusal_of_image(huge).find("cannot be read as a depth image: "), std::string::npos);
  EXPECT_NE(refusal_of_image(test::grey_png(4, {1, 2, 3, 4}, 8)).find("it is not 16-bit greyscale"), std::string::npos);
}

TEST(DepthImage, IsAScanOfItsFolderWhereACameraIsGiven) {
  VERIFIES("LASSO-SIM-041~1");
  const test::Folder folder;
  folder.write("s2.png", test::grey_png(2, {1000, 0, 0, 2000}));
  folder.write("s10.PNG", test::grey_png(1, {500}));
  const RecordedScans scans(folder.path(), {}, kCamera);
  ASSERT_EQ(scans.size(), 2u);
  EXPECT_EQ(scans.survey()[0].misses, 2u);
  EXPECT_EQ(scans.read(0).samples.size(), 4u);
  EXPECT_TRUE(scans.read(0).misses_known);
  try {
    const RecordedScans without(folder.path());
    ADD_FAILURE();
  } catch (const ScanFileError& error) {
    EXPECT_NE(std::string(error.what()).find(".png (an image with a depth camera)"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace lasso::sim
