#include "fsw/exec/start_image.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "fsw/mission/stored_record.hpp"
#include "ut/exec/component_scene.hpp"
#include "ut/support/ram_store.hpp"

namespace lasso {
namespace {

constexpr std::size_t kImageBytes = 1U << 20;

// A board whose store outlives its components.
class StartImage : public ::testing::Test {
 protected:
  StartImage() {
    for (auto& buffer : buffers_) buffer.resize(kImageBytes / 8);
  }

  BoardMemory memory() {
    BoardMemory memory;
    for (std::size_t i = 0; i < 2; ++i) memory.image_buffers[i] = Bytes(reinterpret_cast<std::uint8_t*>(buffers_[i].data()), kImageBytes);
    memory.store = &store_;
    return memory;
  }
  // Of another number for other inliers_min.
  static test::TestImage image(std::uint32_t inliers_min) {
    MissionParameters p = test::box_parameters(test::default_scene());
    p.inliers_min = inliers_min;
    return test::make_image(p, test::make_box_tables(test::default_scene().boxes()));
  }
  ImageStart start(const BoardMemory& memory, test::TestImage image) {
    component_ = std::make_unique<Component>(sensor_);
    return start_image(*component_, memory, {image.data(), image.size});
  }
  double inliers_min() const { return component_->mission().parameters.inliers_min; }

  std::vector<std::uint64_t> buffers_[2];
  test::RamStore store_{kStoredHeaderBytes + kImageBytes};
  test::BoxSensor sensor_{test::default_scene()};
  std::unique_ptr<Component> component_;
};

TEST_F(StartImage, TakesTheImageThatIsGivenWhereTheStoreHasNone) {
  VERIFIES("LASSO-IMG-015~1");
  const ImageStart started = start(memory(), image(50));
  EXPECT_EQ(started.failure.status, Status::kOk);
  EXPECT_FALSE(started.from_store);
  EXPECT_EQ(inliers_min(), 50);
  EXPECT_TRUE(component_->images().active_stored());
}

TEST_F(StartImage, TakesTheStoresImageFirst) {
  VERIFIES("LASSO-IMG-015~1");
  start(memory(), image(50));
  const ImageStart started = start(memory(), image(60));
  EXPECT_EQ(started.failure.status, Status::kOk);
  EXPECT_TRUE(started.from_store);
  EXPECT_EQ(inliers_min(), 50);
}

// What was loaded beside the store is then not even looked at.
TEST_F(StartImage, NeedsNoOtherImageThanTheStores) {
  VERIFIES("LASSO-IMG-015~1");
  start(memory(), image(50));
  EXPECT_TRUE(start(memory(), test::TestImage{}).from_store);
  EXPECT_EQ(inliers_min(), 50);
}

TEST_F(StartImage, LeavesTheAreaThatCountsWhereItsImageIsDamaged) {
  VERIFIES("LASSO-IMG-015~1");
  start(memory(), image(50));
  const std::vector<std::uint8_t> before = store_.of(StoreArea::kImage0);
  store_.of(StoreArea::kImage0)[1000] ^= 1;
  const ImageStart started = start(memory(), image(60));
  EXPECT_EQ(started.failure.status, Status::kOk);
  EXPECT_FALSE(started.from_store);
  EXPECT_EQ(component_->images().active_number(), 1);
  store_.of(StoreArea::kImage0)[1000] ^= 1;
  EXPECT_EQ(store_.of(StoreArea::kImage0), before);
}

TEST_F(StartImage, WorksWithoutAStore) {
  VERIFIES("LASSO-IMG-011~1");
  BoardMemory without = memory();
  without.store = nullptr;
  const ImageStart started = start(without, image(50));
  EXPECT_EQ(started.failure.status, Status::kOk);
  EXPECT_FALSE(started.from_store);
  EXPECT_FALSE(component_->images().active_stored());
  EXPECT_EQ(component_->images().other().buffer().size(), kImageBytes);
}

TEST_F(StartImage, RefusesWhatDoesNotFit) {
  VERIFIES("LASSO-IMG-015~1");
  BoardMemory small = memory();
  for (Bytes& buffer : small.image_buffers) buffer = buffer.first(1000);
  EXPECT_EQ(start(small, image(50)).failure.status, Status::kOverCapacity);
  EXPECT_EQ(start(memory(), test::TestImage{}).failure.status, Status::kTruncated);
  BoardMemory uneven = memory();
  uneven.image_buffers[1] = uneven.image_buffers[1].first(1000);
  EXPECT_EQ(start(uneven, image(50)).failure.status, Status::kBadValue);
}

}  // namespace
}  // namespace lasso
