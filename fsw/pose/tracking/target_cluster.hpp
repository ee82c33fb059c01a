// Of all returns of a full field those of the target, known only by its size: the largest group that fits into it and stands alone in
// space.
#pragma once

#include <cstdint>

#include "cfg/capacities.hpp"
#include "fsw/core/fixed_vector.hpp"

namespace lasso {

struct FieldReturn {
  float p[3];             // m, sensor frame
  std::int32_t after_us;  // the scan's reference time
  bool stray;             // inside of keep_target_cluster
};
using FieldReturns = FixedVector<FieldReturn, kMaxRays>;

constexpr std::size_t kGroupLooks = 128;   // returns that are tried as a place of the target, or asked for neighbours
constexpr std::uint32_t kStrayShare = 32;  // a return has a neighbour within half the radius for so many of its group

// Leaves in `returns` the group of a target that lies within `radius_m` of a point of its own, in their order. The group lies within twice
// that of its mean, and outnumbers what lies about it, up to four times the radius: a wall goes on, a target ends. Strays, which have too
// few neighbours, go. False, and nothing changes, where no group outnumbers its surroundings. Loop bound: kMaxRays times kGroupLooks.
bool keep_target_cluster(double radius_m, FieldReturns& returns);

}  // namespace lasso
