#include "fsw/link/key_change.hpp"

#include <algorithm>

namespace lasso {

void KeyChange::use_authenticator(Authenticator& authenticator) {
  authenticator_ = &authenticator;
  static_cast<void>(authenticator.end_key_trial(false));
  frames_left_ = 0;
}

ServiceRefusal KeyChange::begin(std::uint32_t number) {
  if (frames_left_ != 0) return ServiceRefusal::kKeyOnTrial;
  if (authenticator_ == nullptr || !authenticator_->try_key(number)) return ServiceRefusal::kNoSuchKey;
  number_ = number;
  frames_left_ = kKeyTrialFrames;
  return ServiceRefusal::kNone;
}

ServiceRefusal KeyChange::confirm(std::uint32_t number) {
  if (frames_left_ == 0 || number != number_) return ServiceRefusal::kNoKeyOnTrial;
  if (!authenticator_->by_key_on_trial()) return ServiceRefusal::kNotByNewKey;
  if (!authenticator_->end_key_trial(true)) return ServiceRefusal::kNotKept;
  frames_left_ = 0;
  return ServiceRefusal::kNone;
}

// Between trials the authenticator is told so, too: no flipped bit of ours leaves two keys in use.
bool KeyChange::pass_boundary() {
  if (authenticator_ == nullptr) return false;
  const bool open = frames_left_ != 0;
  if (open) frames_left_ = std::min(frames_left_, kKeyTrialFrames) - 1;  // a flipped bit makes no trial longer than two
  if (frames_left_ == 0) static_cast<void>(authenticator_->end_key_trial(false));
  return open && frames_left_ == 0;
}

}  // namespace lasso
