// Inputs and a digest that the geometry tests share.
#pragma once

#include "fsw/core/bits.hpp"
#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/types.hpp"
#include "ut/support/generator.hpp"

namespace lasso::test {

inline Vec3 random_vector(Generator& generator, double size) {
  Vec3 v;
  for (int i = 0; i < 3; ++i) v[i] = size * generator.uniform(-1, 1);
  return v;
}

// A rotation without preferred direction: unit length to rounding, either sign.
inline Quat random_rotation(Generator& generator) {
  Quat q;
  for (int i = 0; i < 4; ++i) q.coeffs()[i] = generator.normal();
  const double length = square_root(q.coeffs().squaredNorm());
  return Quat(q.w() / length, q.x() / length, q.y() / length, q.z() / length);
}

// FNV-1a over the bits of numbers, most significant byte first.
class Digest {
 public:
  void add(double x) {
    const auto bits = same_bits<std::uint64_t>(x);
    for (int shift = 56; shift >= 0; shift -= 8) value_ = (value_ ^ ((bits >> shift) & 0xFFU)) * 0x100000001B3U;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xCBF29CE484222325U;
};

}  // namespace lasso::test
