// A non-volatile store in memory, whose power can fail at any byte, and whose medium can fail.
#pragma once

#include <cstddef>
#include <vector>

#include "fsw/mission/store.hpp"

namespace lasso::test {

class RamStore final : public Store {
 public:
  explicit RamStore(std::size_t image_bytes) {
    for (std::size_t i = 0; i < kStoreAreas; ++i) areas_[i].resize(i < 2 ? image_bytes : 4096, 0xA5);  // what was never written
  }
  std::size_t size(StoreArea area) const override { return of(area).size(); }
  Status read(StoreArea area, std::size_t offset, Bytes out) override {
    if (broken || reads_left == 0) return Status::kNoData;
    --reads_left;
    if (offset > size(area) || out.size() > size(area) - offset) return Status::kBadIndex;
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = of(area)[offset + i];
    return Status::kOk;
  }
  // Once the power is gone nothing is written, and the component, which is as good as dead, sees nothing of it. The byte that was being
  // written is spoiled.
  Status write(StoreArea area, std::size_t offset, ConstBytes data) override {
    ++writes;
    largest_write = data.size() > largest_write ? data.size() : largest_write;
    if (broken) return Status::kNoData;
    if (offset > size(area) || data.size() > size(area) - offset) return Status::kBadIndex;
    for (std::size_t i = 0; i < data.size() && bytes_left > 0; ++i, --bytes_left) {
      of(area)[offset + i] = bytes_left == 1 ? static_cast<std::uint8_t>(data[i] ^ 0x5A) : data[i];
    }
    written += data.size();
    return Status::kOk;
  }
  std::vector<std::uint8_t>& of(StoreArea area) { return areas_[static_cast<std::size_t>(area)]; }
  const std::vector<std::uint8_t>& of(StoreArea area) const { return areas_[static_cast<std::size_t>(area)]; }

  static constexpr std::size_t kForEver = ~std::size_t{0};
  std::size_t bytes_left = kForEver;  // until the power fails
  std::size_t reads_left = kForEver;  // until the medium fails
  bool broken = false;
  std::size_t written = 0, writes = 0, largest_write = 0;

 private:
  std::vector<std::uint8_t> areas_[kStoreAreas];
};

}  // namespace lasso::test
