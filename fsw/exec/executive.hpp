// The cyclic executive: a frame is kSlotsPerFrame slots, and a table says which task runs in which slot. It keeps time and slips; it
// reads no clock.
#pragma once

#include <cstdint>

#include "fsw/core/span.hpp"
#include "fsw/core/status.hpp"
#include "fsw/core/time.hpp"
#include "fsw/core/voted.hpp"

namespace lasso {

constexpr std::uint32_t kSlotsPerFrame = 20;
constexpr DurationUs kLongestFrame_us = 4'000'000'000;
constexpr DurationUs kJumpUs = 10'000'000;  // less is lateness, which frames make up for

enum class TaskId : std::uint8_t { kPollSensor = 0, kPassBoundary = 1, kTendMemory = 2 };

// A row runs in the slots of a frame for which slot % period_slots == offset_slot. Rows of one slot run in the order of the table.
struct SlotRow {
  TaskId task;
  std::uint16_t period_slots;
  std::uint16_t offset_slot;
  DurationUs budget_us;  // processor time of one run on the flight card, for the timing analysis
  const char* name;
};
Span<const SlotRow> slot_table();
bool is_due(const SlotRow& row, std::uint32_t slot);

class Executive {
 public:
  // kBadValue unless every slot lasts at least 1 us, and the frame at most kLongestFrame_us.
  Status begin(TimeUs boundary_0_us, DurationUs period_us);
  bool begun() const { return period_us() > 0; }
  // Nobody has begun it: there are no slots yet. False, too, where its period is lost, which is not to pass for that.
  bool awaits_begin() const {
    std::uint32_t period_us = 0;
    return period_us_.get(period_us) && period_us == 0;
  }
  DurationUs slot_us() const { return period_us() / static_cast<DurationUs>(kSlotsPerFrame); }

  // Slot j of frame k begins at boundary_0 + k * period + j * period / kSlotsPerFrame, rounded down.
  TimeUs next_slot_us() const;
  TimeUs next_boundary_us() const { return slot_ == 0 ? boundary_us_ : boundary_us_ + period_us(); }
  std::uint32_t next_slot() const { return slot_; }  // 0: a boundary
  std::uint32_t frame() const { return frame_; }     // of the next slot; wraps

  // Has the clock jumped? It has when it is more than kJumpUs away from the next slot's time, before the first slot but ahead.
  bool jumped(TimeUs now_us) const;
  // The next slot is now, and the frames go on from there. Returns by how much they have been moved.
  DurationUs follow_jump(TimeUs now_us);
  // The next slot runs at now_us: accounts for its lateness. A slot that begins later than its own length has slipped.
  void note_start(TimeUs now_us);
  // The slot has run: on to the next one.
  void advance();

  std::uint32_t slips() const { return slips_; }
  DurationUs worst_lateness_us() const { return worst_lateness_us_; }

 private:
  // 0, and nothing runs any more, where no two copies agree.
  DurationUs period_us() const {
    std::uint32_t period_us = 0;
    static_cast<void>(period_us_.get(period_us));
    return period_us;
  }

  TimeUs boundary_us_ = 0;
  Voted<std::uint32_t> period_us_{0};  // slots, scrub and watchdog go by it
  std::uint32_t frame_ = 0;
  std::uint32_t slot_ = 0;
  std::uint32_t slips_ = 0;
  DurationUs worst_lateness_us_ = 0;
};

}  // namespace lasso
