// An image keeper with two buffers and a store, and what is done with it in every test.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <numeric>

#include "fsw/mission/image_keeper.hpp"
#include "fsw/mission/stored_record.hpp"
#include "ut/support/box_image.hpp"
#include "ut/support/ram_store.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::test {

constexpr DurationUs kSlot_us = 10000;

inline TestImage image_of(double points, double period_s = 0.2) {
  MissionParameters parameters = preset_parameters();
  parameters.points = points;
  parameters.period_s = period_s;
  return make_box_image(parameters);
}
inline std::uint32_t crc_of(TestImage image) {
  std::uint32_t crc = 0;
  for (std::size_t i = 0; i < 4; ++i) crc = crc << 8 | image.data()[image.size - 4 + i];
  return crc;
}

class KeeperTest : public ::testing::Test {
 protected:
  static const TestImage& old_image() {
    static const TestImage image = image_of(512);
    return image;
  }
  static const TestImage& new_image() {
    static const TestImage image = image_of(600);
    return image;
  }

  KeeperTest() : store_(old_image().size + 4096) { restart(); }

  // Power comes back: memory is as it was never before, the store as it was.
  void restart(bool with_store = true) {
    for (auto& buffer : buffers_) buffer.assign(old_image().storage.size() + 64, 0x5555555555555555U);
    keeper_ = std::make_unique<ImageKeeper>();
    ASSERT_EQ(keeper_->use_buffers(buffer(0), buffer(1)), Status::kOk);
    if (with_store) keeper_->use_store(store_);
  }
  Bytes buffer(std::size_t i) { return {reinterpret_cast<std::uint8_t*>(buffers_[i].data()), 8 * buffers_[i].size()}; }
  LoadFailure start(const TestImage& image = old_image()) {
    std::memcpy(buffer(0).data(), image.storage.data(), image.size);
    return keeper_->start(buffer(0).first(image.size), 1);
  }
  ImageRefusal open(const TestImage& image) { return keeper_->open(static_cast<std::uint32_t>(image.size), crc_of(image)); }
  ImageRefusal put(const TestImage& image, std::size_t block) {
    TestImage copy = image;
    const std::size_t at = block * kLoadBlockBytes;
    return keeper_->put(static_cast<std::uint32_t>(at),
                        ConstBytes(copy.data() + at, std::min<std::size_t>(kLoadBlockBytes, copy.size - at)));
  }
  std::size_t blocks(const TestImage& image) const { return (image.size + kLoadBlockBytes - 1) / kLoadBlockBytes; }
  void upload(const TestImage& image) {
    ASSERT_EQ(open(image), ImageRefusal::kNone);
    TestImage copy = image;
    ASSERT_EQ(keeper_->put(0, ConstBytes(copy.data(), copy.size)), ImageRefusal::kNone);
  }
  // Slots until the other image is ready, or refused; how many.
  std::uint32_t work() {
    std::uint32_t slots = 0;
    const auto busy = [&] { return keeper_->other().state() != ImageState::kReady && keeper_->other().state() != ImageState::kRefused; };
    for (; busy() && slots < 10000; ++slots) keeper_->step(1);
    return slots;
  }
  void make_ready(const TestImage& image) {
    upload(image);
    ASSERT_EQ(keeper_->begin_check(), ImageRefusal::kNone);
    work();
    ASSERT_EQ(keeper_->other().state(), ImageState::kReady) << keeper_->other().result().what;
  }
  double points() const { return keeper_->view(0).mission.parameters.points; }
  // Scrubs for one period at most; whether something was found.
  bool scrub() {
    for (DurationUs t = 0; t < kScrubPeriod_us + 20 * kSlot_us; t += kSlot_us) {
      if (keeper_->scrub(kSlot_us)) return true;
    }
    return false;
  }
  std::vector<std::uint8_t> active_bytes() {
    const ConstBytes bytes = keeper_->active().sealed_image();
    return {bytes.begin(), bytes.end()};
  }

  std::vector<std::uint64_t> buffers_[2];
  RamStore store_;
  std::unique_ptr<ImageKeeper> keeper_;
};

}  // namespace lasso::test
