// The distance grid that the search for a first pose scores its hypotheses on.
#pragma once

#include <cstdint>
#include <vector>

#include "mdat/modelc/near_field.hpp"

namespace lasso::mdat {

constexpr double kTruncationShare = 0.10;  // of the model's largest extent
constexpr double kSearchCellsPerExtent = 48;

struct SearchGrid {
  Vec3d origin = Vec3d::Zero();
  double cell_m = 0, truncation_m = 0, size_m = 0;
  std::array<std::uint32_t, 3> cells{};
  std::vector<std::uint8_t> distances;  // as in image_format.hpp

  Vec3d center(std::size_t cell) const;
  double distance_m(const Vec3d& p) const;  // of the cell that holds the point
};

// Over the bounding box and the truncation beyond it.
SearchGrid make_search_grid(const Surface& surface, const NearestSearch& nearest, const LengthScale& scale);

std::vector<std::uint32_t> geometry_words(const SearchGrid& grid, const LengthScale& scale);  // table kSearchGrid
std::vector<std::uint32_t> distance_words(const SearchGrid& grid);                            // table kDistances

}  // namespace lasso::mdat
