// The part of the field that rays use: which elements cross which (widened) cell, and how far the nearest occupied cell is.
#pragma once

#include "mdat/modelc/grid.hpp"

namespace lasso::mdat {

// A convex polygon prepared for separating-axis tests against boxes of one shape.
class PolygonBoxTest {
 public:
  explicit PolygonBoxTest(const Element& element);
  // Does the polygon (its outline) meet the cube of this half edge? Touching counts.
  bool meets(const Vec3d& center, double half_m) const;
  const Vec3d& low() const { return low_; }
  const Vec3d& high() const { return high_; }

 private:
  struct Axis {
    Vec3d direction;
    double low, high, spread;  // of the polygon; spread: |x| + |y| + |z|
  };
  void add(const Vec3d& direction, const Element& element);
  std::array<Axis, 13> axes_;
  std::size_t count_ = 0;
  Vec3d low_, high_;
};

// Cells are widened by half a cell and this share of one, which covers the rounding of the flight component's own arithmetic.
constexpr double kCellTolerance = 1e-3;
// Heights below this share of a cell above or below a plane count as in it.
constexpr double kFinalTolerance = 1e-3;

struct RayField {
  std::vector<std::uint32_t> brick_words;   // word 0 of each brick
  std::vector<std::uint32_t> cells, lists;  // tables kRayCells and kRayLists
};

// Throws CompileError for a list over kMaxElementsPerCell (with the place) or a list table over its offset's range.
RayField make_ray_field(const std::vector<Element>& elements, const Grid& grid, CompileReport& report);

}  // namespace lasso::mdat
