// The component's memory decays: what the scrub finds, and what is made of it.
#include "ut/exec/memory_scene.hpp"

namespace lasso {
namespace {

using test::all_valid;
using test::better_image;
using test::crc_of;
using test::first_image;
using test::MemoryScene;
using ComponentScrub = test::MemoryFixture;

// Flips while tracking: reported within a period of the scrub, and poses go on.
TEST_F(ComponentScrub, FlipsAreToldAndRepairedWhileTracking) {
  VERIFIES("LASSO-IMG-016~2 LASSO-IMG-017~1 LASSO-HLT-010~3");
  scene_->begin(first_image());
  scene_->run_frames(5);
  const std::vector<std::uint64_t> right = scene_->buffers[0];
  for (const std::size_t byte : {std::size_t{1000}, first_image().size / 2, first_image().size - 1}) {
    scene_->events.clear();
    scene_->buffer(0)[byte] ^= 0x20;
    scene_->run_frames(50);
    EXPECT_EQ(scene_->last(EventId::kMemoryCorrupt).items[0], static_cast<std::uint8_t>(ScrubArea::kImage0));
    EXPECT_EQ(scene_->last(EventId::kMemoryCorrupt).items[5], 1) << "repaired";
    EXPECT_EQ(scene_->buffers[0], right);
  }
  scene_->events.clear();
  scene_->code[30000] ^= 1;
  scene_->run_frames(50);
  EXPECT_EQ(scene_->last(EventId::kMemoryCorrupt).items[0], static_cast<std::uint8_t>(ScrubArea::kCode));
  EXPECT_EQ(scene_->last(EventId::kMemoryCorrupt).items[5], 0);
  EXPECT_TRUE(all_valid(scene_->run_frames(5)));
}

// The period is a parameter, too: a scrub that went by it would stand still.
TEST_F(ComponentScrub, AFlipOfThePeriodDoesNotStopTheScrub) {
  VERIFIES("LASSO-IMG-017~1");
  scene_->begin(first_image());
  scene_->run_frames(5);
  auto* const period = const_cast<double*>(&component().mission().parameters.period_s);
  auto* const bytes = reinterpret_cast<std::uint8_t*>(period);
  for (std::size_t i = 0; i < sizeof(double); ++i) bytes[i] = 0;
  scene_->run_frames(50);
  EXPECT_TRUE(scene_->told(EventId::kMemoryCorrupt));
  EXPECT_EQ(*period, MemoryScene::parameters().period_s);
}

// In a keeper's memory: the number of the active image, before its copies.
std::size_t& number_of_active(const ImageKeeper& images) {
  constexpr std::uint32_t kCopies[] = {0, ~0u, 0};
  auto* const words = reinterpret_cast<std::uint32_t*>(const_cast<ImageKeeper*>(&images));
  auto* const end = words + sizeof(ImageKeeper) / sizeof(std::uint32_t);
  auto* const copies = std::find_end(words, end, kCopies, kCopies + 3);
  EXPECT_NE(copies, end);
  return reinterpret_cast<std::size_t*>(copies)[-1];
}

// The other buffer holds no image that could be flown with, and beyond both is none. Any bit, in the middle of a frame and at its end.
TEST_F(ComponentScrub, AFlipOfWhichImageIsActiveIsToldAndPosesGoOn) {
  VERIFIES("LASSO-HLT-014~3");
  scene_->begin(first_image());
  scene_->run_frames(5);
  std::size_t& number = number_of_active(component().images());
  for (unsigned bit = 0; bit < 8 * sizeof number; ++bit) {
    for (unsigned slot = 0; slot < bit % kSlotsPerFrame; ++slot) {
      component().run_slot(component().next_slot_us());
      component().run_estimation();
    }
    ASSERT_EQ(number, 0U);
    number = std::size_t{1} << bit;
    const std::uint32_t before = component().faults().confirmations();
    const std::vector<PoseTelemetry> poses = scene_->run_frames(3);
    EXPECT_TRUE(poses.size() >= 2 && all_valid(poses)) << bit;
    EXPECT_EQ(component().faults().confirmations(), before + 1) << bit;
    EXPECT_EQ(component().images().active_number(), 0) << bit;
  }
  EXPECT_TRUE(component().faults().ever().has(Fault::kImageCorrupt));
}

// Without the store nothing can be repaired: what is in use makes safe, what is not is refused.
TEST_F(ComponentScrub, AnImageThatCannotBeRepairedMakesSafe) {
  VERIFIES("LASSO-IMG-016~2 LASSO-HLT-002~1");
  scene_->begin(first_image());
  scene_->run_frames(5);
  scene_->upload(better_image());
  scene_->store.broken = true;
  scene_->buffer(1)[2000] ^= 4;
  scene_->run_frames(50);
  EXPECT_TRUE(component().faults().ever().has(Fault::kImageCorrupt));
  EXPECT_EQ(component().images().other().state(), ImageState::kRefused);
  EXPECT_TRUE(all_valid(scene_->run_frames(5))) << "nobody uses it";
  scene_->buffer(0)[2000] ^= 4;
  scene_->run_frames(50);
  EXPECT_TRUE(component().faults().ever().has(Fault::kImageLost));
  EXPECT_EQ(scene_->run_frames(1).back().mode, static_cast<std::uint8_t>(TrackingMode::kSafe));
}

}  // namespace
}  // namespace lasso
