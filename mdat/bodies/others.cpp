// Bodies that are no spacecraft in use.
#include <algorithm>
#include <cmath>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/bodies/bus.hpp"
#include "mdat/bodies/craft.hpp"

namespace lasso::mdat {
namespace {

constexpr int kBareSides = 96;

// The hull of a stage: tank, a cone in front of it, a dome behind.
struct Stage {
  double radius = 0, half = 0;  // of the cylinder
  double front = 0, front_radius = 0;
  double back = 0, back_radius = 0;  // where the dome ends
};

Stage draw_hull(Fitter& fitter) {
  Stage stage;
  stage.radius = fitter.draw(0.5, 0.9);
  stage.half = fitter.draw(0.8, 2.4);
  stage.front_radius = fitter.draw(0.3, 0.95) * stage.radius;
  stage.front = stage.half + fitter.draw(0.2, 0.8);
  stage.back_radius = fitter.draw(0.5, 0.8) * stage.radius;
  stage.back = -stage.half - fitter.draw(0.1, 0.3);
  fitter.add("tank", "tank",
             fitter.text().revolve({{stage.back, 0},
                                    {stage.back, stage.back_radius},
                                    {-stage.half, stage.radius},
                                    {stage.half, stage.radius},
                                    {stage.front, stage.front_radius},
                                    {stage.front, 0}},
                                   0, fitter.round_sides(), {}, {}));
  return stage;
}

Pad strip_of(const Stage& stage, double azimuth_deg) {
  return {false, azimuth_deg, 1, stage.radius, stage.half, 0.23 * stage.radius, stage.radius};
}

Cell drawn_cell(const Stage& stage, Fitter& fitter) {
  const double azimuth_deg = 15 * static_cast<double>(fitter.pick(24));
  const double half = fitter.draw(0.5, 1) * 0.23 * stage.radius;
  return {strip_of(stage, azimuth_deg), fitter.draw(-0.8, 0.8) * stage.half, 0, half, half};
}

void add_raceway(const Stage& stage, Fitter& fitter) {
  const std::string name = fitter.numbered("raceway");
  const Cell cell{strip_of(stage, 15 * static_cast<double>(fitter.pick(24))), 0, 0, 0, 0};
  const double height = fitter.draw(0.04, 0.1), foot = 0.05;
  fitter.add(name, name,
             fitter.text().box({height + foot, fitter.draw(1.2, 1.9) * stage.half, fitter.draw(0.08, 0.2)},
                               placed(cell, {PlaceStep::move({0.5 * (height - foot), 0, 0})}), {}));
}

void add_engines(const Stage& stage, int engines, Fitter& fitter) {
  const Pad back{true, 0, -1, -stage.back, stage.back_radius, stage.back_radius, 0};
  if (engines == 1) return fitter.nozzle({back, 0, 0, 0, 0}, fitter.draw(0.4, 0.75) * stage.radius);
  const double across = 0.55 * stage.back_radius;
  fitter.nozzle({back, across, 0, 0, 0}, fitter.draw(0.25, 0.45) * stage.back_radius, {engines, 360.0 / engines});
}

void add_stage_details(const Stage& stage, Fitter& fitter) {
  for (std::size_t i = 1 + fitter.pick(2); i > 0; --i) add_raceway(stage, fitter);
  for (std::size_t i = fitter.pick(5); i > 0; --i) fitter.add_small(drawn_cell(stage, fitter));
  if (fitter.chance(0.4)) fitter.thruster(drawn_cell(stage, fitter), {4, 90});
}

}  // namespace

std::string draw_spent_stage(Body&, Fitter& fitter) {
  const Stage stage = draw_hull(fitter);
  const bool bare = fitter.chance(0.2);
  const int engines = bare || fitter.chance(0.6) ? 1 : 2 + static_cast<int>(fitter.pick(3));
  if (fitter.chance(0.5)) fitter.docking_ring({true, 0, 1, stage.front, stage.front_radius, stage.front_radius, 0});
  add_engines(stage, engines, fitter);
  if (!bare) add_stage_details(stage, fitter);
  return std::string(bare ? "bare stage" : "stage") + " with " + std::to_string(engines) + (engines == 1 ? " engine" : " engines");
}

std::string draw_rock(Body&, Fitter& fitter) {
  const double y = fitter.draw(0.9, 2), z = fitter.draw(0.9, 2);
  const std::size_t seed = 1 + fitter.pick(1000000);
  fitter.add("rock", "rock", fitter.text().rock({2, y, z}, fitter.draw(0.15, 0.45), seed, 3, {}));
  return "rock";
}

std::string draw_unknowable(Body&, Fitter& fitter) {
  const std::size_t shape = fitter.pick(3);
  if (shape == 0) {
    fitter.add("sphere", "sphere", fitter.text().rock({2, 2, 2}, 0, 0, 4, {}));
    return "sphere";
  }
  const double half = fitter.draw(0.4, 2), radius = fitter.draw(0.3, 1);
  const double front = shape == 1 ? radius : fitter.draw(0.05, 0.7) * radius;
  fitter.add(shape == 1 ? "cylinder" : "cone", "hull",
             fitter.text().revolve({{-half, 0}, {-half, radius}, {half, front}, {half, 0}}, 0, kBareSides, {}, {}));
  return shape == 1 ? "bare cylinder" : "bare cone";
}

}  // namespace lasso::mdat
