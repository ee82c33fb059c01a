#include "mdat/modelc/hull.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mdat/modelc/parallel.hpp"

namespace lasso::mdat {
namespace {

constexpr std::size_t kDirections = 4000;
constexpr double kClose = 1e-6;

// Directions along the axes, then spread evenly over the sphere (Fibonacci).
std::vector<Vec3d> make_directions() {
  std::vector<Vec3d> directions;
  for (int axis = 0; axis < 3; ++axis) {
    directions.emplace_back(Vec3d::Unit(axis));
    directions.emplace_back(-Vec3d::Unit(axis));
  }
  for (std::size_t i = 0; i < kDirections; ++i) {
    const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(kDirections);
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / std::numbers::phi;
    const double r = std::sqrt(1 - z * z);
    directions.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
  }
  return directions;
}

struct Support {
  std::size_t vertex = 0;
  double reach = -std::numeric_limits<double>::infinity();   // of the model
  double chosen = -std::numeric_limits<double>::infinity();  // of the chosen points
};

Support find_support(const std::vector<Vec3d>& vertices, const Vec3d& direction) {
  Support support;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const double reach = direction.dot(vertices[i]);
    if (reach > support.reach) support = {i, reach, support.chosen};
  }
  return support;
}

// Away from the middle of the points.
void move_outward(double distance, std::vector<Vec3d>& points) {
  Vec3d low = points.front(), high = low;
  for (const Vec3d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vec3d middle = (low + high) / 2;
  for (Vec3d& p : points) p += distance * (p - middle).normalized();
}

}  // namespace

std::vector<Vec3d> extreme_points(const std::vector<Vec3d>& vertices, double extent_m, std::size_t count_max) {
  const std::vector<Vec3d> directions = make_directions();
  std::vector<Support> supports(directions.size());
  parallel_for(directions.size(), [&](std::size_t i) { supports[i] = find_support(vertices, directions[i]); });
  std::vector<Vec3d> points;
  const auto choose = [&](std::size_t vertex) {
    points.push_back(vertices[vertex]);
    for (std::size_t i = 0; i < directions.size(); ++i) {
      supports[i].chosen = std::max(supports[i].chosen, directions[i].dot(points.back()));
    }
  };
  const auto deficit = [](const Support& s) { return s.reach - s.chosen; };
  const auto less = [&](const Support& x, const Support& y) { return deficit(x) < deficit(y); };
  for (std::size_t i = 0; i < 6 && points.size() < count_max; ++i) {
    if (deficit(supports[i]) > kClose * extent_m) choose(supports[i].vertex);
  }
  const auto worst = [&] { return std::max_element(supports.begin(), supports.end(), less); };
  while (points.size() < count_max && deficit(*worst()) > kClose * extent_m) choose(worst()->vertex);
  if (deficit(*worst()) > kClose * extent_m) move_outward(deficit(*worst()) / 2, points);
  return points;
}

}  // namespace lasso::mdat
