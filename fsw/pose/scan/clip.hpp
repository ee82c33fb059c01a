// The part of a ray that lies inside the field's grid, and what a ray meets there.
#pragma once

#include "fsw/mission/field.hpp"

namespace lasso {

template <class N>
struct FieldSpan {
  typename N::Length enter{};
  typename N::Length leave{};  // below enter: the ray misses the grid
};

// Slab by slab; a ray parallel to a slab counts as inside it.
template <class N>
inline FieldSpan<N> clip_to_grid(const Field<N>& field, const FieldRay<N>& ray) {
  using Length = typename N::Length;
  Length enter = N::to_length(-N::kFarthest_m);
  Length leave = N::to_length(N::kFarthest_m);
  for (int i = 0; i < 3; ++i) {
    const auto speed = ray.cell_u[i];
    if (speed == typename N::CellRate{0}) continue;
    const auto inverse = inverse_of(speed);
    const auto low = bounded<Length>(over<Length>(-ray.cell_m[i], inverse));
    const auto high = bounded<Length>(over<Length>(N::cells(static_cast<std::int32_t>(field.cells[i])) - ray.cell_m[i], inverse));
    const Length first = low < high ? low : high;
    const Length last = low < high ? high : low;
    if (first > enter) enter = first;
    if (last < leave) leave = last;
  }
  return {enter, leave};
}

// How far ahead the ray is closest to the grid's middle; the ray then starts there.
template <class N>
inline typename N::Length move_near(const Field<N>& field, FieldRay<N>& ray) {
  using Length = typename N::Length;
  Length away[3];
  for (int i = 0; i < 3; ++i) {
    const auto half = bounded<Length>(times(static_cast<std::int32_t>(field.cells[i] / 2), field.cell));
    away[i] = field.origin[i] + half - ray.m[i];
  }
  const auto ahead = bounded<Length>(dot3<N>(ray.u, away));
  for (int i = 0; i < 3; ++i) ray.m[i] = bounded<Length>(ray.m[i] + ahead * ray.u[i]);
  set_cells(field, ray);
  return ahead;
}

// The first element that the ray meets in the grid from t = start on; its cells are set. Bounded by walk_field.
template <class N>
inline FieldHit<N> walk_grid(const Field<N>& field, const FieldRay<N>& ray, typename N::Length start) {
  if (!near_grid(ray)) return {};
  const FieldSpan<N> span = clip_to_grid(field, ray);
  return walk_field(field, ray, span.enter > start ? span.enter : start, span.leave);
}

// The first element that the ray meets in front of its start, wherever that is: from where places in the grid have no number any more, it
// is looked for from nearby. Bounded by walk_field.
template <class N>
inline FieldHit<N> cast_ray(const Field<N>& field, FieldRay<N> ray) {
  set_cells(field, ray);
  if (near_grid(ray)) return walk_grid(field, ray, typename N::Length{0});
  const typename N::Length ahead = move_near(field, ray);
  FieldHit<N> hit = walk_grid(field, ray, -ahead);
  hit.t += ahead;
  return hit;
}

}  // namespace lasso
