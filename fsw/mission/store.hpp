// The board's non-volatile store: a few areas of bytes that survive a loss of power. What is in them, and how a loss of power in the middle
// of writing is survived, is the component's affair (stored_record.hpp): a write that is interrupted may leave any of its bytes old, new,
// or anything else, but touches no others, and comes after all that were asked for before it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/span.hpp"
#include "fsw/core/status.hpp"

namespace lasso {

enum class StoreArea : std::uint8_t { kImage0 = 0, kImage1 = 1, kParameters0 = 2, kParameters1 = 3, kEventLog = 4 };
constexpr std::size_t kStoreAreas = 5;
constexpr std::size_t kMaxStoreWriteBytes = 4096;  // of one call: what a board does in a slot

// Given by the board. Calls come from a slot, and do not wait: a board whose medium is slow writes meanwhile, in the order of the calls,
// and reads what it has not written yet from where it keeps it.
class Store {
 public:
  virtual std::size_t size(StoreArea area) const = 0;
  // kBadIndex outside the area, kNoData when the medium fails. Reads of what was never written give anything.
  virtual Status read(StoreArea area, std::size_t offset, Bytes out) = 0;
  // At most kMaxStoreWriteBytes.
  virtual Status write(StoreArea area, std::size_t offset, ConstBytes data) = 0;

 protected:
  ~Store() = default;  // never deleted through this interface: no operator delete in flight code
};

}  // namespace lasso
