#include "mdat/bodies/craft.hpp"

#include <algorithm>
#include <cmath>

#include "mdat/bodies/bus.hpp"

namespace lasso::mdat {
namespace {

constexpr const char* kArrayAngle = "array_angle_deg";
constexpr const char* kDoorAngle = "door_angle_deg";

std::string counted(int count, const std::string& name) {
  return std::to_string(count) + " " + name + (count == 1 ? "" : name.back() == 'h' ? "es" : "s");
}

// "with 2 wings, 1 dish and 3 small parts": those that there are.
std::string with(const std::string& what, const std::vector<std::pair<int, std::string>>& counts) {
  std::vector<std::string> words;
  for (const auto& [count, name] : counts) {
    if (count > 0) words.push_back(counted(count, name));
  }
  std::string text = what;
  for (std::size_t i = 0; i < words.size(); ++i) text += (i == 0 ? " with " : i + 1 == words.size() ? " and " : ", ") + words[i];
  return text;
}

// Cells of the bus that are free, and how they are taken.
class Room {
 public:
  explicit Room(const Bus& bus) {
    for (const Pad& pad : bus.sides) {
      for (int row = 0; row < kRows; ++row) add(row_cells(bus, pad, row));
    }
    add(end_cells(bus.front));
    add(end_cells(bus.back));
  }
  // Drops the cells of the pad (a side by its azimuth, an end by its sign).
  void close(const Pad& pad) {
    std::erase_if(cells_, [&](const Cell& cell) { return is_same(cell.pad, pad); });
  }
  bool empty() const { return cells_.empty(); }
  Cell take(Fitter& fitter) {
    const auto place = cells_.begin() + static_cast<std::ptrdiff_t>(fitter.pick(cells_.size()));
    const Cell cell = *place;
    cells_.erase(place);
    return cell;
  }

 private:
  static bool is_same(const Pad& a, const Pad& b) {
    return a.end == b.end && (a.end ? a.sign == b.sign : std::fabs(a.azimuth_deg - b.azimuth_deg) < 1e-6);
  }
  void add(const std::vector<Cell>& cells) { cells_.insert(cells_.end(), cells.begin(), cells.end()); }

