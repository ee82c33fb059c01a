// What the component watches of itself, and reports: faults by their table (faults.hpp), counters whose changes are events, and who has to
// check in before the watchdog is fed. Used by one thread.
#pragma once

#include <cstdint>

#include "fsw/exec/executive.hpp"
#include "fsw/exec/faults.hpp"
#include "fsw/exec/telemetry.hpp"
#include "fsw/exec/watchdog.hpp"
#include "fsw/link/health_report.hpp"
#include "fsw/mission/parameters.hpp"

namespace lasso {

class HealthMonitor {
 public:
  // Both outlive it.
  HealthMonitor(const Executive& executive, Telemetry& telemetry) : executive_(executive), telemetry_(telemetry) {}

  // The board's, which outlives it.
  void set_watchdog(Watchdog& watchdog) { watchdog_ = &watchdog; }
  void set_reset_cause(ResetCause cause) { health_.reset_cause = static_cast<std::uint8_t>(cause); }
  std::uint8_t reset_cause() const { return health_.reset_cause; }
  // The component begins: runs the self-tests.
  void begin();

  // A fault was seen since the last boundary, or not.
  void see(Fault fault, bool seen = true) { seen_.add(fault, seen); }
  void see(const FaultSet& faults) { seen_.add(faults); }
  void note_command() { silent_frames_ = 0; }
  void note_mode_repair() { ++health_.mode_repairs; }
  void note_clock_jump();
  void note_slot(std::uint32_t slot) { check_in_.slot(slot); }

  // A boundary: feeds the watchdog where all have checked in.
  void feed_watchdog(bool estimation_idle);
  // A boundary: what was seen goes through the table, what changes is reported, and the heaviest reaction to it is returned.
  FaultReaction answer_faults(const MissionParameters& parameters, TimeUs now_us);
  // The boundary's end: changes of counters that know no events. Bit i of `sensors_failed`: sensor i has failed. Loop bound: kMaxSensors.
  void tell_counters(std::uint8_t sensors_failed);

  const FaultMonitor& faults() const { return faults_; }

 private:
  // What was last seen of counters whose changes are events.
  struct Watched {
    std::uint32_t dropped_packets = 0;
    std::uint32_t slot_slips = 0;
    std::uint8_t sensors_failed = 0;
  };
  void see_states(const MissionParameters& parameters);
  void report(const FaultChanges& changes, TimeUs now_us);

  const Executive& executive_;
  Telemetry& telemetry_;
  FaultMonitor faults_;
  FaultSet seen_;  // since the last boundary
  Watchdog* watchdog_ = nullptr;
  CheckIn check_in_;
  HealthTelemetry health_;           // what only grows is kept in it
  std::uint32_t silent_frames_ = 0;  // since the last valid command
  Watched watched_;
};

}  // namespace lasso
