#include "bsp/bare/flight.hpp"

#include "bsp/bare/cpu.hpp"
#include "bsp/bare/fault.hpp"

extern "C" {
extern std::uint32_t board_estimation_stack_begin[], board_estimation_stack_end[];
extern std::uint32_t board_acquisition_stack_begin[], board_acquisition_stack_end[];
// For tests of the board's answers to faults, which link it (ft/pil/planted.cpp). The flight image has none.
[[gnu::weak]] void board_probe(std::uint32_t slots);
}

namespace lasso::bare {
namespace {

constexpr std::uint32_t kLookTicks = 1 << 20;  // between two looks at the lines while the rig is awaited
constexpr std::uint32_t kPaint = 0xA5C3965A;   // of start-up

std::uint32_t used(const std::uint32_t* begin, const std::uint32_t* end) {
  const std::uint32_t* at = begin;
  while (at < end && *at == kPaint) ++at;
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(end) - reinterpret_cast<std::uintptr_t>(at));
}

// What start-up has used counts no more. Nothing lives below the caller's frame, as interrupts, which may save a few words there, are
// forbidden.
void paint_estimation_stack() {
  const volatile std::uint32_t* const end = static_cast<std::uint32_t*>(__builtin_frame_address(0));
  for (volatile std::uint32_t* at = board_estimation_stack_begin; at < end; ++at) *at = kPaint;
}

}  // namespace

Flight::Flight(Component& component, Clock& clock, const Lines& lines, Rig* rig)
    : component_(component),
      clock_(clock),
      lines_(lines),
      rig_(rig),
      pump_(component, lines.ground_line),
      slot_us_(static_cast<DurationUs>(component.mission().parameters.period_s * 1e6 + 0.5) / kSlotsPerFrame) {
  component.set_watchdog(*this);
}

// --- foreground

// By the board's ticks: a slot that begins within its own length begins at its time.
TimeUs Flight::time_of_slot() const {
  const TimeUs now_us = clock_.now_us(), slot_us = component_.next_slot_us();
  return now_us >= slot_us && now_us - slot_us < slot_us_ ? slot_us : now_us;
}

void Flight::tick() {
  if (in_slot_) restart(ResetCause::kWatchdog, "a slot hangs");
  if (++unfed_slots_ > kUnfedSlots) restart(ResetCause::kWatchdog, "the watchdog was not fed");
  in_slot_ = true;
  wake_in(static_cast<std::uint32_t>(clock_.ticks_in(kHungUs)));
  const std::uint64_t begun = clock_.ticks();
  measured_.late_ticks = begun - clock_.ticks_at(component_.next_slot_us());
  lines_.camera.look();  // an interrupt of theirs that went astray costs a slot, not the line
  lines_.ground.look();
  allow_interrupts();
  const TimeUs now_us = time_of_slot();
  run_slot(now_us);
  measured_.slot_ticks = clock_.ticks() - begun;
  measured_.foreground_ticks = measured_.foreground_ticks + measured_.slot_ticks;
  let_world_move(RigKind::kSlot, now_us);
  forbid_interrupts();
  if (is_reset_now()) restart(ResetCause::kCommanded, "the command reset");
  in_slot_ = false;
  clock_.wake_at(component_.next_slot_us());
}

// The frame's telemetry, which reports it, goes to the ground first, as far as the line takes it in time.
bool Flight::is_reset_now() {
  return component_.next_slot_is_boundary() && reset_wait_.over(component_.reset_due(), lines_.ground.all_sent());
}

void Flight::run_slot(TimeUs now_us) {
  measured_.slot = component_.next_slot_is_boundary() ? 0 : measured_.slot + 1;
  pump_.receive(now_us);
  component_.run_slot(now_us);
  if (board_probe != nullptr) board_probe(measured_.slot);
  if (component_.next_slot_is_boundary()) send_telemetry();
}

// What the line does not take is lost, and counted: a ground station that does not listen must not stop the flight.
void Flight::send_telemetry() {
  ConstBytes rest(telemetry_, component_.take_telemetry(Bytes(telemetry_)));
  for (std::size_t size = packet_size(rest); size > 0; size = packet_size(rest)) {
    const bool fits = lines_.ground_line.out.room() >= size;
    if (fits) static_cast<void>(lines_.ground_line.write(rest.first(size)));
    if (!fits) ++measured_.packets_dropped;
    rest = rest.subspan(size, rest.size() - size);
  }
}

