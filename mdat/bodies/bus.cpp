#include "mdat/bodies/bus.hpp"

#include <algorithm>

#include "fsw/geometry/portable_math.hpp"

namespace lasso::mdat {
namespace {

Pad side_pad(double azimuth_deg, double reach, double half_a, double half_t, double radius) {
  return {false, azimuth_deg, 1, reach, half_a, half_t, radius};
}

Pad end_pad(double sign, double reach, double half_a, double half_t) { return {true, 0, sign, reach, half_a, half_t, 0}; }

Bus box_bus(bool cube, Fitter& fitter) {
  const double y = fitter.draw(0.5, 1.1), z = cube ? y : fitter.draw(0.5, 1.1);
  fitter.add("bus", "bus", fitter.text().box({1, y, z}, {}, {}));
  Bus bus;
  bus.what = cube ? "box of square section" : "box";
  bus.folds = cube ? 4 : 2;
  for (int i = 0; i < 4; ++i) bus.sides.push_back(side_pad(90 * i, 0.5 * (i % 2 == 0 ? y : z), 0.5, 0.5 * (i % 2 == 0 ? z : y), 0));
  bus.front = end_pad(1, 0.5, 0.5 * y, 0.5 * z);
  bus.back = end_pad(-1, 0.5, 0.5 * y, 0.5 * z);
  return bus;
}

Bus prism_bus(int sides, Fitter& fitter) {
  fitter.round_for(sides);
  const double reach = fitter.draw(0.3, 0.6);
  const SinCos half = sin_cos(kPi / sides);
  const double corner = reach / half.cos, inner = 0.68 * reach;
  fitter.add("bus", "bus", fitter.text().revolve({{-0.5, 0}, {-0.5, corner}, {0.5, corner}, {0.5, 0}}, 180.0 / sides, sides, {}, {}));
  Bus bus;
  bus.what = std::to_string(sides) + "-sided prism";
  bus.folds = sides;
  for (int i = 0; i < sides; ++i) bus.sides.push_back(side_pad(360.0 * i / sides, reach, 0.5, reach * half.sin / half.cos, 0));
  bus.front = end_pad(1, 0.5, inner, inner);
  bus.back = end_pad(-1, 0.5, inner, inner);
  return bus;
}

Bus cylinder_bus(Fitter& fitter) {
  constexpr int kPads = 12;  // all symmetries that are drawn divide it
  const double r = fitter.draw(0.3, 0.6);
  fitter.add("bus", "bus", fitter.text().revolve({{-0.5, 0}, {-0.5, r}, {0.5, r}, {0.5, 0}}, 0, fitter.round_sides(), {}, {}));
  Bus bus;
  bus.what = "cylinder";
  bus.folds = kPads;
  for (int i = 0; i < kPads; ++i) bus.sides.push_back(side_pad(360.0 * i / kPads, r, 0.5, 0.23 * r, r));
  bus.front = end_pad(1, 0.5, 0.68 * r, 0.68 * r);
  bus.back = end_pad(-1, 0.5, 0.68 * r, 0.68 * r);
  return bus;
}

}  // namespace

Bus draw_bus(BusShape shape, int prism_sides, Fitter& fitter) {
  Bus bus = shape == BusShape::kPrism      ? prism_bus(prism_sides, fitter)
            : shape == BusShape::kCylinder ? cylinder_bus(fitter)
                                           : box_bus(shape == BusShape::kCube, fitter);
  bus.length = 1;
  return bus;
}

void add_upper_stage(Bus& bus, bool round, Fitter& fitter) {
  const double half = std::min(bus.front.half_a, bus.front.half_t), height = fitter.draw(0.15, 0.5);
  const double foot = std::max(0.02, fitter.text().thinnest());
  if (!round && fitter.chance(0.4)) {
    const double y = fitter.draw(0.5, 0.9) * bus.front.half_a, z = fitter.draw(0.5, 0.9) * bus.front.half_t;
    const Cell whole{bus.front, 0, 0, y, z};
    fitter.add("upper stage", "upper stage",
               fitter.text().box({height + foot, 2 * y, 2 * z}, placed(whole, {PlaceStep::move({0.5 * (height - foot), 0, 0})}), {}));
    bus.front.half_a = y;
    bus.front.half_t = z;
  } else {
    const double wide = fitter.draw(0.6, 0.95) * half, narrow = fitter.chance(0.5) ? wide : fitter.draw(0.4, 0.8) * wide;
    fitter.add("upper stage", "upper stage",
               fitter.text().revolve({{-foot, 0}, {-foot, wide}, {0, wide}, {height, narrow}, {height, 0}}, 0, fitter.round_sides(),
                                     placed({bus.front, 0, 0, 0, 0}), {}));
    bus.front.half_a = bus.front.half_t = 0.68 * narrow;
  }
  bus.front.reach += height;
  bus.what += " with an upper stage";
}

double row_middle(const Bus& bus, int row) { return bus.length * (row - 0.5 * (kRows - 1)) / kRows; }

std::vector<Cell> row_cells(const Bus& bus, const Pad& pad, int row) {
  const double half_a = 0.42 * bus.length / kRows, a = row_middle(bus, row);
  if (pad.half_t < 0.3) return {{pad, a, 0, half_a, 0.85 * pad.half_t}};
  return {{pad, a, -0.5 * pad.half_t, half_a, 0.42 * pad.half_t}, {pad, a, 0.5 * pad.half_t, half_a, 0.42 * pad.half_t}};
}

std::vector<Cell> end_cells(const Pad& pad) {
  std::vector<Cell> cells;
  for (const double a : {-0.5, 0.5}) {
    for (const double t : {-0.5, 0.5}) cells.push_back({pad, a * pad.half_a, t * pad.half_t, 0.42 * pad.half_a, 0.42 * pad.half_t});
  }
  return cells;
}

}  // namespace lasso::mdat
