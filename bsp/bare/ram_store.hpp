// The non-volatile store as a region of memory that start-up leaves alone: it outlives a restart, not the loss of power. What memory holds
// then is noise, and reads as nothing: each image, parameter set and record of the event log has a checksum of its own
// (fsw/mission/stored_record.hpp, fsw/exec/stored_log.hpp), and nothing else says what is there, so that a flipped bit costs one of them.
#pragma once

#include "bsp/bare/bytes.hpp"
#include "fsw/core/invariant.hpp"
#include "fsw/mission/stored_record.hpp"

namespace lasso::bare {

constexpr std::size_t kMissionBytes = 31U << 20;  // of an image: as loaded, in a buffer, in the store (sections.ld)

class RamStore final : public Store {
 public:
  // What was written last is in memory, and not only in the cache, before it returns: a hardware reset forgets the cache.
  using WriteBack = void (*)(ConstBytes written);

  // One area behind the other, the small ones first, for images of up to `image_bytes`.
  static constexpr std::size_t region_bytes(std::size_t image_bytes) { return offset_of(kStoreAreas, image_bytes); }

  // `region` outlives the store, and has region_bytes().
  RamStore(Bytes region, std::size_t image_bytes, WriteBack write_back)
      : region_(region), image_bytes_(image_bytes), write_back_(write_back) {
    invariant(region.size() >= region_bytes(image_bytes), "a store larger than its memory");
  }

  std::size_t size(StoreArea area) const override { return stored_area_bytes(area, image_bytes_); }
  Status read(StoreArea area, std::size_t offset, Bytes out) override {
    if (!inside(area, offset, out.size())) return Status::kBadIndex;
    copy_up(out.data(), place(area, offset, out.size()).data(), out.size());
    return Status::kOk;
  }
  Status write(StoreArea area, std::size_t offset, ConstBytes data) override {
    if (!inside(area, offset, data.size()) || data.size() > kMaxStoreWriteBytes) return Status::kBadIndex;
    const Bytes written = place(area, offset, data.size());
    copy_up(written.data(), data.data(), data.size());
    write_back_(written);
    return Status::kOk;
  }

 private:
  static constexpr StoreArea kOrder[kStoreAreas] = {StoreArea::kParameters0, StoreArea::kParameters1, StoreArea::kEventLog,
                                                    StoreArea::kImage0, StoreArea::kImage1};
  static constexpr std::size_t offset_of(std::size_t position, std::size_t image_bytes) {
    std::size_t offset = 0;
    for (std::size_t i = 0; i < position; ++i) offset += stored_area_bytes(kOrder[i], image_bytes);
    return offset;
  }
  bool inside(StoreArea area, std::size_t offset, std::size_t bytes) const { return offset <= size(area) && bytes <= size(area) - offset; }
  Bytes place(StoreArea area, std::size_t offset, std::size_t bytes) const {
    std::size_t position = 0;
    while (position + 1 < kStoreAreas && kOrder[position] != area) ++position;
    return region_.subspan(offset_of(position, image_bytes_) + offset, bytes);
  }

  Bytes region_;
  std::size_t image_bytes_;
  WriteBack write_back_;
};

}  // namespace lasso::bare