void Flight::let_world_move(RigKind kind, TimeUs t_us) {
  if (rig_ == nullptr) {
    lines_.camera.send();
    lines_.ground.send();
    return;
  }
  clock_.stop();
  waiting_ = true;
  wait_on();
  probe_.begin();
  lines_.camera.send();
  lines_.ground.send();
  rest_until([&] { return lines_.camera.all_sent() && lines_.ground.all_sent(); });
  const FaultRecord& fault = fault_record();
  std::uint32_t words[kRigWords] = {};
  words[kRigMagic] = kRigReport;
  words[kRigKind] = static_cast<std::uint32_t>(kind);
  words[kRigTimeHigh] = static_cast<std::uint32_t>(t_us >> 32);
  words[kRigTimeLow] = static_cast<std::uint32_t>(t_us);
  words[kRigCameraSent] = lines_.camera.sent();
  words[kRigGroundSent] = lines_.ground.sent();
  words[kRigSlot] = measured_.slot;
  words[kRigSlotTicks] = static_cast<std::uint32_t>(measured_.slot_ticks);
  words[kRigEstimateTicks] = measured_.estimate_ticks;
  words[kRigLateTicks] = static_cast<std::uint32_t>(measured_.late_ticks);
  words[kRigIdleTicks] = measured_.idle_ticks;
  words[kRigRestarts] = fault.restarts;
  words[kRigCause] = fault.cause;
  words[kRigVector] = fault.registers.vector;
  words[kRigAddress] = fault_address(fault.registers);
  if (measured_.slot == 0) {
    words[kRigEstimateStack] = used(board_estimation_stack_begin, board_estimation_stack_end);
    words[kRigAcquireStack] = used(board_acquisition_stack_begin, board_acquisition_stack_end);
  }
  words[kRigLostBytes] = lines_.camera.lost() + lines_.ground.lost();
  words[kRigMemory] = sizeof(Component);
  words[kRigLineTicks] = static_cast<std::uint32_t>(measured_.line_ticks);
  words[kRigServicesCut] = lines_.camera.cut() + lines_.ground.cut();
  words[kRigLinesMasked] = measured_.lines_masked;
  words[kRigDropped] = measured_.packets_dropped;
  words[kRigBusyLateTicks] = probe_.take_worst();
  measured_.estimate_ticks = measured_.idle_ticks = 0;
  measured_.line_ticks = 0;
  const RigAnswer answer = rig_->report(words);
  stopped_ = answer.stop();
  rest_until(
      [&] { return stopped_ || (lines_.camera.received() == answer.camera_bytes && lines_.ground.received() == answer.ground_bytes); });
  probe_.end();
  wake_in(kMostWakeTicks);
  waiting_ = false;
  clock_.go_on();
}

void Flight::wait_on() { wake_in(kLookTicks); }

// --- background

void Flight::run() {
  paint_estimation_stack();
  waiting_ = true;  // a wake-up call that came due in the life before may still be served: it is no slot of this one
  allow_interrupts();
  let_world_move(RigKind::kBegun, component_.next_slot_us());
  forbid_interrupts();
  waiting_ = false;
  clock_.wake_at(component_.next_slot_us());
  allow_interrupts();
  while (!stopped_) {
    if (component_.estimation_pending()) estimate();
    rest();
  }
  forbid_interrupts();
}

void Flight::estimate() {
  forbid_interrupts();
  const std::uint64_t begun = clock_.ticks(), elsewhere = measured_.foreground_ticks;
  allow_interrupts();
  component_.run_estimation();
  forbid_interrupts();
  const std::uint64_t taken = clock_.ticks() - begun - (measured_.foreground_ticks - elsewhere);
  measured_.estimate_ticks = static_cast<std::uint32_t>(taken);
  allow_interrupts();
}

// An interrupt that comes between the question and the rest ends the rest at once. With a rig, which moves the world from slot to slot,
// rest takes no time of the emulator's: the clock skips it.
void Flight::rest() {
  forbid_interrupts();
  if (component_.estimation_pending() || stopped_) return allow_interrupts();
  if (rig_ != nullptr) {
    measured_.idle_ticks = measured_.idle_ticks + static_cast<std::uint32_t>(clock_.skip_to(component_.next_slot_us()));
    clock_.wake_at(component_.next_slot_us());
    return allow_interrupts();
  }
  bare::rest();
}

}  // namespace lasso::bare
