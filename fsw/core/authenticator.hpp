// Authentication of commands and of mission images, for links that do not authenticate below this component. A board supplies it
// (Component::use_authenticator); without one, commands have no trailer and images no signature. What they hold (a code, a number that has
// to grow, a key's name) is the board's own business.
//
// Codes are compared in constant time. No call waits, and all come from one thread.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/span.hpp"

namespace lasso {

constexpr std::size_t kMaxAuthenticationBytes = 32;

class Authenticator {
 public:
  // Of a command's trailer: 1 to kMaxAuthenticationBytes, always the same.
  virtual std::size_t trailer_bytes() const = 0;

  // Does `trailer` show that `packet`, all bytes before it, comes from who may command, and is not sent again? Asked once for each packet
  // with right CRC and headers, before its arguments are looked at. Bounded.
  virtual bool authentic(ConstBytes packet, ConstBytes trailer) = 0;

  // Of the signature behind an image's last byte: a multiple of 4, at most kMaxAuthenticationBytes, always the same. 0: it judges no
  // images, and none is authentic.
  virtual std::size_t image_signature_bytes() const { return 0; }
  // An image is judged: begun, given in pieces in the order of its bytes, ended by its signature. One at a time; one that is begun ends
  // the one before. A piece is at most 8 KiB in flight, and any size before the component has begun.
  virtual void begin_image() {}
  virtual void take_image(ConstBytes) {}
  virtual bool image_authentic(ConstBytes) { return false; }

  // Keys of commands have numbers. try_key: from now on packets by the key of this number are authentic as well as those by the key in use;
  // the number is larger than that of the key in use, by a small step: what is stepped over is used up. False, and nothing has changed:
  // there is no such key.
  virtual bool try_key(std::uint32_t) { return false; }
  // Is the last authentic packet by the key on trial?
  virtual bool by_key_on_trial() const { return false; }
  // Kept: the key on trial takes the place of the one in use, which is of no use any more, after a restart either. False: that could not be
  // stored, nothing has changed, and the trial goes on. Not kept: the key on trial is of no use any more; what is returned is not looked
  // at. Numbers that have to grow go on. Nothing happens, nor is written, where there is no trial: it is called at each boundary.
  virtual bool end_key_trial(bool) { return false; }

 protected:
  ~Authenticator() = default;  // never deleted through this interface: no operator delete in flight code
};

}  // namespace lasso
