#include "mdat/modelc/search_grid.hpp"

#include <algorithm>
#include <cmath>

#include "fsw/mission/search_tables.hpp"
#include "mdat/modelc/parallel.hpp"

namespace lasso::mdat {

Vec3d SearchGrid::center(std::size_t cell) const {
  const std::size_t x = cell % cells[0], y = cell / cells[0] % cells[1], z = cell / cells[0] / cells[1];
  return origin + cell_m * (Vec3d(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)) + Vec3d::Constant(0.5));
}

double SearchGrid::distance_m(const Vec3d& p) const {
  const Vec3d place = (p - origin) / cell_m;
  for (int i = 0; i < 3; ++i) {
    if (!(place[i] >= 0 && place[i] < cells[static_cast<std::size_t>(i)])) return truncation_m;
  }
  const auto index = [&](int i) { return static_cast<std::size_t>(place[i]); };
  return truncation_m * distances[(index(2) * cells[1] + index(1)) * cells[0] + index(0)] / kFarByte;
}

SearchGrid make_search_grid(const Surface& surface, const NearestSearch& nearest, const LengthScale& scale) {
  SearchGrid grid;
  grid.size_m = scale.round(surface.extent);
  grid.truncation_m = scale.round(kTruncationShare * surface.extent);
  grid.cell_m = scale.round(surface.extent / kSearchCellsPerExtent);
  for (int axis = 0; axis < 3; ++axis) {
    const double low = surface.low[axis] - grid.truncation_m;
    const double length = surface.high[axis] + grid.truncation_m - low;
    const auto cells = static_cast<std::uint32_t>(std::ceil(length / grid.cell_m)) + 1;
    grid.cells[static_cast<std::size_t>(axis)] = axis == 0 ? (cells + 3) / 4 * 4 : cells;
    grid.origin[axis] = scale.round(low);
  }
  grid.distances.resize(std::size_t{grid.cells[0]} * grid.cells[1] * grid.cells[2]);
  parallel_for(grid.distances.size(), [&](std::size_t i) {
    const double share = nearest.closest(grid.center(i)).distance_m / grid.truncation_m;
    grid.distances[i] = static_cast<std::uint8_t>(std::lround(kFarByte * std::min(share, 1.0)));
  });
  return grid;
}

std::vector<std::uint32_t> geometry_words(const SearchGrid& grid, const LengthScale& scale) {
  const auto word = [&](double metres) { return static_cast<std::uint32_t>(scale.to_word(metres)); };
  return {word(grid.origin.x()), word(grid.origin.y()), word(grid.origin.z()),   word(grid.cell_m), grid.cells[0],
          grid.cells[1],         grid.cells[2],         word(grid.truncation_m), word(grid.size_m)};
}

std::vector<std::uint32_t> distance_words(const SearchGrid& grid) {
  std::vector<std::uint32_t> words;
  for (std::size_t i = 0; i < grid.distances.size(); i += 4) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 4; ++k) word = word << 8 | grid.distances[i + k];
    words.push_back(word);
  }
  return words;
}

}  // namespace lasso::mdat
