// The event log that survives a restart: a ring of records of 64 bytes in the store's event area, the oldest of which is replaced. What
// decides poses or configuration, or needs somebody, is kept (is_kept); what a flood of commands could fill it with is not. A record is
// written by one call of the store, and one that a loss of power cut short does not pass its checksum: it is a gap in the ring.
//
//   0  sequence number, from 1   4  number of the start that it belongs to, from 1   8  time [us]   16  event   18  severity   19  bytes of
//   its items   20  items   56  zeros   60  CRC-32C of the 60 bytes before
#pragma once

#include "fsw/core/fixed_vector.hpp"
#include "fsw/link/events.hpp"
#include "fsw/mission/store.hpp"

namespace lasso {

struct StoredEvent {
  std::uint32_t sequence = 0;  // 0: none
  std::uint32_t start = 0;
  EventRecord event;
};

class StoredLog {
 public:
  // Finds where the ring ends. What was reported before waits in `store` for a reader. Loop bound: the records of the area.
  void use(Store& store);
  bool in_use() const { return store_ != nullptr; }

  static bool is_kept(const EventRecord& event);
  // Keeps it, if it is to be; what does not find room is counted.
  void note(const EventRecord& event);
  // One slot's share: writes one record.
  void step();

  std::uint32_t sequence() const { return sequence_; }  // of the last record that was noted
  std::uint32_t start() const { return start_; }        // the number of this one
  std::uint32_t lost() const { return lost_; }          // noted, and not written
  // False: it was never written, or was replaced, or is damaged.
  bool read(std::uint32_t sequence, StoredEvent& out) const;

  static constexpr std::size_t kRecordBytes = 64;
  static constexpr std::size_t kMaxRecords = 1024;

 private:
  static constexpr std::size_t kWaiting = 32;
  std::size_t records() const;
  std::size_t place_of(std::uint32_t sequence) const;
  bool read_place(std::size_t place, StoredEvent& out) const;

  Store* store_ = nullptr;
  std::uint32_t sequence_ = 0, start_ = 1, lost_ = 0;
  FixedVector<StoredEvent, kWaiting> waiting_;
  std::size_t written_ = 0;  // of those that wait
};

}  // namespace lasso
