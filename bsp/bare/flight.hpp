// The executive of a bare board: two contexts on one processor. The foreground is the acquisition: the wake-up call of each slot, on a
// stack of its own, run to its end. The background is the estimation, and rest; the foreground interrupts it. (docs/decisions/
// bare-metal.md)
#pragma once

#include <cstdint>

#include "bsp/bare/clock.hpp"
#include "bsp/bare/fault.hpp"
#include "bsp/bare/latency_probe.hpp"
#include "bsp/bare/reset_wait.hpp"
#include "bsp/bare/rig.hpp"
#include "bsp/bare/serial_port.hpp"
#include "fsw/exec/component.hpp"
#include "fsw/exec/link_pump.hpp"
#include "hal_lcs/driver.hpp"

namespace lasso::bare {

// The ground's line, as the component's link: a stream.
class GroundLine final : public ByteLink {
 public:
  bool datagrams() const override { return false; }
  std::size_t read(Bytes bytes) override { return in.read(bytes); }
  std::size_t write(ConstBytes packets) override { return out.write(packets); }
  Ring in, out;
};

struct Lines {
  SerialPort &camera, &ground;
  GroundLine& ground_line;
};

class Flight final : public Watchdog {
 public:
  // The component has begun; boundary 0 is at `boundary_0_us`. `rig` may be null. All outlive this.
  Flight(Component& component, Clock& clock, const Lines& lines, Rig* rig);

  // The background; the first slot comes by itself. Only stop() of the rig ends it.
  void run();
  // The foreground, from the wake-up call. A second one before the first has ended: the slot hangs, the board restarts.
  void tick();
  // While the rig is awaited the wake-up call has the lines looked at, should an interrupt of theirs have gone astray.
  bool waiting() const { return waiting_; }
  static void wait_on();
  // A wake-up call at `now` was only to see how late it is.
  bool probed(std::uint64_t now) { return probe_.answers(now); }
  // Of the lines' interrupt: when it began, what camera and ground took of it; whether it does not end, and is masked until the next slot.
  void note_lines(std::uint64_t begun, std::uint64_t ticks, bool masked) {
    measured_.line_ticks = measured_.line_ticks + ticks;
    probe_.ask(begun);
    if (masked) measured_.lines_masked = measured_.lines_masked + 1;
  }

  void feed() override {
    unfed_slots_ = 0;
    if (++fed_frames_ == kSettledFrames) end_row_of_restarts();
  }

 private:
  static constexpr DurationUs kHungUs = 2'000'000;                   // a slot that takes longer hangs
  static constexpr std::uint32_t kUnfedSlots = 15 * kSlotsPerFrame;  // slots without feed(): estimation hangs
  static constexpr std::uint32_t kSettledFrames = 900;               // frames with feed(): the board does well, three minutes of 200 ms

  // What the rig is told of the slots and estimates.
  struct Measured {
    std::uint32_t slot = 0;
    std::uint64_t late_ticks = 0, slot_ticks = 0;
    volatile std::uint64_t foreground_ticks = 0, line_ticks = 0;  // counted by what interrupts their readers
    volatile std::uint32_t estimate_ticks = 0, idle_ticks = 0, lines_masked = 0;
    std::uint32_t packets_dropped = 0;
  };

  TimeUs time_of_slot() const;
  bool is_reset_now();
  void run_slot(TimeUs now_us);
  void send_telemetry();
  void let_world_move(RigKind kind, TimeUs t_us);
  void estimate();
  void rest();

  Component& component_;
  Clock& clock_;
  Lines lines_;
  Rig* rig_;
  LinkPump pump_;
  DurationUs slot_us_;
  volatile bool in_slot_ = false, stopped_ = false, waiting_ = false;
  ResetWait reset_wait_;
  LatencyProbe probe_;
  std::uint32_t unfed_slots_ = 0, fed_frames_ = 0;
  std::uint8_t telemetry_[kTelemetryQueueBytes] = {};
  Measured measured_;
};

}  // namespace lasso::bare