  std::vector<Cell> cells_;
};

void add_array_angle(Body& body, Fitter& fitter) {
  const double preset_deg = fitter.chance(0.3) ? 0 : 5 * std::floor(fitter.draw(-12, 13));
  body.parameters.push_back({kArrayAngle, "turn of the solar arrays about their axes", preset_deg, -180, 180});
}

WingShape draw_wing(Fitter& fitter) {
  WingShape shape;
  shape.length = fitter.draw(0.8, 2.6);
  shape.width = fitter.draw(0.35, 0.85);
  shape.thickness = std::max(fitter.draw(0.018, 0.035), fitter.text().thinnest());
  shape.panels = 1 + static_cast<int>(fitter.pick(4));
  shape.cant_deg = fitter.chance(0.25) ? 5 * std::floor(fitter.draw(-5, 6)) : 0;
  shape.parameter = kArrayAngle;
  return shape;
}

// So many wings in equal steps about the bus, as far as its sides allow; opposite ones lie in one plane.
void add_wings(Body& body, const Bus& bus, int count, Room& room, Fitter& fitter) {
  if (count == 0) return;
  add_array_angle(body, fitter);
  const WingShape shape = draw_wing(fitter);
  const double a = fitter.chance(0.6) ? 0 : row_middle(bus, fitter.chance(0.5) ? 0 : kRows - 1);
  const std::size_t first = fitter.pick(bus.sides.size());
  const bool unequal = count == 2 && fitter.chance(0.15);
  for (int i = 0; i < count; ++i) {
    const Pad& pad =
        bus.sides[(first + static_cast<std::size_t>(i) * bus.sides.size() / static_cast<std::size_t>(count)) % bus.sides.size()];
    WingShape each = shape;
    if (2 * i >= count) each.parameter = std::string("-") + kArrayAngle;
    if (unequal && i == 1) each.length *= 0.6;
    fitter.wing(pad, a, each);
    room.close(pad);
  }
}

int draw_wing_count(Fitter& fitter) {
  const double share = fitter.draw(0, 1);
  return share < 0.1 ? 0 : share < 0.3 ? 1 : share < 0.85 ? 2 : 4;
}

void add_door(Body& body, const Pad& pad, double radius, Fitter& fitter) {
  body.parameters.push_back({kDoorAngle, "how far the door is open", fitter.chance(0.3) ? 0 : 5 * std::floor(fitter.draw(6, 25)), 0, 180});
  fitter.door(pad, radius, kDoorAngle);
}

void add_end_fitting(Body& body, const Pad& pad, Room& room, Fitter& fitter) {
  const double half = std::min(pad.half_a, pad.half_t), share = fitter.draw(0, 1);
  const Cell whole{pad, 0, 0, pad.half_a, pad.half_t};
  if (share < 0.35) {
    const double tilt_deg = fitter.chance(0.5) ? 0 : 5 * std::floor(fitter.draw(1, 10));
    fitter.dish(whole, fitter.draw(0.5, 0.95) * half, tilt_deg);
  } else if (share < 0.6) {
    fitter.nozzle(whole, fitter.draw(0.3, 0.6) * half);
  } else if (share < 0.8) {
    fitter.docking_ring(pad);
  } else if (share < 0.9 && fitter.count_of("door") == 0) {
    add_door(body, pad, 0.95 * half, fitter);
  } else {
    return;
  }
  room.close(pad);
}

BusShape draw_shape(Fitter& fitter) {
  const double share = fitter.draw(0, 1);
  return share < 0.35 ? BusShape::kBox : share < 0.5 ? BusShape::kCube : share < 0.75 ? BusShape::kPrism : BusShape::kCylinder;
}

// A bus with wings, and the room that is left.
struct Craft {
  Bus bus;
  Room room;
};

Craft draw_craft(Body& body, Fitter& fitter) {
  const BusShape shape = draw_shape(fitter);
  Bus bus = draw_bus(shape, 4 + static_cast<int>(fitter.pick(7)), fitter);
  if (fitter.chance(0.3)) add_upper_stage(bus, shape == BusShape::kCylinder, fitter);
  Craft craft{bus, Room(bus)};
  add_wings(body, bus, draw_wing_count(fitter), craft.room, fitter);
  return craft;
}

void add_small_parts(int count, Room& room, Fitter& fitter) {
  for (int i = 0; i < count && !room.empty(); ++i) fitter.add_small(room.take(fitter));
}

// What all around it there is, in `folds` equal steps.
void add_rings(Body& body, const Bus& bus, int folds, Fitter& fitter) {
  const Repeat repeat{folds, 360.0 / folds};
  const bool winged = fitter.chance(0.6);
  const std::size_t stride = bus.sides.size() / static_cast<std::size_t>(folds);
  for (int row = 0; row < kRows; ++row) {
    const Pad& pad = bus.sides[fitter.pick(stride)];
    if (winged && row == 1) {
      add_array_angle(body, fitter);
      fitter.wing(pad, 0, draw_wing(fitter), repeat);
    } else if (fitter.chance(0.6)) {
      Cell cell = row_cells(bus, pad, row).front();
      if (fitter.chance(0.5)) cell.t = 0;
      fitter.add_small(cell, repeat);
    }
  }
}

int draw_folds(const Bus& bus, Fitter& fitter) {
  std::vector<int> folds;
  for (int n = 2; n <= bus.folds && n <= 8; ++n) {
    if (bus.folds % n == 0) folds.push_back(n);
  }
  return folds[fitter.pick(folds.size())];
}

// Coaxial, with each turn about the axis on itself.
void add_axial_end(const Pad& pad, Fitter& fitter) {
  const double half = std::min(pad.half_a, pad.half_t), share = fitter.draw(0, 1);
  const Cell whole{pad, 0, 0, pad.half_a, pad.half_t};
  if (share < 0.3) fitter.dish(whole, fitter.draw(0.5, 0.95) * half, 0);
  if (share >= 0.3 && share < 0.55) fitter.nozzle(whole, fitter.draw(0.3, 0.6) * half);
  if (share >= 0.55 && share < 0.75) fitter.docking_ring(pad);
}

// A box or cylinder of 5 to 12 % of the bus, where no turn brings it on another.
void break_symmetry(const Bus& bus, Fitter& fitter) {
  const Pad& pad = bus.sides[fitter.pick(bus.sides.size())];
  const double half = std::min(fitter.draw(0.03, 0.08), 0.8 * pad.half_t), height = fitter.draw(0.05, 0.15), foot = 0.03;
  const Cell cell{pad, fitter.chance(0.5) ? 0.43 : -0.43, 0, half, half};
  if (fitter.chance(0.5)) {
    fitter.add(
        "odd box", "odd box",
        fitter.text().box({height + foot, 1.6 * half, 2 * half}, placed(cell, {PlaceStep::move({0.5 * (height - foot), 0, 0})}), {}));
  } else {
    fitter.add("odd cylinder", "odd cylinder", fitter.text().rod({-foot, 0, 0}, {height, 0, 0}, half, half, 16, placed(cell), {}));
  }
}

int small_parts(const Body& body) {
  std::vector<std::string> names;
  for (const BodyPart& part : body.parts) {
    const std::string& name = part.assembly;
    const bool large = name == "bus" || name == "upper stage" || name.rfind("wing", 0) == 0 || name.rfind("dish", 0) == 0;
    if (!large && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return static_cast<int>(names.size());
}

}  // namespace

std::string draw_plain(Body& body, Fitter& fitter) {
  auto [bus, room] = draw_craft(body, fitter);
  if (fitter.chance(0.6)) add_end_fitting(body, bus.front, room, fitter);
  add_small_parts(static_cast<int>(fitter.pick(3)), room, fitter);
  return with(bus.what, {{fitter.count_of("wing"), "wing"}, {fitter.count_of("dish"), "dish"}, {small_parts(body), "other part"}});
}

std::string draw_cluttered(Body& body, Fitter& fitter) {
  auto [bus, room] = draw_craft(body, fitter);
  add_end_fitting(body, bus.front, room, fitter);
  add_end_fitting(body, bus.back, room, fitter);
  for (std::size_t booms = fitter.pick(4); booms > 0 && !room.empty(); --booms) {
    const double length = fitter.draw(0.4, 1.6);
    fitter.boom(room.take(fitter), length);
  }
  if (fitter.chance(0.4) && !room.empty()) {
    const Cell cell = room.take(fitter);
    const double tilt_deg = 5 * std::floor(fitter.draw(0, 10));
    fitter.dish(cell, fitter.draw(0.8, 1.1) * cell.half(), tilt_deg);
  }
  add_small_parts(6 + static_cast<int>(fitter.pick(15)), room, fitter);
  return with(bus.what, {{fitter.count_of("wing"), "wing"}, {fitter.count_of("dish"), "dish"}, {small_parts(body), "other part"}});
}

std::string draw_symmetric(Body& body, Fitter& fitter, bool broken) {
  const BusShape shape = draw_shape(fitter);
  Bus bus = draw_bus(shape, 4 + static_cast<int>(fitter.pick(7)), fitter);
  if (fitter.chance(0.2)) add_upper_stage(bus, true, fitter);
  const int folds = draw_folds(bus, fitter);
  add_rings(body, bus, folds, fitter);
  const int all = small_parts(body);
  if (fitter.chance(0.6)) add_axial_end(bus.front, fitter);
  if (fitter.chance(0.4)) add_axial_end(bus.back, fitter);
  if (all == 0 && body.parameters.empty()) fitter.box(row_cells(bus, bus.sides[0], 1).front(), {folds, 360.0 / folds});
  if (broken) break_symmetry(bus, fitter);
  return bus.what + " with parts in " + std::to_string(folds) + " equal steps about its axis" + (broken ? ", but for one small part" : "");
}

}  // namespace lasso::mdat
