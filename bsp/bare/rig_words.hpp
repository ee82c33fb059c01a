// The test rig at the board's third port (docs/pil.md). After each slot the board says where it is, its time stands still, and the world
// around it moves on to the next slot: so the world's own speed cannot change a bit. Without a rig none of this happens.
//
// Words of 32 bits, highest byte first. The board says kRigWords of them (RigWord); the rig answers two: bytes that it has sent so far on
// the camera's and on the ground's line, all of which the board takes in before its time goes on. kStopBytes as the first is the end.
#pragma once

#include <cstdint>

namespace lasso::bare {

enum RigWord : std::uint32_t {
  kRigMagic = 0,      // kRigReport
  kRigKind,           // RigKind
  kRigTimeHigh,       // [us] of the slot that ended; of the first slot to come in kBegun
  kRigTimeLow,        //
  kRigCameraSent,     // bytes on its line so far
  kRigGroundSent,     //
  kRigSlot,           // number in its frame
  kRigSlotTicks,      // of the time base, that it took
  kRigEstimateTicks,  // of the estimate that ended since the last report; 0: none did
  kRigLateTicks,      // from the slot's time to its first instruction
  kRigIdleTicks,      // rested since the last report
  kRigRestarts,       // since power-on
  kRigCause,          // ResetCause of this start
  kRigVector,         // of the last exception
  kRigAddress,        // it was about
  kRigEstimateStack,  // most bytes that were ever used, since start-up was done
  kRigAcquireStack,   // ..., since the start
  kRigLostBytes,      // of both lines
  kRigMemory,         // of the component, bytes
  kRigLineTicks,      // taken by interrupts of camera's and ground's line since the last report
  kRigServicesCut,    // of both lines, which have left bytes for their bound
  kRigLinesMasked,    // interrupts of the lines that did not end, and were masked until the next slot
  kRigDropped,        // of telemetry, for which the ground's line had no room
  kRigBusyLateTicks,  // at worst since the last report, from a wake-up call's time to its first instruction while the lines were busy
  kRigWords
};
enum class RigKind : std::uint32_t { kBegun = 0, kSlot = 1 };
constexpr std::uint32_t kRigReport = 0x52494721;
constexpr std::uint32_t kStopBytes = 0xFFFFFFFF;

}  // namespace lasso::bare
