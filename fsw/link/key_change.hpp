// Another key for commands, by a command (docs/decisions/keys-by-link.md). Its number comes over the link, never the key. Until a command
// of the new key confirms it, and for kKeyTrialFrames at most, commands of either key count, so that an operator whose new key is wrong
// still has the component. After these frames the new key is given up. Used by one thread.
#pragma once

#include <cstdint>

#include "fsw/core/authenticator.hpp"
#include "fsw/link/commands.hpp"

namespace lasso {

constexpr std::uint32_t kKeyTrialFrames = 300;  // 60 s at 5 frames a second

class KeyChange {
 public:
  // It outlives this. A trial that it knows of is over: the component has started anew.
  void use_authenticator(Authenticator& authenticator);

  // kNoSuchKey, kKeyOnTrial.
  ServiceRefusal begin(std::uint32_t number);
  // By the last command that was authentic. kNoKeyOnTrial, kNotByNewKey; kNotKept, and the trial goes on.
  ServiceRefusal confirm(std::uint32_t number);
  // A frame ends. True: the key on trial has just been given up.
  bool pass_boundary();

  std::uint32_t number() const { return number_; }  // of the last key on trial

 private:
  Authenticator* authenticator_ = nullptr;
  std::uint32_t number_ = 0;
  std::uint32_t frames_left_ = 0;  // of the trial; 0: there is none
};

}  // namespace lasso
