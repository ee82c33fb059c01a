#include "mdat/modelc/cell_list.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lasso::mdat {
namespace {

using Corners = std::vector<Vec3d>;

// What is left of a convex polygon where n.p >= d.
Corners cut(const Corners& polygon, const Vec3d& n, double d) {
  Corners kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double above_a = n.dot(a) - d, above_b = n.dot(b) - d;
    if (above_a >= 0) kept.push_back(a);
    if ((above_a >= 0) != (above_b >= 0)) kept.push_back(a + above_a / (above_a - above_b) * (b - a));
  }
  return kept;
}

double area(const Corners& polygon) {
  Vec3d sum = Vec3d::Zero();
  for (std::size_t i = 2; i < polygon.size(); ++i) sum += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
  return sum.norm() / 2;
}

// An element's part in the cube.
struct Part {
  std::uint32_t index;
  const Element* element;
  Corners corners;
  double area_m2;
};

Part part_of(const std::vector<Element>& elements, std::uint32_t index, const SampleCube& cube) {
  const Element& e = elements[index];
  Corners corners(e.outline.begin(), e.outline.begin() + e.sides);
  for (int axis = 0; axis < 3; ++axis) {
    corners = cut(corners, Vec3d::Unit(axis), cube.center[axis] - cube.half_m);
    corners = cut(corners, -Vec3d::Unit(axis), -cube.center[axis] - cube.half_m);
  }
  const double size = area(corners);
  return {index, &e, std::move(corners), size};
}

// Where a ray that meets `plane`'s front can come from (side 1), or where it can be after it (side -1): is any of the part there?
bool reaches(const Part& part, const Element& plane, double side, double tolerance_m) {
  return std::any_of(part.corners.begin(), part.corners.end(), [&](const Vec3d& p) {
    const double height = plane.n.dot(p) - plane.d;
    return (plane.two_sided ? std::abs(height) : side * height) > tolerance_m;
  });
}

// A ray that meets `first` is behind it from there on, and one that meets `second` was in front of it before.
bool can_precede(const Part& first, const Part& second, double tolerance_m) {
  return reaches(second, *first.element, -1, tolerance_m) && reaches(first, *second.element, 1, tolerance_m);
}

bool is_final(const std::vector<Part>& parts, const Part& part, double tolerance_m) {
  return std::none_of(parts.begin(), parts.end(),
                      [&](const Part& other) { return &other != &part && can_precede(other, part, tolerance_m); });
}

}  // namespace

std::vector<std::uint32_t> make_cell_list(const std::vector<Element>& elements, const std::vector<std::uint32_t>& indices,
                                          const SampleCube& cube, double tolerance_m) {
  std::vector<Part> parts;
  for (const std::uint32_t index : indices) parts.push_back(part_of(elements, index, cube));
  std::sort(parts.begin(), parts.end(),
            [](const Part& a, const Part& b) { return a.area_m2 > b.area_m2 || (a.area_m2 == b.area_m2 && a.index < b.index); });
  std::vector<std::uint32_t> entries;
  for (const Part& part : parts) entries.push_back(part.index | (is_final(parts, part, tolerance_m) ? kFinalEntry : 0));
  return entries;
}

}  // namespace lasso::mdat
