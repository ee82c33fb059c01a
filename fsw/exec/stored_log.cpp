#include "fsw/exec/stored_log.hpp"

#include "fsw/core/byte_codec.hpp"
#include "fsw/core/crc.hpp"

namespace lasso {
namespace {

constexpr std::size_t kSummedBytes = StoredLog::kRecordBytes - 4;

// Numbers wrap: the later of two is less than half of all before.
bool is_later(std::uint32_t a, std::uint32_t b) { return a - b < 1U << 31; }

std::uint32_t after(std::uint32_t number) { return number + 1 == 0 ? 1 : number + 1; }

void encode(const StoredEvent& stored, Bytes out) {
  ByteWriter writer(out);
  writer.u32(stored.sequence);
  writer.u32(stored.start);
  writer.i64(stored.event.t_us);
  writer.u16(static_cast<std::uint16_t>(stored.event.id));
  writer.u8(static_cast<std::uint8_t>(stored.event.severity));
  writer.u8(stored.event.size);
  for (const std::uint8_t byte : stored.event.items) writer.u8(byte);
  while (writer.size() < kSummedBytes) writer.u8(0);
  writer.u32(crc32c(writer.written()));
}

bool decode(ConstBytes bytes, StoredEvent& out) {
  ByteReader reader(bytes);
  StoredEvent stored;
  stored.sequence = reader.u32();
  stored.start = reader.u32();
  stored.event.t_us = reader.i64();
  stored.event.id = static_cast<EventId>(reader.u16());
  stored.event.severity = static_cast<Severity>(reader.u8());
  stored.event.size = reader.u8();
  for (std::uint8_t& byte : stored.event.items) byte = reader.u8();
  const bool right = ByteReader(bytes.subspan(kSummedBytes, 4)).u32() == crc32c(bytes.first(kSummedBytes));
  if (!right || stored.sequence == 0 || stored.event.size > kMaxEventBytes) return false;
  out = stored;
  return true;
}

}  // namespace

std::size_t StoredLog::records() const {
  const std::size_t fit = store_->size(StoreArea::kEventLog) / kRecordBytes;
  return fit < kMaxRecords ? fit : kMaxRecords;
}

std::size_t StoredLog::place_of(std::uint32_t sequence) const { return sequence % records(); }

bool StoredLog::read_place(std::size_t place, StoredEvent& out) const {
  std::uint8_t bytes[kRecordBytes] = {};
  return store_->read(StoreArea::kEventLog, place * kRecordBytes, Bytes(bytes)) == Status::kOk && decode(ConstBytes(bytes), out);
}

void StoredLog::use(Store& store) {
  store_ = &store;
  if (records() == 0) {
    store_ = nullptr;
    return;
  }
  StoredEvent newest, found;
  for (std::size_t place = 0; place < records(); ++place) {
    if (read_place(place, found) && (newest.sequence == 0 || is_later(found.sequence, newest.sequence))) newest = found;
  }
  sequence_ = newest.sequence;
  start_ = after(newest.start);
}

bool StoredLog::is_kept(const EventRecord& event) {
  switch (event.id) {
    case EventId::kBegun:
    case EventId::kModeChanged:
    case EventId::kLaserEnabled:
    case EventId::kLaserInhibited:
    case EventId::kTimeCorrelated:
    case EventId::kImageReady:
    case EventId::kImageRefused:
    case EventId::kImageActive:
    case EventId::kImageConfirmed:
    case EventId::kFaultCleared:
    case EventId::kParameterChanged:
    case EventId::kParametersReverted:
    case EventId::kParametersRepaired:
    case EventId::kParametersSaved:
    case EventId::kParametersRestored:
    case EventId::kResetCommanded:
      return true;
    default:
      return event.severity >= Severity::kMedium;
  }
}

void StoredLog::note(const EventRecord& event) {
  if (store_ == nullptr || !is_kept(event)) return;
  if (waiting_.full()) {
    ++lost_;
    return;
  }
  sequence_ = after(sequence_);
  invariant(waiting_.push_back(StoredEvent{sequence_, start_, event}), "room for a record");
}

void StoredLog::step() {
  if (written_ == waiting_.size()) return;
  std::uint8_t bytes[kRecordBytes] = {};
  const StoredEvent& stored = waiting_.span()[written_];
  encode(stored, Bytes(bytes));
  if (store_->write(StoreArea::kEventLog, place_of(stored.sequence) * kRecordBytes, ConstBytes(bytes)) != Status::kOk) ++lost_;
  if (++written_ < waiting_.size()) return;
  waiting_.clear();
  written_ = 0;
}

bool StoredLog::read(std::uint32_t sequence, StoredEvent& out) const {
  StoredEvent found;
  if (store_ == nullptr || sequence == 0 || !read_place(place_of(sequence), found) || found.sequence != sequence) return false;
  out = found;
  return true;
}

}  // namespace lasso
