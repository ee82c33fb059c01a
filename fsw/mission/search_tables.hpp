// What the search for a first pose knows of the reference model: distances on a coarse grid, views, near-symmetries. Built by the mission
// compiler; see image_format.hpp. Positions are in the target's frame.
#pragma once

#include <cstdint>

#include "fsw/core/span.hpp"
#include "fsw/geometry/number.hpp"
#include "fsw/mission/image_format.hpp"

namespace lasso {

// A direction to look from, and where the middle of what is seen lies.
template <class N>
struct ModelView {
  typename N::Unit direction[3];        // from the target to the sensor
  typename N::Length centroid[3];       // seen from afar
  typename N::Length near_centroid[3];  // seen from kNearView model sizes
  typename N::Length median;            // how much farther from the sensor than the centroid the median depth is
  typename N::Length near_median;
};

// A motion that brings the model nearly on itself: q' = R q + p.
template <class N>
struct NearSymmetry {
  typename N::Unit q[4];  // x y z w
  typename N::Length p[3];
};

template <class N>
struct SearchTables {
  float origin_m[3];
  float cells_per_m;
  std::uint32_t cells[3];
  float truncation_m;
  float size_m;                   // the model's largest extent
  const std::uint8_t* distances;  // in words of four, the first cell in the highest byte
  Span<const ModelView<N>> views;
  Span<const NearSymmetry<N>> symmetries;
};

constexpr std::uint32_t kFarByte = 255;

// Where the byte of cell 0 lies in a word of four.
constexpr std::uint32_t kFirstByte = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__ ? 0 : 3;

template <class N>
inline std::uint32_t byte_of(const SearchTables<N>& t, std::uint32_t cell) {
  return t.distances[cell ^ kFirstByte];
}

// The byte of a cell; indices of cells outside the grid (also negative ones, wrapped) give kFarByte.
template <class N>
inline std::uint32_t distance_byte(const SearchTables<N>& t, std::uint32_t ix, std::uint32_t iy, std::uint32_t iz) {
  if (ix >= t.cells[0] || iy >= t.cells[1] || iz >= t.cells[2]) return kFarByte;
  const std::uint32_t cell = (iz * t.cells[1] + iy) * t.cells[0] + ix;
  return byte_of(t, cell);
}

// Distance to the surface and the direction away from it, interpolated between the centres of cells. The search is no part of the path
// that each scan takes: it has floating point in every build.
struct SurfaceDistance {
  float distance_m;
  float away[3];  // gradient of the distance; about of unit length near the surface, zero where all is far
};

template <class N>
inline SurfaceDistance surface_distance(const SearchTables<N>& t, const float* m) {
  constexpr float kOutside = 1000;  // cells
  std::uint32_t index[3];
  float f[3];
  bool inside = true;  // all eight cells are
  for (int i = 0; i < 3; ++i) {
    const float x = (m[i] - t.origin_m[i]) * t.cells_per_m - 0.5F;
    const float place = x >= 0 && x < kOutside ? x : kOutside;
    const auto whole = static_cast<std::int32_t>(place);
    f[i] = place - static_cast<float>(whole);
    index[i] = static_cast<std::uint32_t>(whole);
    inside = inside && index[i] + 1 < t.cells[i];
  }
  if (!inside) return {t.truncation_m, {0, 0, 0}};
  const std::uint32_t row = t.cells[0];
  const std::uint32_t layer = row * t.cells[1];
  const std::uint32_t first = index[2] * layer + index[1] * row + index[0];
  float d[2][2][2];  // z y x
  for (std::uint32_t k = 0; k < 8; ++k) {
    const std::uint32_t byte = byte_of(t, first + (k >> 2) * layer + (k >> 1 & 1) * row + (k & 1));
    d[k >> 2][k >> 1 & 1][k & 1] = static_cast<float>(static_cast<std::int32_t>(byte));
  }
  float line[2][2];   // along x
  float slope[2][2];  // d/dx
  for (int z = 0; z < 2; ++z) {
    for (int y = 0; y < 2; ++y) {
      slope[z][y] = d[z][y][1] - d[z][y][0];
      line[z][y] = d[z][y][0] + f[0] * slope[z][y];
    }
  }
  const float low = line[0][0] + f[1] * (line[0][1] - line[0][0]);
  const float high = line[1][0] + f[1] * (line[1][1] - line[1][0]);
  const float unit = t.truncation_m / static_cast<float>(static_cast<std::int32_t>(kFarByte));
  const float per_m = unit * t.cells_per_m;
  SurfaceDistance result;  // NOLINT(cppcoreguidelines-pro-type-member-init): each member is set below; this runs per return and pass
  result.distance_m = unit * (low + f[2] * (high - low));
  const float low_x = slope[0][0] + f[1] * (slope[0][1] - slope[0][0]);
  const float high_x = slope[1][0] + f[1] * (slope[1][1] - slope[1][0]);
  const float low_y = line[0][1] - line[0][0];
  const float high_y = line[1][1] - line[1][0];
  result.away[0] = per_m * (low_x + f[2] * (high_x - low_x));
  result.away[1] = per_m * (low_y + f[2] * (high_y - low_y));
  result.away[2] = per_m * (high - low);
  return result;
}

}  // namespace lasso
