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
  typename N::Length enter = static_cast<typename N::Length>(-1e6F);
  typename N::Length leave = static_cast<typename N::Length>(1e6F);
  for (int i = 0; i < 3; ++i) {
    const auto speed = ray.cell_u[i];
    if (speed == 0) continue;
    const auto inverse = 1 / speed;
    const auto low = -ray.cell_m[i] * inverse;
    const auto high = (static_cast<typename N::Ratio>(static_cast<std::int32_t>(field.cells[i])) - ray.cell_m[i]) * inverse;
    const auto first = low < high ? low : high;
    const auto last = low < high ? high : low;
    if (first > enter) enter = first;
    if (last < leave) leave = last;
  }
  return {enter, leave};
}

}  // namespace lasso
