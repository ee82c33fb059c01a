// A value in three copies, voted two of three, so that one flipped bit changes nothing. The second copy is inverted: one disturbance that
// sets neighbouring words alike does not win the vote.
#pragma once

#include <cstdint>

namespace lasso {

// T: an enumeration or an unsigned integer of at most 32 bits.
template <class T>
class Voted {
 public:
  explicit Voted(T value) { set(value); }

  void set(T value) {
    const auto word = static_cast<std::uint32_t>(value);
    copies_[0] = word;
    copies_[1] = ~word;
    copies_[2] = word;
  }

  // What two copies at least say; where all three differ there is no value: false, and `value` is as it was.
  bool get(T& value) const {
    const std::uint32_t a = copies_[0];
    const std::uint32_t b = ~copies_[1];
    const std::uint32_t c = copies_[2];
    if (a != b && a != c && b != c) return false;
    value = static_cast<T>(b == c ? b : a);
    return true;
  }

  // Do all three say the same?
  bool agreed() const { return copies_[0] == ~copies_[1] && copies_[0] == copies_[2]; }

 private:
  std::uint32_t copies_[3] = {};
};

}  // namespace lasso
