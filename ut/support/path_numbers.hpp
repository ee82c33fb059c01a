// The build's numbers of the per-point path, for tests of either number type.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <type_traits>

#include "fsw/geometry/types.hpp"
#include "fsw/mission/mission.hpp"

namespace lasso::test {

// A vector as the path holds it.
template <class R>
std::array<R, 3> path_vector(const Vec3& v) {
  std::array<R, 3> out;
  for (int i = 0; i < 3; ++i) out[static_cast<std::size_t>(i)] = FlightNumber::to<R>(v[i]);
  return out;
}

// How far a number of type R is from x at most where it is x's nearest: half of what the type resolves.
template <class R>
double rounding_of(double x) {
  if constexpr (std::is_same_v<R, float>) {
    return std::fabs(x) * 0x1p-24;
  } else {
    return std::ldexp(0.5, -R::kFraction);
  }
}

// Is x the path's number for `truth`, to four of what its type resolves?
template <class R>
::testing::AssertionResult is_path_number(R x, double truth) {
  const double off = std::fabs(static_cast<double>(x) - truth);
  if (off <= 8 * rounding_of<R>(truth)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << static_cast<double>(x) << " is " << off << " off " << truth;
}

}  // namespace lasso::test
