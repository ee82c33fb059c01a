#include "mdat/bodies/fittings.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "fsw/geometry/portable_math.hpp"

namespace lasso::mdat {
namespace {

constexpr int kRodSides = 12;
constexpr int kStemSides = 16;

// A closed half circle from one pole to the other about (center, 0), as a profile.
std::vector<std::pair<double, double>> circle_profile(double center, double radius) {
  constexpr int kSteps = 9;
  std::vector<std::pair<double, double>> profile;
  for (int i = 0; i <= kSteps; ++i) {
    const SinCos angle = sin_cos(kPi * i / kSteps);
    profile.emplace_back(center - radius * angle.cos, i == 0 || i == kSteps ? 0 : radius * angle.sin);
  }
  return profile;
}

}  // namespace

Place placed(const Cell& cell, Place own) {
  const Pad& pad = cell.pad;
  if (pad.end) {
    own.push_back(PlaceStep::move({pad.reach, cell.a, cell.t}));
    if (pad.sign < 0) own.push_back(PlaceStep::turned(Vec3::UnitZ(), 180));
    return own;
  }
  own.push_back(PlaceStep::turned(Vec3::UnitZ(), 90));
  own.push_back(PlaceStep::move({cell.a, pad.reach, cell.t}));
  if (pad.azimuth_deg != 0) own.push_back(PlaceStep::turned(Vec3::UnitX(), pad.azimuth_deg));
  return own;
}

void Fitter::round_for(int folds) {
  const auto at_least = [&](int sides) { return folds * ((sides + folds - 1) / folds); };
  if (48 % folds == 0) return;
  round_sides_ = at_least(40);
  mast_sides_ = at_least(18);
}

double Fitter::foot(const Pad& pad, double half_width) const {
  const double least = std::max(0.012, text_.thinnest());
  if (pad.radius <= 0) return least;
  const double within = std::max(0.0, pad.radius * pad.radius - half_width * half_width);
  constexpr double kFacet = 0.003;  // a cylinder of 48 sides lies so much of its radius within its circle
  return least + pad.radius - std::sqrt(within) + kFacet * pad.radius;
}

void Fitter::add_small(const Cell& cell, const Repeat& repeat) {
  using Fitting = void (Fitter::*)(const Cell&, const Repeat&);
  constexpr std::array<Fitting, 9> kAll{&Fitter::box,      &Fitter::box,          &Fitter::radiator,
                                        &Fitter::thruster, &Fitter::tank,         &Fitter::star_tracker,
                                        &Fitter::handrail, &Fitter::whip_antenna, &Fitter::horn_antenna};
  (this->*kAll[pick(kAll.size())])(cell, repeat);
}

void Fitter::box(const Cell& cell, const Repeat& repeat) {
  const std::string name = numbered("box");
  const double a = draw(0.4, 0.95) * cell.half_a, t = draw(0.4, 0.95) * cell.half_t;
  const double height = draw(0.4, 1.4) * std::min(a, t), sink = foot(cell.pad, t);
  add(name, name, text_.box({height + sink, 2 * a, 2 * t}, placed(cell, {PlaceStep::move({0.5 * (height - sink), 0, 0})}), repeat));
}

void Fitter::radiator(const Cell& cell, const Repeat& repeat) {
  const std::string name = numbered("radiator");
  const double a = draw(0.8, 1) * cell.half_a, t = draw(0.7, 1) * cell.half_t;
  const double height = std::max(draw(0.02, 0.05), 2 * text_.thinnest()), sink = foot(cell.pad, t);
  add(name, name, text_.box({height + sink, 2 * a, 2 * t}, placed(cell, {PlaceStep::move({0.5 * (height - sink), 0, 0})}), repeat));
}

void Fitter::thruster(const Cell& cell, const Repeat& repeat) {
  const std::string name = numbered("thruster");
  const double r = std::max(draw(0.35, 0.7) * cell.half(), 3 * text_.thinnest());
  const double length = draw(1.6, 2.4) * r, sink = foot(cell.pad, r);
  add(name, name,
      text_.revolve({{-sink, 0},
                     {-sink, 0.6 * r},
                     {0.3 * length, 0.5 * r},
                     {length, r},
                     {length, 0.8 * r},
                     {0.5 * length, 0.3 * r},
                     {0.5 * length, 0}},
                    0, 24, placed(cell), repeat));
}

void Fitter::tank(const Cell& cell, const Repeat& repeat) {
  const std::string name = numbered("tank");
  const double r = draw(0.6, 0.95) * cell.half();
  add(name, name, text_.revolve(circle_profile(draw(0.2, 0.6) * r - foot(cell.pad, 0), r), 0, 24, placed(cell), repeat));
}

void Fitter::star_tracker(const Cell& cell, const Repeat& repeat) {
  const std::string name = numbered("star tracker");
  const double half = draw(0.4, 0.6) * cell.half(), height = draw(0.8, 1.2) * half, sink = foot(cell.pad, half);
  const double tilt_deg = 5 * std::floor(draw(4, 12));
  add(name + ", foot", name,
      text_.box({height + sink, 2 * half, 2 * half}, placed(cell, {PlaceStep::move({0.5 * (height - sink), 0, 0})}), repeat));
  add(name + ", baffle", name,
      text_.rod(Vec3::Zero(), 2.2 * half * Vec3::UnitX(), 0.5 * half, 0.8 * half, 24,
                placed(cell, {PlaceStep::turned(Vec3::UnitZ(), tilt_deg), PlaceStep::move({0.8 * height, 0, 0})}), repeat));
}

void Fitter::handrail(const Cell& cell, const Repeat& repeat) {
  const std::string name = numbered("handrail");
  const double r = std::max(0.012, text_.thinnest()), half = 0.95 * cell.half_a, height = 5 * r;
  add(name + ", rail", name, text_.rod({height, -half, 0}, {height, half, 0}, r, r, 8, placed(cell), repeat));
  for (const double side : {-1.0, 1.0}) {
    const double a = side * (half - 2 * r);
    add(name + ", standoff", name, text_.rod({-foot(cell.pad, r), a, 0}, {height, a, 0}, 0.9 * r, 0.9 * r, 8, placed(cell), repeat));
  }
}

void Fitter::whip_antenna(const Cell& cell, const Repeat& repeat) {
  const std::string name = numbered("whip antenna");
  const double length = draw(0.15, 0.5), r = std::max(0.008, text_.thinnest());
  const double tilt_deg = 5 * std::floor(draw(0, 7));
  add(name, name,
      text_.rod({-foot(cell.pad, 3 * r), 0, 0}, {length, 0, 0}, 1.2 * r, r, 8, placed(cell, {PlaceStep::turned(Vec3::UnitY(), tilt_deg)}),
                repeat));
}

void Fitter::horn_antenna(const Cell& cell, const Repeat& repeat) {
  const std::string name = numbered("horn antenna");
  const double r = draw(0.35, 0.6) * cell.half(), length = draw(1.5, 3) * r;
  add(name + ", stem", name,
      text_.rod({-foot(cell.pad, 0.4 * r), 0, 0}, {0.6 * length, 0, 0}, 0.4 * r, 0.4 * r, kStemSides, placed(cell), repeat));
  add(name + ", horn", name, text_.rod({0.5 * length, 0, 0}, {length, 0, 0}, 0.5 * r, r, 24, placed(cell), repeat));
}

void Fitter::boom(const Cell& cell, double length, const Repeat& repeat) {
  const std::string name = numbered("boom");
  const double r = std::max(0.014, text_.thinnest()), tip = std::max(draw(0.03, 0.07), 2 * r);
  const Place cant{PlaceStep::turned(Vec3::UnitZ(), 5 * std::floor(draw(-4, 5)))};
  add(name + ", rod", name, text_.rod({-foot(cell.pad, 2 * r), 0, 0}, {length, 0, 0}, r, 0.8 * r, kRodSides, placed(cell, cant), repeat));
  Place at_tip{PlaceStep::move({length, 0, 0})};
  at_tip.insert(at_tip.end(), cant.begin(), cant.end());
  add(name + ", tip", name, text_.box({2 * tip, 1.6 * tip, 1.3 * tip}, placed(cell, at_tip), repeat));
}

void Fitter::dish(const Cell& cell, double radius, double tilt_deg, const Repeat& repeat) {
  const std::string name = numbered("dish");
  const double depth = draw(0.22, 0.36) * radius, thick = std::max(0.04 * radius, text_.thinnest());
  const double focus = 0.25 * radius * radius / depth;
  const double height = radius * (0.15 + 0.7 * tilt_deg / 45) + 2 * thick;  // so that a tilted rim clears the surface
  const auto tilted = [&](double h) { return placed(cell, {PlaceStep::turned(Vec3::UnitZ(), tilt_deg), PlaceStep::move({h, 0, 0})}); };
  add(name + ", mast", name,
      text_.rod({-foot(cell.pad, 0.12 * radius), 0, 0}, {height - 0.5 * thick, 0, 0}, 0.12 * radius, 0.07 * radius, mast_sides_,
                placed(cell), repeat));
  add(name + ", reflector", name, text_.dish(radius, depth, thick, 5, round_sides_, tilted(height), repeat));
  add(name + ", feed", name,
      text_.rod({-0.5 * thick, 0, 0}, {focus, 0, 0}, 0.04 * radius, 0.04 * radius, mast_sides_, tilted(height), repeat));
  add(name + ", horn", name,
      text_.rod({0.9 * focus, 0, 0}, {1.1 * focus, 0, 0}, 0.1 * radius, 0.06 * radius, mast_sides_, tilted(height), repeat));
}

void Fitter::docking_ring(const Pad& pad) {
  const std::string name = numbered("docking ring");
  const double r = draw(0.55, 0.85) * std::min(pad.half_a, pad.half_t), sink = foot(pad, 0);
  const double wall = std::max(0.12 * r, 2 * text_.thinnest()), height = draw(0.15, 0.4) * r;
  add(name, name,
      text_.revolve({{-sink, r - wall}, {height, r - wall}, {height, r}, {-sink, r}}, 0, round_sides_, placed({pad, 0, 0, 0, 0}), {}));
}

void Fitter::door(const Pad& pad, double radius, const std::string& parameter) {
  const std::string name = numbered("door");
  const double thick = std::max(0.05 * radius, text_.thinnest()), gap = 0.5 * thick, half = 0.25 * radius, sink = foot(pad, 0);
  const Cell whole{pad, 0, 0, 0, 0};
  const Vec3 hinge(gap + thick, -radius, 0);
  add(name + ", hinge", name,
      text_.box({2 * thick + gap + sink, 3 * thick, 2 * half},
                placed(whole, {PlaceStep::move({0.5 * (2 * thick + gap - sink), -radius, 0})}), {}));
  add(name + ", lid", name,
      text_.rod({gap, 0, 0}, {gap + thick, 0, 0}, radius, radius, round_sides_,
                placed(whole, {PlaceStep::turned_by(Vec3::UnitZ(), parameter, hinge)}), {}));
}

void Fitter::nozzle(const Cell& cell, double radius, const Repeat& repeat) {
  const std::string name = numbered("nozzle");
  const double length = draw(1.4, 2.2) * radius, wall = std::max(0.08 * radius, text_.thinnest()), sink = foot(cell.pad, 0.5 * radius);
  add(name, name,
      text_.revolve({{-sink, 0},
                     {-sink, 0.4 * radius},
                     {0.2 * length, 0.4 * radius},
                     {0.5 * length, 0.75 * radius},
                     {length, radius},
                     {length, radius - wall},
                     {0.5 * length, 0.75 * radius - wall},
                     {0.25 * length, 0.25 * radius},
                     {0.25 * length, 0}},
                    0, round_sides_, placed(cell), repeat));
}

void Fitter::wing(const Pad& pad, double a, const WingShape& shape, const Repeat& repeat) {
  const std::string name = numbered("wing");
  const Cell cell{pad, a, 0, 0, 0};
  const double swept = sin_cos(std::fabs(shape.cant_deg) * kRadPerDeg).sin;
  const double gap = 0.1 + 0.5 * shape.width * swept, between = 0.03 * shape.length;
  const double panel = (shape.length - (shape.panels - 1) * between) / shape.panels;
  const double spar = std::max(0.7 * shape.thickness, text_.thinnest());
  Place cant;
  if (shape.cant_deg != 0) cant.push_back(PlaceStep::turned(Vec3::UnitZ(), -shape.cant_deg));
  add(name + ", spar", name,
      text_.rod({-foot(pad, 2 * spar), 0, 0}, {gap + shape.length - 0.1 * panel, 0, 0}, spar, spar, kRodSides, placed(cell, cant), repeat));
  for (int i = 0; i < shape.panels; ++i) {
    Place own{PlaceStep::move({gap + 0.5 * panel + i * (panel + between), 0, 0}), PlaceStep::turned_by(Vec3::UnitX(), shape.parameter)};
    own.insert(own.end(), cant.begin(), cant.end());
    add(name + ", panel " + std::to_string(i + 1), name, text_.box({panel, shape.width, shape.thickness}, placed(cell, own), repeat));
  }
}

}  // namespace lasso::mdat
