// The commands that are neither of modes nor of starting poses: each goes to who carries it out. Used by the acquisition thread.
#pragma once

#include <cstdint>

#include "fsw/core/time.hpp"
#include "fsw/exec/component_context.hpp"
#include "fsw/exec/image_service.hpp"
#include "fsw/exec/mode_manager.hpp"
#include "fsw/exec/parameter_service.hpp"
#include "fsw/link/commands.hpp"
#include "fsw/link/key_change.hpp"

namespace lasso {

class CommandServices {
 public:
  // What is given outlives it.
  CommandServices(AcquisitionTask& acquisition, const ComponentContext& context, ModeManager& modes, ParameterService& parameters,
                  ImageService& images)
      : acquisition_(acquisition), context_(context), modes_(modes), parameters_(parameters), images_(images) {}
  void use_authenticator(Authenticator& authenticator) { key_change_.use_authenticator(authenticator); }

  // Carries out a command, or says why not.
  ServiceRefusal serve(const Command& command, TimeUs now_us);
  // A frame ends: a key on trial for too long is given up.
  void pass_boundary();
  // The boundary's end: a reset that was commanded before is due.
  void end_boundary() { reset_due_ = reset_asked_; }
  bool reset_due() const { return reset_due_; }

 private:
  ServiceRefusal serve_structure(CommandKind kind, const StructureCommand& command);
  ServiceRefusal enable_event(std::uint16_t event, bool enabled);
  ServiceRefusal enable_laser();
  ServiceRefusal select_calibration(const CalibrationCommand& choice);
  ServiceRefusal change_key(std::uint32_t number);
  ServiceRefusal confirm_key(std::uint32_t number);
  ServiceRefusal report_stored(const StoredCommand& command, TimeUs now_us);
  void correlate_time(const TimeCommand& time);
  void report_disabled(TimeUs now_us);
  void send_pong(TimeUs now_us);
  void reset();

  AcquisitionTask& acquisition_;
  const ComponentContext& context_;
  ModeManager& modes_;
  ParameterService& parameters_;
  ImageService& images_;
  KeyChange key_change_;
  bool reset_asked_ = false, reset_due_ = false;
};

}  // namespace lasso
