// The main solid of a spacecraft, and where fittings find room on it. Inside of bodies.
#pragma once

#include "mdat/bodies/fittings.hpp"

namespace lasso::mdat {

struct Bus {
  std::string what;        // "box", "6-sided prism"
  std::vector<Pad> sides;  // in equal steps about the x axis, but those of a box of unequal sides
  Pad front, back;
  double length = 0;
  int folds = 1;  // so many equal turns about x bring it on itself
};

enum class BusShape : std::uint8_t { kBox, kCube, kPrism, kCylinder };

// Adds the bus to the body: a length of 1 along x about the origin. A prism has `prism_sides`, from 4 to 10: twelve would meet at 30 deg,
// where the model compiler begins to smooth.
Bus draw_bus(BusShape shape, int prism_sides, Fitter& fitter);

// Puts a narrower solid on the bus's front: a box, cylinder or cone; with `round` never a box. The front pad is then its.
void add_upper_stage(Bus& bus, bool round, Fitter& fitter);

constexpr int kRows = 3;  // of cells along the bus
// The row's middle.
double row_middle(const Bus& bus, int row);
// Of a pad's row: one cell, or two beside each other where the pad is wide.
std::vector<Cell> row_cells(const Bus& bus, const Pad& pad, int row);
std::vector<Cell> end_cells(const Pad& pad);

}  // namespace lasso::mdat
