// The motions that bring the model nearly on itself: the poses that a search confuses.
#pragma once

#include "mdat/modelc/search_grid.hpp"
#include "mdat/modelc/view_table.hpp"

namespace lasso::mdat {

struct NearSymmetryMotion {
  Eigen::Quaterniond q;
  Vec3d p;              // x' = q x + p
  double mismatch = 0;  // mean distance of the moved surface from the model over the truncation, each at most 1
};

// At most kMaxSymmetries, best first, each other than none and apart from the others by at least kSymmetryApart_rad. Rotations about the
// middle of the visible surface in steps of some 12 deg, the best of them refined. Deterministic.
constexpr double kSymmetryApart_rad = 0.35;
std::vector<NearSymmetryMotion> find_near_symmetries(const std::vector<View>& views, const SearchGrid& grid, const NearestSearch& nearest);

std::vector<std::uint32_t> symmetry_words(const std::vector<NearSymmetryMotion>& motions, const LengthScale& scale);

}  // namespace lasso::mdat
