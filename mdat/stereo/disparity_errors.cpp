#include "mdat/stereo/disparity_errors.hpp"

#include <algorithm>
#include <cmath>

#include "fsw/geometry/so3.hpp"

namespace lasso::mdat {
namespace {

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double share_of(std::size_t part, std::size_t whole) { return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole); }

double wrong_share(const std::vector<double>& errors_px) {
  const auto wrong = std::count_if(errors_px.begin(), errors_px.end(), [](double error_px) { return std::fabs(error_px) > kWrong_px; });
  return share_of(static_cast<std::size_t>(wrong), errors_px.size());
}

// Least and greatest disparity in the band about each pixel, along one axis and then the other.
struct Extremes {
  std::vector<double> low, high;
};

void spread_along(int length, int lines, std::size_t step, std::size_t line_step, Extremes& extremes) {
  std::vector<double> low(static_cast<std::size_t>(length)), high(low);
  for (int line = 0; line < lines; ++line) {
    const std::size_t begin = static_cast<std::size_t>(line) * line_step;
    for (std::size_t i = 0; i < low.size(); ++i) {
      low[i] = extremes.low[begin + i * step];
      high[i] = extremes.high[begin + i * step];
    }
    for (int i = 0; i < length; ++i) {
      const auto from = std::max(0, i - kEdgeBand_px), to = std::min(length, i + kEdgeBand_px + 1);
      const std::size_t place = begin + static_cast<std::size_t>(i) * step;
      extremes.low[place] = *std::min_element(low.begin() + from, low.begin() + to);
      extremes.high[place] = *std::max_element(high.begin() + from, high.begin() + to);
    }
  }
}

// Sky has disparity 0, and so an edge towards all else.
std::vector<bool> edges_of(const std::vector<double>& truth_px, int width, int height) {
  Extremes extremes{truth_px, truth_px};
  const auto row = static_cast<std::size_t>(width);
  spread_along(width, height, 1, row, extremes);
  spread_along(height, width, row, 1, extremes);
  std::vector<bool> edges;
  for (std::size_t i = 0; i < truth_px.size(); ++i) edges.push_back(extremes.high[i] > (1 + kEdgeStep) * extremes.low[i]);
  return edges;
}

}  // namespace

std::vector<double> true_disparities(const DisparityMap& map, const ModelSurface& surface, const Pose& T_sensor_target) {
  const Pose T_target_sensor = inverse(T_sensor_target);
  std::vector<double> truth_px;
  truth_px.reserve(map.codes.codes.size());
  for (int row = 0; row < map.codes.height; ++row) {
    for (int column = 0; column < map.codes.width; ++column) {
      const Vec3 ray = Vec3((column - map.center_x_px) / map.focal_px, (row - map.center_y_px) / map.focal_px, 1).normalized();
      SurfacePoint point;
      const bool hit = surface.find(T_target_sensor.p, rotate(T_target_sensor.q, rotate(map.q_left_rectified, ray)), point);
      truth_px.push_back(hit ? map.focal_px * map.baseline_m / (point.range_m * ray.z()) : 0);
    }
  }
  return truth_px;
}

DisparityErrors disparity_errors(const DisparityMap& map, const std::vector<double>& truth_px) {
  const std::vector<bool> edges = edges_of(truth_px, map.codes.width, map.codes.height);
  DisparityErrors errors;
  std::vector<double> inside, at_edge;
  for (std::size_t i = 0; i < truth_px.size(); ++i) {
    const bool is_valid = map.codes.codes[i] > 0, is_target = truth_px[i] > 0;
    if (is_target) ++errors.target;
    if (is_valid) ++errors.valid;
    if (is_valid && is_target) (edges[i] ? at_edge : inside).push_back(map.disparity_px(i) - truth_px[i]);
  }
  const std::size_t on_target = inside.size() + at_edge.size();
  errors.valid_share = share_of(on_target, errors.target);
  errors.sky_share = share_of(errors.valid - on_target, errors.valid);
  errors.wrong_interior = wrong_share(inside);
  errors.wrong_edge = wrong_share(at_edge);
  errors.bias_px = median(inside);
  for (double& error_px : inside) error_px = std::fabs(error_px - errors.bias_px);
  errors.sigma_px = 1.4826 * median(inside);
  return errors;
}

}  // namespace lasso::mdat
