// The rows of service 6 and of mission images in flight, in the order of the wire. For the ground: see row.hpp.
#pragma once

#include "fsw/link/choices.hpp"
#include "fsw/link/memory_report.hpp"
#include "fsw/link/row.hpp"

namespace lasso::memory_rows {

using I = ImageTelemetry;
inline constexpr Range kOneBlock{1, static_cast<double>(kMemoryBlockBytes)};

// clang-format off
inline constexpr TypedRow<ImageCommand> kBegin[] = {
  make_row<&ImageCommand::bytes>(1, "bytes", "1", kAny, "length of the image"),
  make_row<&ImageCommand::crc>(2, "crc", "1", kAny, "its last four bytes, before its signature: CRC-32C of all before them"),
};
inline constexpr TypedRow<ImageCommand> kActivate[] = {
  make_row<&ImageCommand::crc>(1, "crc", "1", kAny, "CRC-32C of the image that is meant"),
};
inline constexpr TypedRow<LoadCommand> kLoad[] = {
  make_row<&LoadCommand::area>(1, "area", kMemoryArea, "other_image; the others are not written to"),
  make_row<&LoadCommand::offset>(2, "offset", "1", kAny, "of the first byte, a multiple of 128"),
  make_row<&LoadCommand::bytes>(3, "bytes", "1", kOneBlock, "that count of data; 128, or up to the end of the image"),
  make_row<&LoadCommand::data>(4, "data", "1", kAny, "the bytes, then zeros"),
};
inline constexpr TypedRow<MemoryCommand> kRange[] = {
  make_row<&MemoryCommand::area>(1, "area", kMemoryArea, "where"),
  make_row<&MemoryCommand::offset>(2, "offset", "1", kAny, "of the first byte"),
  make_row<&MemoryCommand::bytes>(3, "bytes", "1", kAny, "how many; a dump at most 128, a check at most 16384"),
};
inline constexpr TypedRow<LoadCommand> kDumped[] = {
  make_row<&LoadCommand::area>(1, "area", kMemoryArea, "where"),
  make_row<&LoadCommand::offset>(2, "offset", "1", kAny, "of the first byte"),
  make_row<&LoadCommand::bytes>(3, "bytes", "1", kAny, "that count of data"),
  make_row<&LoadCommand::data>(4, "data", "1", kAny, "the bytes, then zeros"),
};
inline constexpr TypedRow<MemorySum> kChecked[] = {
  make_row<&MemorySum::area>(1, "area", kMemoryArea, "where"),
  make_row<&MemorySum::offset>(2, "offset", "1", kAny, "of the first byte"),
  make_row<&MemorySum::bytes>(3, "bytes", "1", kAny, "how many"),
  make_row<&MemorySum::crc>(4, "crc", "1", kAny, "CRC-32C of them"),
};
inline constexpr TypedRow<I> kImage[] = {
  make_row<&I::active_crc>(1, "active_crc", "1", kAny, "CRC-32C of the active image as received"),
  make_row<&I::active_buffer>(2, "active_buffer", "1", kAny, "the buffer, 0 or 1, that it lies in"),
  make_row<&I::confirmed>(3, "confirmed", kYesNo, "it has given valid poses, or was trusted"),
  make_row<&I::active_stored>(4, "active_stored", kYesNo, "it is in the store: what decays in memory can be repaired"),
  make_row<&I::other_state>(5, "other_state", kImageState, "what becomes of the image in the other buffer"),
  make_row<&I::other_bytes>(6, "other_bytes", "1", kAny, "its length"),
  make_row<&I::other_crc>(7, "other_crc", "1", kAny, "its CRC-32C, as announced"),
  make_row<&I::other_stored>(8, "other_stored", kYesNo, "it is in the store"),
  make_row<&I::blocks>(9, "blocks", "1", kAny, "of 128 bytes, that it has"),
  make_row<&I::loaded>(10, "loaded", "1", kAny, "of them, those that have come"),
  make_row<&I::missing_first>(11, "missing_first", "1", kAny, "where the first gaps begin, in blocks"),
  make_row<&I::missing_blocks>(12, "missing_blocks", "1", kAny, "how many blocks each of them has; 0: there is no such gap"),
  make_row<&I::status>(13, "status", kStatus, "what is wrong with it"),
  make_row<&I::table>(14, "table", "1", kAny, "in which table"),
  make_row<&I::record>(15, "record", "1", kAny, "and record"),
  make_row<&I::activations>(16, "activations", "1", kAny, "times that another image became active"),
  make_row<&I::roll_backs>(17, "roll_backs", "1", kAny, "of them, to the image before"),
  make_row<&I::scrub_passes>(18, "scrub_passes", "1", kAny, "times that all of the protected memory was looked at"),
  make_row<&I::scrub_pass_us>(19, "scrub_pass_us", "us", kAny, "how long the last one took"),
  make_row<&I::findings>(20, "findings", "1", kAny, "chunks that were found changed"),
  make_row<&I::repairs>(21, "repairs", "1", kAny, "of them, those that are right again"),
};
// clang-format on

}  // namespace lasso::memory_rows
