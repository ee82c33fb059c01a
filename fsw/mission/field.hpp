// The look-up field of the reference model: which surface element a ray hits near a point, which element is closest, where the surface
// is from afar. Built by the mission compiler; the tables and their guarantees are stated in image_format.hpp.
//
// Positions are in the target's frame. A query ray is m + t u: m is usually a measured point, u the unit direction from the sensor,
// t [m] the offset along it, so that the hit's t is the range residual, predicted minus measured.
#pragma once

#include <cstdint>

#include "fsw/geometry/number.hpp"
#include "fsw/mission/image_format.hpp"

namespace lasso {

// A convex polygon of 3 or 4 sides, see image_format.hpp. What decides most candidates comes first; the sides lie component by component.
template <class N>
struct Element {
  typename N::Unit n[3];
  typename N::Length d;
  std::uint32_t curvature;
  std::uint32_t flags;
  typename N::Unit side[3][4];
  typename N::Length side_offset[4];
};

template <class N>
struct Curvature {
  typename N::Unit n[3];
  typename N::Length c[3];
  typename N::Gradient g[9];
};

template <class N>
struct Field {
  typename N::Length origin[3];
  typename N::Length cell;
  typename N::CellRate cells_per_m;
  std::uint32_t bricks[3];
  std::uint32_t cells[3];
  std::uint32_t element_count;
  const std::uint32_t* brick_words;
  const std::uint32_t* ray_cells;
  const std::uint32_t* ray_lists;
  const std::uint32_t* near_cells;
  const typename N::Length* foot_points;
  const Element<N>* elements;
  const Curvature<N>* curvatures;
};

// A ray prepared for the field: the same ray in metres and in cells.
template <class N>
struct FieldRay {
  typename N::Length m[3];
  typename N::Unit u[3];
  typename N::Cells cell_m[3];
  typename N::CellRate cell_u[3];
};

template <class N>
struct FieldHit {
  typename N::Length t{};
  std::uint32_t element = 0;
  bool found = false;
};

constexpr std::uint32_t kNoElement = 0xFFFFFFFFu;
constexpr int kMaxWalkSteps = 1024;  // bound of one walk

template <class N>
inline void set_cells(const Field<N>& field, FieldRay<N>& ray) {
  for (int i = 0; i < 3; ++i) {
    ray.cell_m[i] = bounded<typename N::Cells>((ray.m[i] - field.origin[i]) * field.cells_per_m);
    ray.cell_u[i] = ray.u[i] * field.cells_per_m;
  }
}

template <class N>
inline bool near_grid(const FieldRay<N>& ray) {
  for (int i = 0; i < 3; ++i) {
    if (!(ray.cell_m[i] > -N::kFarthestCell && ray.cell_m[i] < N::kFarthestCell)) return false;
  }
  return true;
}

// Does the ray hit this element's front with t in [low, high)? On a hit t is set. A tilt n.u >= 0 is a back face, which counts only for
// two-sided elements. The conditions are joined without branches, which no processor could predict.
template <class N>
inline bool hit_element(const Element<N>& e, const FieldRay<N>& ray, typename N::Length low, typename N::Length high,
                        typename N::Length& t) {
  using Length = typename N::Length;
  constexpr typename N::Unit kLevel{0};
  const typename N::Unit tilt = dot3<N>(e.n, ray.u);
  const Length gap = e.d - dot3<N>(e.n, ray.m);
  const Length first = low * tilt;
  const Length last = high * tilt;
  const bool front = (static_cast<int>(tilt < kLevel) & static_cast<int>(gap <= first) & static_cast<int>(gap > last)) != 0;
  const bool back = (static_cast<int>(tilt > kLevel) & static_cast<int>(gap >= first) & static_cast<int>(gap < last)) != 0;
  if (!(front || (back && (e.flags & kElementTwoSided) != 0))) return false;
  const Length x = quotient<Length>(gap, tilt);
  const Length p[3] = {ray.m[0] + x * ray.u[0], ray.m[1] + x * ray.u[1], ray.m[2] + x * ray.u[2]};
  Length inside[4];  // how far from each side
  for (int i = 0; i < 4; ++i) inside[i] = e.side[0][i] * p[0] + e.side[1][i] * p[1] + e.side[2][i] * p[2] - e.side_offset[i];
  const auto shorter = [](auto a, auto b) { return b < a ? b : a; };
  if (shorter(shorter(inside[0], inside[1]), shorter(inside[2], inside[3])) < Length{0}) return false;
  t = x;
  return true;
}

// Looks into the cell at m + t u for the first element that the ray hits within half a cell of the sample. `next` is the t of the next
// sample of a walk: one cell on, or as far as nothing can lie. Bound: kMaxElementsPerCell.
template <class N>
inline FieldHit<N> sample_field(const Field<N>& field, const FieldRay<N>& ray, typename N::Length t, typename N::Length& next) {
  FieldHit<N> hit;
  next = t + field.cell;
  // Where truncation puts (-1, 0) into cell 0, that is empty by construction (the grid has a margin).
  const auto ix = static_cast<std::uint32_t>(whole_part(ray.cell_m[0] + t * ray.cell_u[0]));
  const auto iy = static_cast<std::uint32_t>(whole_part(ray.cell_m[1] + t * ray.cell_u[1]));
  const auto iz = static_cast<std::uint32_t>(whole_part(ray.cell_m[2] + t * ray.cell_u[2]));
  if (ix >= field.cells[0] || iy >= field.cells[1] || iz >= field.cells[2]) return hit;
  const std::uint32_t brick = ((iz >> 3) * field.bricks[1] + (iy >> 3)) * field.bricks[0] + (ix >> 3);
  std::uint32_t word = field.brick_words[kBrickWords * brick];
  if ((word & kEmptyBit) == 0) word = field.ray_cells[kRayCellsPerBrick * word + ((iz & 7) << 6 | (iy & 7) << 3 | (ix & 7))];
  if ((word & kEmptyBit) != 0) {
    next = t + bounded<typename N::Length>(times(static_cast<std::int32_t>(word & ~kEmptyBit), field.cell));
    return hit;
  }
  const std::uint32_t* list = field.ray_lists + (word & kListOffsetMask);
  constexpr auto kHalf = N::template to<typename N::Unit>(0.500001);
  const typename N::Length half = field.cell * kHalf;
  const typename N::Length low = t - half;
  hit.t = t + half;
  for (std::uint32_t count = word >> kListOffsetBits; count > 0; --count, ++list) {
    const std::uint32_t element = *list & ~kFinalEntry;
    if (!hit_element(field.elements[element], ray, low, hit.t, hit.t)) continue;
    hit.element = element;
    hit.found = true;
    if ((*list & kFinalEntry) != 0) break;
  }
  return hit;
}

// The first element that the ray hits with t in [from, to]. Bound: kMaxWalkSteps samples.
template <class N>
inline FieldHit<N> walk_field(const Field<N>& field, const FieldRay<N>& ray, typename N::Length from, typename N::Length to) {
  const typename N::Length half = half_of(field.cell);  // a sample sees half a cell to either side
  const auto farthest = N::farthest_walk(field.cell);   // keeps cell coordinates within integers
  typename N::Length t = (from > -farthest ? from : -farthest) + half;
  const typename N::Length end = (to < farthest ? to : farthest) + half;
  for (int step = 0; step < kMaxWalkSteps && t < end; ++step) {
    typename N::Length next;
    const FieldHit<N> hit = sample_field(field, ray, t, next);
    if (hit.found) return hit.t > to ? FieldHit<N>() : hit;
    t = next;
  }
  return {};
}

// Normal at a point of an element, outward on its front; of nearly unit length where the surface is curved, and cut to what a Unit holds.
template <class N>
inline void surface_normal(const Field<N>& field, const Element<N>& e, const typename N::Length* p, typename N::Unit* n) {
  if (e.curvature == 0) {
    for (int i = 0; i < 3; ++i) n[i] = e.n[i];
    return;
  }
  const Curvature<N>& k = field.curvatures[e.curvature];
  const typename N::Length q[3] = {p[0] - k.c[0], p[1] - k.c[1], p[2] - k.c[2]};
  for (int i = 0; i < 3; ++i) n[i] = cut<typename N::Unit>(k.n[i] + (k.g[i] * q[0] + k.g[3 + i] * q[1] + k.g[6 + i] * q[2]));
}

// Where a point lies in the grid; outside it, the nearest cell of the grid.
template <class N>
struct GridPlace {
  std::uint32_t brick = 0;
  std::uint32_t near_cell = 0;  // within the brick
  bool inside = true;
};

template <class N>
inline GridPlace<N> place_in_grid(const Field<N>& field, const typename N::Cells* cell_m) {
  GridPlace<N> place;
  std::uint32_t index[3];
  for (int i = 0; i < 3; ++i) {
    const auto last = static_cast<std::int32_t>(field.cells[i] - 1);
    const bool below = !(cell_m[i] >= typename N::Cells{0});
    const bool above = cell_m[i] > N::cells(last);
    place.inside = place.inside && !below && !above;
    index[i] = static_cast<std::uint32_t>(below ? 0 : above ? last : whole_part(cell_m[i]));
  }
  place.brick = ((index[2] >> 3) * field.bricks[1] + (index[1] >> 3)) * field.bricks[0] + (index[0] >> 3);
  place.near_cell = (index[2] & 7) >> 1 << 4 | (index[1] & 7) >> 1 << 2 | (index[0] & 7) >> 1;
  return place;
}

// The element closest to the place that faces the ray direction u, or kNoElement: the closest one to the near cell's centre if it faces,
// else the closest opposing one. A cheap look-up: exact at the cell's centre only.
template <class N>
inline std::uint32_t near_element(const Field<N>& field, const GridPlace<N>& place, const typename N::Unit* u) {
  const std::uint32_t record = field.brick_words[kBrickWords * place.brick + 1];
  if (!place.inside || record == 0) return kNoElement;
  const std::uint32_t* words = field.near_cells + kNearWordsPerBrick * (record - 1) + 2 * place.near_cell;
  for (int i = 0; i < 2; ++i) {
    if (words[i] == 0) continue;
    const Element<N>& e = field.elements[words[i] - 1];
    if (typename N::Unit(dot3<N>(e.n, u)) < typename N::Unit{0} || (e.flags & kElementTwoSided) != 0) return words[i] - 1;
  }
  return kNoElement;
}

}  // namespace lasso
