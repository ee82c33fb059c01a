#include "fsw/exec/interlocks.hpp"

namespace lasso {

ServiceRefusal Interlocks::arm(const CommandName& name) {
  if (!is_hazardous(name)) return ServiceRefusal::kNotHazardous;
  arming_.arm(name);
  telemetry_.raise<EventId::kCommandArmed>(name.service, name.subservice, name.number);
  return ServiceRefusal::kNone;
}

bool Interlocks::pass_boundary() {
  if (!arming_.pass_boundary()) return false;
  telemetry_.raise<EventId::kArmExpired>(arming_.name().service, arming_.name().subservice, arming_.name().number);
  return true;
}

void Interlocks::enable_laser() {
  acquisition_.permit_laser(true);
  laser_.set(1);
  telemetry_.raise<EventId::kLaserEnabled>();
}

void Interlocks::inhibit_laser() {
  arming_.disarm();
  acquisition_.permit_laser(false);
  if (laser_enabled()) telemetry_.raise<EventId::kLaserInhibited>();
  laser_.set(0);
}

bool Interlocks::laser_enabled() const {
  std::uint8_t enabled = 0;
  return laser_.get(enabled) && enabled != 0;
}

bool Interlocks::check_laser() {
  if (laser_.agreed()) return true;
  if (laser_enabled()) {
    laser_.set(1);
  } else {
    inhibit_laser();
  }
  return false;
}

}  // namespace lasso
