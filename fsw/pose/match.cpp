#include "fsw/pose/match.hpp"

namespace lasso {

using N = FlightNumber;

void match_points(const Field<N>& field, const PathPose<N>& T_target_sensor, const MatchSettings<N>& s, Span<MatchPoint<N>> points,
                  const PassKind& kind, PassSums<N>& sums) {
  for (std::size_t i = 0; i < points.size(); i += kind.stride) {
    MatchPoint<N>& point = points.data()[i];
    FieldRay<N> ray = to_target(T_target_sensor, point);
    const FieldHit<N> hit = find_hit(field, s, point, kind.lookup, ray);
    point.element = hit.found ? hit.element : kNoElement;
    if (hit.found) {
      add_hit(field, s, point, ray, hit, sums);
    } else if (!point.aimed) {
      ++sums.usable;
    }
  }
  sums.rows.flush();
}

}  // namespace lasso
