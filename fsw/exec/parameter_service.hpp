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

  // The commands of service 20, and those that save; parameters by their id, values in the unit of their row. What is refused changes
  // nothing.
  // From the next boundary on: kNoSuchParameter, kFixedParameter, kOutOfLimits, kInconsistent (with the others as they are then).
  ServiceRefusal set(const ParameterCommand& command);
  // Sends the value that holds from the next boundary on, and the image's own: kNoSuchParameter.
  ServiceRefusal report(std::uint16_t parameter, TimeUs now_us);
  // From the next boundary on all values are the image's.
  void revert();
  // All changes become one record of the store: kNoStore, kStoreFailed.
  ServiceRefusal save();
  // That record takes the place of all changes: kNoStore, kNothingStored, and ParameterArea::restore()'s. Where there is a record, an event
  // says what became of it.
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
