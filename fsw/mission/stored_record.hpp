// A record in an area of the store, and pairs of areas of which the newer whole one counts. An area begins with a header; the record lies
// behind it.
//
//   0  magic, 4 sequence number (0: stored, never selected), 8 bytes of the record, 12 its CRC-32C, 16 CRC-32C of the 16 bytes before
//
// A record is replaced in this order: the header is cleared, the record is written, the header is written. Of a pair the area with the
// lower number is written, so that the other one counts until the last byte of the new header is in place. A record is selected by a header
// with the next number.
#pragma once

#include "fsw/mission/store.hpp"

namespace lasso {

constexpr std::size_t kStoredHeaderBytes = 32;

// What a board gives an area, for images of up to `image_bytes`.
constexpr std::size_t stored_area_bytes(StoreArea area, std::size_t image_bytes) {
  constexpr std::size_t kParameterBytes = 16384, kEventBytes = 65536;
  if (area == StoreArea::kImage0 || area == StoreArea::kImage1) return kStoredHeaderBytes + image_bytes;
  return area == StoreArea::kEventLog ? kEventBytes : kParameterBytes;
}

struct StoredHeader {
  std::uint32_t sequence = 0;
  std::uint32_t bytes = 0;
  std::uint32_t crc = 0;  // CRC-32C of the record
};

// kNoData unless there is a whole header, of a record that fits.
Status read_header(Store& store, StoreArea area, StoredHeader& header);
Status write_header(Store& store, StoreArea area, const StoredHeader& header);
Status clear_header(Store& store, StoreArea area);

// Bytes of the record, `offset` bytes behind its beginning. As the store's own.
Status read_record(Store& store, StoreArea area, std::size_t offset, Bytes out);
Status write_record(Store& store, StoreArea area, std::size_t offset, ConstBytes data);

// Which of two areas counts: 0 or 1, by header alone; kNone: neither was ever selected.
enum class Newer : std::uint8_t { kFirst = 0, kSecond = 1, kNone = 2 };
Newer newer_of(Store& store, StoreArea first, StoreArea second);
// The number after those of both.
std::uint32_t next_sequence(Store& store, StoreArea first, StoreArea second);

// A small record of a pair (parameters, causes of resets), whole: the newer one that is right goes to `out`, which it fills.
// kNoData: there is none. Loop bound: out.size().
Status load_record(Store& store, StoreArea first, StoreArea second, Bytes out);
// The older one is replaced by `data` (at most kMaxStoreWriteBytes), or the newer one where that is damaged, and read back. kNoData: the
// store could not be read, and nothing is replaced; or it has not kept the new one. Loop bound: the bytes of both.
Status save_record(Store& store, StoreArea first, StoreArea second, ConstBytes data);

}  // namespace lasso
