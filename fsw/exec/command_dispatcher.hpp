// Bytes from the ground become commands that are carried out and answered, as far as a frame has room for them (fsw/link/frame_room.hpp).
// Used by the acquisition thread.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/span.hpp"
#include "fsw/core/time.hpp"
#include "fsw/exec/command_services.hpp"
#include "fsw/exec/component_context.hpp"
#include "fsw/exec/mode_manager.hpp"
#include "fsw/link/command_receiver.hpp"
#include "fsw/link/frame_room.hpp"
#include "fsw/link/link_report.hpp"

namespace lasso {

class CommandDispatcher {
 public:
  // Commands to the component `apid`. What is given outlives it.
  CommandDispatcher(std::uint16_t apid, const ComponentContext& context, ModeManager& modes, CommandServices& commands)
      : apid_(apid), context_(context), modes_(modes), commands_(commands), receiver_(apid) {}
  void use_authenticator(Authenticator& authenticator) { receiver_.use_authenticator(authenticator); }

  // See the functions of the same name of Component.
  std::size_t receive(ConstBytes bytes, TimeUs now_us);
  bool receive_packet(ConstBytes packet, TimeUs now_us) { return answer_if_room(packet, now_us); }
  bool heard_operator() const { return receiver_.from_operator(); }

  // Something that the structure `link` states has changed.
  void note_change() { changed_ = true; }
  // A boundary: what waited for this frame is answered, arms and keys grow older, and the structure `link` is sent when it is due.
  void pass_boundary(TimeUs now_us);

 private:
  bool answer_if_room(ConstBytes packet, TimeUs now_us);
  void answer(ConstBytes packet, TimeUs now_us);
  void accept(const Command& command, Verification& verification, TimeUs now_us);
  void carry_out(const Command& command, Verification& verification, TimeUs now_us);
  void verify(std::uint8_t subservice, const Verification& verification, TimeUs now_us);
  void refuse(const Verification& verification, bool answered, TimeUs now_us);
  void fail(const Command& command, const Verification& verification, TimeUs now_us);
  void answer_waiting(TimeUs now_us);
  void send_link(TimeUs now_us);

  const std::uint16_t apid_;
  const ComponentContext& context_;
  ModeManager& modes_;
  CommandServices& commands_;
  CommandReceiver receiver_;
  FrameRoom room_;
  bool bytes_came_ = false;    // since the last boundary
  bool changed_ = false;       // since the structure `link` was sent
  bool packet_waits_ = false;  // the receiver's, for the next frame
  std::uint32_t reported_skipped_ = 0;
};

}  // namespace lasso
