// The list of one cell as the image holds it: in the order in which it is worth asking, with the hits after which none need be asked for.
#pragma once

#include <vector>

#include "mdat/modelc/elements.hpp"

namespace lasso::mdat {

// The cube around a cell in which a sample of the field sees hits.
struct SampleCube {
  Vec3d center = Vec3d::Zero();
  double half_m = 0;
};

// Entries of table kRayLists for these elements, all of which meet the cube: largest share of the cube first, the lower index where they
// are alike. An entry is final (kFinalEntry) where no ray that meets the element's front within the cube can have met another one of the
// list before it there, by more than `tolerance_m` measured across either one's plane.
std::vector<std::uint32_t> make_cell_list(const std::vector<Element>& elements, const std::vector<std::uint32_t>& indices,
                                          const SampleCube& cube, double tolerance_m);

}  // namespace lasso::mdat
