#include "mdat/modelc/grid.hpp"

#include <algorithm>
#include <cmath>

#include "cfg/capacities.hpp"

namespace lasso::mdat {
namespace {

constexpr double kMarginCells = 2;

}  // namespace

double image_reach_m(const Surface& surface, double margin_m, double cell_m) {
  const double corner = surface.low.cwiseAbs().cwiseMax(surface.high.cwiseAbs()).norm();
  return corner + margin_m + (kBrickCells + kMarginCells) * cell_m;
}

Grid make_grid(const Surface& surface, double margin_m, double cell_m, const LengthScale& scale) {
  Grid grid;
  grid.cell_m = scale.round(cell_m);
  const double margin = std::max(margin_m, kMarginCells * grid.cell_m);
  double bytes = 4.0 * (kBrickWords + kFootWords);
  for (int axis = 0; axis < 3; ++axis) {
    const double length = surface.high[axis] - surface.low[axis] + 2 * margin;
    const double bricks = std::ceil(length / grid.brick_m());
    if (!(bricks <= kMaxBricksPerAxis)) {
      fail<LargeFieldError>("the grid needs ", bricks, " bricks of ", grid.brick_m(), " m along axis ", axis, "; the limit is ",
                            kMaxBricksPerAxis, ": take larger cells");
    }
    bytes *= bricks;
    grid.bricks[static_cast<std::size_t>(axis)] = static_cast<std::uint32_t>(bricks);
    grid.origin[axis] = scale.round(surface.low[axis] - margin - (bricks * grid.brick_m() - length) / 2);
  }
  if (bytes > static_cast<double>(kMaxImageBytes)) {
    fail<LargeFieldError>("the grid's bricks alone need ", bytes, " bytes; the limit of an image is ", kMaxImageBytes,
                          ": take larger cells");
  }
  return grid;
}

}  // namespace lasso::mdat
