#include "fsw/exec/faults.hpp"

namespace lasso {
namespace {

using F = Fault;
using R = FaultReaction;

// clang-format off
constexpr FaultRow kTable[] = {
  //                    confirm clear
  {F::kSensorSilent,      2,  5, R::kReport},
  {F::kSensorLate,        2,  5, R::kReport},
  {F::kSensorCorrupt,     2,  5, R::kReport},
  {F::kSensorStuck,       2,  5, R::kReport},
  {F::kSensorSaturated,   2,  5, R::kReport},
  {F::kScanIncomplete,    1,  5, R::kReport},
  {F::kEstimateOverrun,   1,  5, R::kReport},
  {F::kSlotSlip,          1, 250, R::kReport},  // a processor that is now and then late is reported once
  {F::kTimeJump,          1,  1, R::kReacquire},
  {F::kImplausiblePose,   1,  5, R::kReport},
  {F::kFilterDivergence,  3,  5, R::kReacquire},
  {F::kModeCorrupt,       1,  1, R::kReport},
  {F::kModeLost,          1,  1, R::kMakeSafe},
  {F::kImageCorrupt,      1,  1, R::kReport},
  {F::kImageLost,         1,  1, R::kMakeSafe},
  {F::kParametersCorrupt, 1,  1, R::kReport},
  {F::kParametersLost,    1,  1, R::kMakeSafe},
  {F::kCodeCorrupt,       1,  0, R::kReport},
  {F::kLinkSilent,        1,  1, R::kReport},
  {F::kMemoryHigh,        1, 25, R::kReport},
  {F::kWatchdogReset,     1,  0, R::kMakeSafe},
  {F::kSelfTestFailed,    1,  0, R::kMakeSafe},
  {F::kLaserCorrupt,      1,  1, R::kReport},
};
// clang-format on
static_assert(sizeof(kTable) / sizeof(kTable[0]) == kFaults, "a row a fault");

}  // namespace

Span<const FaultRow> fault_table() { return Span<const FaultRow>(kTable); }

const char* to_string(FaultReaction reaction) {
  static constexpr const char* kNames[] = {"report", "reacquire", "make_safe"};
  const auto index = static_cast<std::size_t>(reaction);
  return index < sizeof(kNames) / sizeof(kNames[0]) ? kNames[index] : "unknown";
}

FaultChanges FaultMonitor::step(const FaultSet& seen) {
  FaultChanges changes;
  for (const FaultRow& row : fault_table()) {
    std::uint8_t& frames = Span<std::uint8_t>(frames_)[static_cast<std::size_t>(row.fault)];
    const bool active = active_.has(row.fault);
    frames = seen.has(row.fault) != active ? static_cast<std::uint8_t>(frames + 1) : std::uint8_t{0};
    const std::uint8_t enough = active ? row.clear_frames : row.confirm_frames;
    if (enough == 0 || frames < enough) continue;  // a flipped bit of the count does not put the fault off
    frames = 0;
    if (active) clear(row, changes);
    if (!active) confirm(row, changes);
  }
  return changes;
}

void FaultMonitor::confirm(const FaultRow& row, FaultChanges& changes) {
  changes.confirmed.add(row.fault);
  if (row.reaction > changes.reaction) changes.reaction = row.reaction;
  active_.add(row.fault);
  ever_.add(row.fault);
  ++confirmations_;
}

void FaultMonitor::clear(const FaultRow& row, FaultChanges& changes) {
  changes.cleared.add(row.fault);
  active_.remove(row.fault);
}

}  // namespace lasso
