// The grid of cells and bricks over the model, in the image's own numbers.
#pragma once

#include "mdat/modelc/elements.hpp"

namespace lasso::mdat {

constexpr std::uint32_t kBrickCells = 8;  // cells along a brick's edge
constexpr std::uint32_t kMaxBricksPerAxis = 1023;

struct Grid {
  Vec3d origin = Vec3d::Zero();  // the corner of cell (0, 0, 0)
  double cell_m = 0;
  std::array<std::uint32_t, 3> bricks{};

  std::uint32_t brick_count() const { return bricks[0] * bricks[1] * bricks[2]; }
  std::uint32_t cells(std::size_t axis) const { return kBrickCells * bricks[axis]; }
  double brick_m() const { return kBrickCells * cell_m; }
  std::uint32_t brick_index(std::uint32_t x, std::uint32_t y, std::uint32_t z) const { return (z * bricks[1] + y) * bricks[0] + x; }
  std::array<std::uint32_t, 3> brick_place(std::uint32_t index) const {
    return {index % bricks[0], index / bricks[0] % bricks[1], index / bricks[0] / bricks[1]};
  }
  Vec3d brick_corner(std::uint32_t index) const {
    const auto place = brick_place(index);
    return origin + brick_m() * Vec3d(place[0], place[1], place[2]);
  }
  Vec3d brick_center(std::uint32_t index) const { return brick_corner(index) + Vec3d::Constant(brick_m() / 2); }
};

// Farthest that any length of the image can be from zero, before rounding.
double image_reach_m(const Surface& surface, double margin_m, double cell_m);

// Whole bricks over the bounding box and its margin, centred; at least two cells of margin. Throws CompileError over kMaxBricksPerAxis or
// where the bricks alone would exceed kMaxImageBytes.
Grid make_grid(const Surface& surface, double margin_m, double cell_m, const LengthScale& scale);

}  // namespace lasso::mdat
