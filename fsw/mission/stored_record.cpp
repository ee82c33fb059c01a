#include "fsw/mission/stored_record.hpp"

#include "fsw/core/byte_codec.hpp"
#include "fsw/core/crc.hpp"

namespace lasso {
namespace {

constexpr std::uint32_t kMagic = 0x334C5354;  // "3LST"
constexpr std::size_t kSummedBytes = 16;
constexpr std::size_t kPieceBytes = 256;

// Numbers wrap: the later of two is less than half of all before.
bool is_later(std::uint32_t a, std::uint32_t b) { return a - b < 1U << 31; }

std::uint32_t sequence_of(Store& store, StoreArea area) {
  StoredHeader header;
  return read_header(store, area, header) == Status::kOk ? header.sequence : 0;
}

// Whether the area holds a record that is right: its bytes are read in pieces.
bool is_right(Store& store, StoreArea area) {
  StoredHeader header;
  if (read_header(store, area, header) != Status::kOk || header.sequence == 0) return false;
  std::uint8_t piece[kPieceBytes] = {};
  std::uint32_t sum = 0;
  for (std::size_t at = 0; at < header.bytes; at += kPieceBytes) {
    const Bytes bytes = Bytes(piece).first(header.bytes - at < kPieceBytes ? header.bytes - at : kPieceBytes);
    if (read_record(store, area, at, bytes) != Status::kOk) return false;
    sum = crc32c(bytes, sum);
  }
  return sum == header.crc;
}

bool is_readable(Store& store, StoreArea area) {
  std::uint8_t byte = 0;
  return store.read(area, 0, Bytes(&byte, 1)) == Status::kOk;
}

Status load_from(Store& store, StoreArea area, Bytes out) {
  StoredHeader header;
  Status status = read_header(store, area, header);
  if (status == Status::kOk && (header.sequence == 0 || header.bytes != out.size())) status = Status::kNoData;
  if (status == Status::kOk) status = read_record(store, area, 0, out);
  if (status == Status::kOk && crc32c(out) != header.crc) status = Status::kBadCrc;
  return status;
}

}  // namespace

Status read_header(Store& store, StoreArea area, StoredHeader& header) {
  std::uint8_t bytes[kStoredHeaderBytes] = {};
  if (store.size(area) < kStoredHeaderBytes || store.read(area, 0, Bytes(bytes)) != Status::kOk) return Status::kNoData;
  ByteReader in{ConstBytes(bytes)};
  const std::uint32_t magic = in.u32();
  StoredHeader read;
  read.sequence = in.u32();
  read.bytes = in.u32();
  read.crc = in.u32();
  if (magic != kMagic || in.u32() != crc32c(ConstBytes(bytes).first(kSummedBytes))) return Status::kNoData;
  if (read.bytes > store.size(area) - kStoredHeaderBytes) return Status::kNoData;
  header = read;
  return Status::kOk;
}

Status write_header(Store& store, StoreArea area, const StoredHeader& header) {
  std::uint8_t bytes[kStoredHeaderBytes] = {};
  ByteWriter out{Bytes(bytes)};
  out.u32(kMagic);
  out.u32(header.sequence);
  out.u32(header.bytes);
  out.u32(header.crc);
  out.u32(crc32c(out.written()));
  return store.write(area, 0, ConstBytes(bytes));
}

Status clear_header(Store& store, StoreArea area) {
  const std::uint8_t bytes[kStoredHeaderBytes] = {};
  return store.write(area, 0, ConstBytes(bytes));
}

Status read_record(Store& store, StoreArea area, std::size_t offset, Bytes out) {
  return store.read(area, kStoredHeaderBytes + offset, out);
}

Status write_record(Store& store, StoreArea area, std::size_t offset, ConstBytes data) {
  return store.write(area, kStoredHeaderBytes + offset, data);
}

Newer newer_of(Store& store, StoreArea first, StoreArea second) {
  const std::uint32_t a = sequence_of(store, first), b = sequence_of(store, second);
  if (a == 0 && b == 0) return Newer::kNone;
  if (a == 0) return Newer::kSecond;
  return b == 0 || is_later(a, b) ? Newer::kFirst : Newer::kSecond;
}

std::uint32_t next_sequence(Store& store, StoreArea first, StoreArea second) {
  const Newer newer = newer_of(store, first, second);
  const std::uint32_t next = newer == Newer::kNone ? 1 : sequence_of(store, newer == Newer::kFirst ? first : second) + 1;
  return next == 0 ? 1 : next;
}

Status load_record(Store& store, StoreArea first, StoreArea second, Bytes out) {
  const bool second_first = newer_of(store, first, second) == Newer::kSecond;
  if (load_from(store, second_first ? second : first, out) == Status::kOk) return Status::kOk;
  return load_from(store, second_first ? first : second, out) == Status::kOk ? Status::kOk : Status::kNoData;
}

Status save_record(Store& store, StoreArea first, StoreArea second, ConstBytes data) {
  if (!is_readable(store, first) || !is_readable(store, second)) return Status::kNoData;
  const bool first_newer = newer_of(store, first, second) == Newer::kFirst;
  const bool newer_right = is_right(store, first_newer ? first : second);
  const StoreArea area = first_newer == newer_right ? second : first;
  const StoredHeader header{next_sequence(store, first, second), static_cast<std::uint32_t>(data.size()), crc32c(data)};
  Status status = clear_header(store, area);
  if (status == Status::kOk) status = write_record(store, area, 0, data);
  if (status == Status::kOk) status = write_header(store, area, header);
  if (status != Status::kOk) return status;
  const Newer saved = area == first ? Newer::kFirst : Newer::kSecond;
  return newer_of(store, first, second) == saved && is_right(store, area) ? Status::kOk : Status::kNoData;
}

}  // namespace lasso
