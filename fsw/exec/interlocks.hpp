// What stands before hazardous acts: a hazardous command needs an `arm` before it, and the laser a command that enables it. Used by one
// thread.
#pragma once

#include <cstdint>

#include "fsw/core/voted.hpp"
#include "fsw/exec/acquisition_task.hpp"
#include "fsw/exec/telemetry.hpp"
#include "fsw/link/arming.hpp"
#include "fsw/link/commands.hpp"

namespace lasso {

class Interlocks {
 public:
  // Both outlive it.
  Interlocks(AcquisitionTask& acquisition, Telemetry& telemetry) : acquisition_(acquisition), telemetry_(telemetry) {}

  // A command has come. May it be carried out? A hazardous one uses up what armed it.
  bool may_carry_out(const Command& command) { return command.hazard == Hazard::kNone || arming_.fire(command.name, command.hazard); }
  // kNotHazardous: the command that is named needs no arm.
  ServiceRefusal arm(const CommandName& name);
  bool armed() const { return arming_.armed(); }
  // A frame ends. True: what was armed has just expired.
  bool pass_boundary();

  // Every sensor is permitted to light its laser, and an event says so. Who may ask for it is the caller's to know.
  void enable_laser();
  // Every sensor is inhibited at once, and nothing stays armed: it may be the laser's enabling that is. An event, unless it was inhibited.
  void inhibit_laser();
  // A permission that no two of its copies state is none.
  bool laser_enabled() const;
  // A boundary, before anybody asks for the permission: do its copies agree? False: they have been made alike, and where no two agreed the
  // laser is inhibited, without an event but that of the caller's fault.
  bool check_laser();

 private:
  AcquisitionTask& acquisition_;
  Telemetry& telemetry_;
  Arming arming_;
  Voted<std::uint8_t> laser_{0};  // 1: a command has enabled it, and none has inhibited it since
};

}  // namespace lasso
