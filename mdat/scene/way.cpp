#include "mdat/scene/way.hpp"

#include <algorithm>
#include <utility>

namespace lasso::mdat::scene {

Way::Way(MotionTable table, const Place& place) : table_(std::move(table)) {
  Problems problems(place);
  if (table_.positions_m.empty()) problems.add_at(place, "", "", "has no positions: expected one for each time");
  check_table(table_, place, problems);
  problems.throw_if_any();
}

MotionState Way::at(TimeUs t_us) const {
  const double t_s = to_seconds(t_us);
  const std::vector<double>& times = table_.times_s;
  const std::vector<Vec3>& places = table_.positions_m;
  const auto after = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), t_s) - times.begin());
  MotionState state;
  if (after == 0 || after == times.size()) {
    state.T_a_b.p = after == 0 ? places.front() : places.back();
    return state;
  }
  const double span_s = times[after] - times[after - 1];
  const double u = (t_s - times[after - 1]) / span_s;
  const Vec3 way_m = places[after] - places[after - 1];
  state.T_a_b.p = places[after - 1] + way_m * u * u * (3 - 2 * u);
  state.rates.v_mps = 6 * way_m / span_s * u * (1 - u);
  return state;
}

}  // namespace lasso::mdat::scene
