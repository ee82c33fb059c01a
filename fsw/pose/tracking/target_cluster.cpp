#include "fsw/pose/tracking/target_cluster.hpp"

#include "fsw/geometry/number.hpp"

namespace lasso {
namespace {

float distance2(const float* a, const float* b) {
  const float d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  return dot3<FloatNumber>(d, d);
}

struct Group {
  std::int32_t lead = 0;  // returns in it less those about it
  float mean[3] = {};
};

// The mean of the returns around one of them, and how far the returns around that mean outnumber those farther out.
Group group_around(const FieldReturn& place, float reach2, const FieldReturns& returns) {
  double sum[3] = {};
  std::uint32_t count = 0;
  for (const FieldReturn& candidate : returns) {
    if (distance2(candidate.p, place.p) > reach2) continue;
    ++count;
    for (int i = 0; i < 3; ++i) sum[i] += static_cast<double>(candidate.p[i]);
  }
  Group group;
  for (int i = 0; i < 3; ++i) group.mean[i] = static_cast<float>(sum[i] / count);  // the place itself is one of them
  for (const FieldReturn& candidate : returns) {
    const float d2 = distance2(candidate.p, group.mean);
    if (d2 <= 4 * reach2) group.lead += d2 <= reach2 ? 1 : -1;
  }
  return group;
}

Group find_group(float reach2, const FieldReturns& returns) {
  const std::size_t stride = returns.size() / kGroupLooks + 1;
  Group best;
  for (std::size_t i = 0; i < returns.size(); i += stride) {
    const Group group = group_around(returns[i], reach2, returns);
    if (group.lead > best.lead) best = group;
  }
  return best;
}

void drop_strays(FieldReturns& returns) {
  const Span<const FieldReturn> all = returns.span();
  returns.clear();
  for (const FieldReturn& candidate : all) {  // written where it stood or before
    if (!candidate.stray) invariant(returns.push_back(candidate), "fewer returns than before");
  }
}

void drop_distant(const Group& group, float reach2, FieldReturns& returns) {
  for (FieldReturn& candidate : returns) candidate.stray = distance2(candidate.p, group.mean) > reach2;
  drop_strays(returns);
}

// The asked ones are a fixed choice among all; a return is no neighbour of itself.
bool is_lonely(std::size_t index, float radius2, const FieldReturns& returns) {
  const std::size_t stride = returns.size() / kGroupLooks + 1;
  std::uint32_t asked = 0;
  std::uint32_t near = 0;
  for (std::size_t i = 0; i < returns.size(); i += stride) {
    if (i == index) continue;
    ++asked;
    near += distance2(returns[i].p, returns[index].p) <= radius2 ? 1u : 0u;
  }
  return near * kStrayShare < asked;
}

void drop_lonely(float radius2, FieldReturns& returns) {
  for (std::size_t i = 0; i < returns.size(); ++i) returns[i].stray = is_lonely(i, radius2, returns);
  drop_strays(returns);
}

}  // namespace

bool keep_target_cluster(double radius_m, FieldReturns& returns) {
  const float radius2 = static_cast<float>(radius_m * radius_m);
  const float reach2 = 4 * radius2;
  const Group group = find_group(reach2, returns);
  if (group.lead <= 0) return false;
  drop_distant(group, reach2, returns);
  drop_lonely(radius2 / 4, returns);
  return true;
}

}  // namespace lasso
