#include "fsw/link/key_change.hpp"

namespace lasso {

void KeyChange::use_authenticator(Authenticator& authenticator) {
  authenticator_ = &authenticator;
  authenticator.end_key_trial(false);
  open_ = false;
}

ServiceRefusal KeyChange::begin(std::uint32_t number) {
  if (open_) return ServiceRefusal::kKeyOnTrial;
  if (authenticator_ == nullptr || !authenticator_->try_key(number)) return ServiceRefusal::kNoSuchKey;
  number_ = number;
  open_ = true;
  frames_left_ = kKeyTrialFrames;
  return ServiceRefusal::kNone;
}

ServiceRefusal KeyChange::confirm(std::uint32_t number) {
  if (!open_ || number != number_) return ServiceRefusal::kNoKeyOnTrial;
  if (!authenticator_->by_key_on_trial()) return ServiceRefusal::kNotByNewKey;
  authenticator_->end_key_trial(true);
  open_ = false;
  return ServiceRefusal::kNone;
}

bool KeyChange::pass_boundary() {
  if (!open_) return false;
  --frames_left_;
  if (frames_left_ - 1U < kKeyTrialFrames) return false;  // more are a flipped bit, and end the trial
  authenticator_->end_key_trial(false);
  open_ = false;
  return true;
}

}  // namespace lasso
