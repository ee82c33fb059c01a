// What is mounted on a spacecraft's bus, each at a place of its surface. Inside of bodies.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "hal_sim/random.hpp"
#include "mdat/bodies/solid_text.hpp"

namespace lasso::mdat {

// A face of the bus, or the strip of a cylinder along its axis. The bus lies along x; on a side pad `a` runs along the bus and `t` around
// it. On an end pad they run along y and z.
struct Pad {
  bool end = false;
  double azimuth_deg = 0;  // of a side pad's normal, from +y towards +z
  double sign = 1;         // of an end pad: faces +x or -x
  double reach = 0;        // from the origin to the face
  double half_a = 0, half_t = 0;
  double radius = 0;  // of a cylinder; 0: flat
};

// A rectangle on a pad, for one fitting.
struct Cell {
  Pad pad;
  double a = 0, t = 0;
  double half_a = 0, half_t = 0;
  double half() const { return half_a < half_t ? half_a : half_t; }
};

struct WingShape {
  double length = 0, width = 0, thickness = 0;
  int panels = 1;
  double cant_deg = 0;    // of the wing's axis, towards the bus's front
  std::string parameter;  // the angle about its axis
};

// Adds fittings to a body. Of two draws each is a statement of its own: the order of a call's arguments is the compiler's. All stand on the
// surface with their feet in it, so that nothing floats and no faces lie in one plane.
class Fitter {
 public:
  Fitter(Body& body, const SolidText& text, sim::Random& random) : body_(body), text_(text), random_(random) {}

  // One of those below, for a cell; a kind in `all` is as likely as another.
  void add_small(const Cell& cell, const Repeat& repeat = {});
  void box(const Cell& cell, const Repeat& repeat = {});
  void radiator(const Cell& cell, const Repeat& repeat = {});
  void thruster(const Cell& cell, const Repeat& repeat = {});
  void tank(const Cell& cell, const Repeat& repeat = {});
  void star_tracker(const Cell& cell, const Repeat& repeat = {});
  void handrail(const Cell& cell, const Repeat& repeat = {});
  void whip_antenna(const Cell& cell, const Repeat& repeat = {});
  void horn_antenna(const Cell& cell, const Repeat& repeat = {});

  void boom(const Cell& cell, double length, const Repeat& repeat = {});
  void dish(const Cell& cell, double radius, double tilt_deg, const Repeat& repeat = {});
  void docking_ring(const Pad& pad);
  // A round lid on an end, hinged at its edge: the parameter is the angle by which it is open.
  void door(const Pad& pad, double radius, const std::string& parameter);
  void nozzle(const Cell& cell, double radius, const Repeat& repeat = {});
  void wing(const Pad& pad, double a, const WingShape& shape, const Repeat& repeat = {});
  void add(const std::string& name, const std::string& assembly, const std::string& lines) {
    body_.parts.push_back({name, assembly, lines});
  }

  const SolidText& text() const { return text_; }
  // Round solids then have numbers of sides that so many equal turns bring on themselves.
  void round_for(int folds);
  int round_sides() const { return round_sides_; }
  double draw(double low, double high) { return random_.uniform(low, high); }
  bool chance(double share) { return random_.uniform() < share; }
  std::size_t pick(std::size_t count) { return static_cast<std::size_t>(random_.uniform() * static_cast<double>(count)); }
  // "box 2" for the second one.
  std::string numbered(const std::string& name) { return name + " " + std::to_string(++counts_[name]); }
  int count_of(const std::string& name) const { return counts_.count(name) == 0 ? 0 : counts_.at(name); }

 private:
  // How deep a foot of this half width stands in the surface.
  double foot(const Pad& pad, double half_width) const;

  Body& body_;
  const SolidText& text_;
  sim::Random& random_;
  std::map<std::string, int> counts_;
  int round_sides_ = 48, mast_sides_ = 24;
};

// From a solid about the local origin, with x away from the pad, to where it stands: `own` steps first.
Place placed(const Cell& cell, Place own = {});

}  // namespace lasso::mdat
