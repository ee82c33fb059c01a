#include "mdat/stereo/depth_window.hpp"

#include <algorithm>

namespace lasso::mdat {

MatchDepths depths_at(const Mesh& target, const Vec3& center_m, const std::vector<double>& ranges_m, double baseline_m) {
  double radius_m = 0;
  for (const Vec3& vertex : target.vertices) radius_m = std::max(radius_m, (vertex - center_m).norm());
  const auto [nearest, farthest] = std::minmax_element(ranges_m.begin(), ranges_m.end());
  const double from_m = std::max(kNearestBaselines * baseline_m, (1 - kDepthMargin) * (*nearest - radius_m));
  return {from_m, std::max(2 * from_m, (1 + kDepthMargin) * (*farthest + radius_m))};
}

MatchDepths stated_depths(const Mesh& target, const CaseSetup& setup, double baseline_m) {
  const Scenario& scenario = setup.scenario;
  const Vec3 center_m = scenario.center_m.size() == 3 ? Vec3(scenario.center_m.data()) : Vec3::Zero();
  const std::vector<double> ranges_m = scenario.has_profile() ? scenario.ranges_m : std::vector<double>{setup.range_m};
  return depths_at(target, center_m, ranges_m, baseline_m);
}

}  // namespace lasso::mdat
