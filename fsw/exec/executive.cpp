#include "fsw/exec/executive.hpp"

namespace lasso {
namespace {

// clang-format off
constexpr SlotRow kSlotTable[] = {
  // A boundary's poll comes before its hand-over: the last samples of the scan that ends belong to it.
  {TaskId::kPollSensor,   1,              0, 1500, "poll sensor"},
  {TaskId::kPassBoundary, kSlotsPerFrame, 0, 4000, "publish, hand over, plan"},
  {TaskId::kTendMemory,   1,              0, 2500, "scrub, take in an image"},
};
// clang-format on

}  // namespace

Span<const SlotRow> slot_table() { return Span<const SlotRow>(kSlotTable); }

bool is_due(const SlotRow& row, std::uint32_t slot) { return slot % row.period_slots == row.offset_slot; }

Status Executive::begin(TimeUs boundary_0_us, DurationUs period_us) {
  if (period_us < static_cast<DurationUs>(kSlotsPerFrame) || period_us > kLongestFrame_us) return Status::kBadValue;
  boundary_us_ = boundary_0_us;
  period_us_.set(static_cast<std::uint32_t>(period_us));
  return Status::kOk;
}

TimeUs Executive::next_slot_us() const {
  return boundary_us_ + period_us() * static_cast<DurationUs>(slot_) / static_cast<DurationUs>(kSlotsPerFrame);
}

bool Executive::jumped(TimeUs now_us) const {
  const DurationUs off_us = now_us - next_slot_us();
  const bool first = frame_ == 0 && slot_ == 0;
  return off_us > kJumpUs || (off_us < -kJumpUs && !first);
}

DurationUs Executive::follow_jump(TimeUs now_us) {
  const DurationUs moved_us = now_us - next_slot_us();
  boundary_us_ += moved_us;
  return moved_us;
}

void Executive::note_start(TimeUs now_us) {
  const DurationUs late_us = now_us - next_slot_us();
  if (late_us > worst_lateness_us_) worst_lateness_us_ = late_us;
  if (late_us > slot_us()) ++slips_;
}

void Executive::advance() {
  if (++slot_ < kSlotsPerFrame) return;
  slot_ = 0;
  ++frame_;
  boundary_us_ += period_us();
  period_us_.set(static_cast<std::uint32_t>(period_us()));  // a copy that differed
}

}  // namespace lasso
