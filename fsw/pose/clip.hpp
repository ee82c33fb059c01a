// The part of a ray that lies inside the field's grid.
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

}  // namespace lasso
