#include "bsp/posix/image_memory.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <system_error>

#include "ut/exec/component_scene.hpp"

namespace lasso::posix {
namespace {

constexpr std::size_t kImageBytes = 1U << 20;

class ImageMemoryTest : public ::testing::Test {
 protected:
  ImageMemoryTest()
      : folder_(std::filesystem::temp_directory_path() /
                ("lasso_memory_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    std::filesystem::remove_all(folder_);
  }
  ~ImageMemoryTest() override { std::filesystem::remove_all(folder_); }

  static test::TestImage image(std::uint32_t inliers_min) {
    MissionParameters p = test::box_parameters(test::default_scene());
    p.inliers_min = inliers_min;
    return test::make_image(p, test::make_box_tables(test::default_scene().boxes()));
  }
  static ConstBytes bytes_of(test::TestImage& image) { return {image.data(), image.size}; }

  // A start of a new component: the number of its image.
  std::uint32_t start(ImageMemory& memory, test::TestImage image) {
    component_ = std::make_unique<Component>(sensor_);
    EXPECT_EQ(memory.start(*component_, bytes_of(image)).status, Status::kOk);
    return component_->mission().image_crc;
  }

  std::filesystem::path folder_;
  test::BoxSensor sensor_{test::default_scene()};
  std::unique_ptr<Component> component_;
};

TEST_F(ImageMemoryTest, TheStoresImageTakesThePlaceOfTheOneThatIsGiven) {
  VERIFIES("LASSO-IMG-015~1");
  std::uint32_t first = 0;
  {
    ImageMemory memory(folder_.string(), kImageBytes);
    first = start(memory, image(50));
    EXPECT_FALSE(memory.from_store());
    EXPECT_TRUE(component_->images().active_stored());
  }
  ImageMemory memory(folder_.string(), kImageBytes);
  EXPECT_EQ(start(memory, image(60)), first);
  EXPECT_TRUE(memory.from_store());
}

TEST_F(ImageMemoryTest, AnAreaThatCountsIsKeptWhereItsImageCannotBeTaken) {
  VERIFIES("LASSO-IMG-015~1");
  {
    ImageMemory memory(folder_.string(), kImageBytes);
    start(memory, image(50));
  }
  {
    std::fstream file(folder_ / "image0", std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(1000).put('\x5A');
  }
  ImageMemory memory(folder_.string(), kImageBytes);
  start(memory, image(60));
  EXPECT_FALSE(memory.from_store());
  EXPECT_EQ(component_->images().active_number(), 1);
  EXPECT_TRUE(component_->images().active_stored());
}

TEST_F(ImageMemoryTest, WithoutAStoreThereAreStillTwoBuffersAndTheCode) {
  VERIFIES("LASSO-IMG-017~1");
  ImageMemory memory("", kImageBytes);
  start(memory, image(50));
  EXPECT_EQ(component_->images().other().buffer().size(), kImageBytes);
  EXPECT_FALSE(component_->images().code().empty());
  EXPECT_EQ(component_->images().code().data(), code_of_program().data());
}

TEST_F(ImageMemoryTest, WhatDoesNotFitOrCannotBeMadeIsRefused) {
  VERIFIES("LASSO-IMG-015~1");
  ImageMemory small("", 1000);
  Component component(sensor_);
  test::TestImage large = image(50);
  EXPECT_EQ(small.start(component, bytes_of(large)).status, Status::kOverCapacity);
  std::ofstream(folder_) << "no folder";
  EXPECT_THROW(ImageMemory(folder_.string(), kImageBytes), std::system_error);
}

}  // namespace
}  // namespace lasso::posix
