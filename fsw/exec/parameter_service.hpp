// Parameters that are changed in flight (fsw/mission/parameter_area.hpp): by commands, and taken from the board's store at the start. Used
// by one thread.
#pragma once

#include <cstdint>

#include "fsw/exec/health_monitor.hpp"
#include "fsw/exec/telemetry.hpp"
#include "fsw/link/commands.hpp"
#include "fsw/mission/image_keeper.hpp"
#include "fsw/mission/parameter_area.hpp"
#include "fsw/mission/store.hpp"

namespace lasso {

class ParameterService {
 public:
  // What is given outlives it.
  ParameterService(ImageKeeper& images, Telemetry& telemetry, HealthMonitor& health);
  // The board's, which outlives it.
  void use_store(Store& store) { store_ = &store; }

  // The commands of service 20, and those that save.
  ServiceRefusal set(const ParameterCommand& command);
  ServiceRefusal report(std::uint16_t parameter, TimeUs now_us);
  void revert();
  ServiceRefusal save();
  // Reported where something was saved, whether it holds or not.
  ServiceRefusal restore();

  // The active image is another one, or was repaired: what was changed has to be made of it anew.
  void make_anew() { due_ = true; }
  // A boundary, in this order. Before anybody uses the changes: compares their copies. What was made of a copy that was wrong is made
  // again.
  void check();
  // An estimate that is late reads what would be written: the change waits for it.
  void apply(bool estimation_idle);

 private:
  MissionParameters parameters_now() const;

  ImageKeeper& images_;
  Telemetry& telemetry_;
  HealthMonitor& health_;
  ParameterArea area_;
  bool due_ = false;        // for the next boundary
  Store* store_ = nullptr;  // the board's, if it has one
};

}  // namespace lasso
