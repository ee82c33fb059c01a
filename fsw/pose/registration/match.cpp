#include "fsw/pose/registration/match.hpp"

namespace lasso {

using N = FlightNumber;

void match_points(const Field<N>& field, const PathPose<N>& T_target_sensor, const MatchSettings<N>& s, Span<MatchPoint<N>> points,
                  const PassKind& kind, PassSums<N>& sums) {
  for (std::size_t i = 0; i < points.size(); i += kind.stride) {
    MatchPoint<N>& point = points.data()[i];
    FieldRay<N> ray;  // NOLINT(cppcoreguidelines-pro-type-member-init): set by what it is handed to, once a point
    const FieldHit<N> hit = meet_surface(field, T_target_sensor, s, kind.lookup, point, ray);
    if (hit.found) {
      add_hit(s, fit_hit(field, s, point, ray, hit), hit, sums);
    } else if (!point.aimed) {
      ++sums.usable;
    }
  }
  sums.rows.flush();
}

CostSums<N> cost_points(const Field<N>& field, const PathPose<N>& T_target_sensor, const MatchSettings<N>& s, Lookup lookup,
                        Span<MatchPoint<N>> points) {
  CostSums<N> sums;
  for (MatchPoint<N>& point : points) {
    FieldRay<N> ray;  // NOLINT(cppcoreguidelines-pro-type-member-init): as above
    const FieldHit<N> hit = meet_surface(field, T_target_sensor, s, lookup, point, ray);
    if (hit.found) {
      add_explained(fit_hit(field, s, point, ray, hit), sums);
    } else if (!point.aimed) {
      ++sums.usable;
    }
  }
  return sums;
}

}  // namespace lasso
