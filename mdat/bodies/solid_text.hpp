// Solids of a model's file as text, with lengths in whole millimetres. Inside of bodies.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "fsw/geometry/types.hpp"
#include "mdat/bodies/body.hpp"

namespace lasso::mdat {

// A step of `place`.
struct PlaceStep {
  bool turn = false;
  Vec3 vector = Vec3::Zero();  // the shift, or the axis
  double angle_deg = 0;
  std::string parameter;        // in place of the angle, with "-" before it to negate
  Vec3 through = Vec3::Zero();  // of a turn
  static PlaceStep move(const Vec3& shift) { return {false, shift, 0, "", Vec3::Zero()}; }
  static PlaceStep turned(const Vec3& axis, double angle_deg, const Vec3& through = Vec3::Zero()) {
    return {true, axis, angle_deg, "", through};
  }
  static PlaceStep turned_by(const Vec3& axis, const std::string& parameter, const Vec3& through = Vec3::Zero()) {
    return {true, axis, 0, parameter, through};
  }
};
using Place = std::vector<PlaceStep>;

// Copies about the x axis, in equal steps; 1: none.
struct Repeat {
  int count = 1;
  double step_deg = 0;
};

// Writes solids whose lengths are those given times `factor`, in metres rounded to millimetres. What is thinner than kThinnest_mm becomes
// that thick, as lengths of 0 are no solid.
class SolidText {
 public:
  explicit SolidText(double factor) : factor_(factor) {}
  std::string box(const Vec3& size, const Place& place, const Repeat& repeat) const;
  // A radius of 0 at the end is a tip.
  std::string rod(const Vec3& from, const Vec3& to, double radius, double radius_to, int sides, const Place& place,
                  const Repeat& repeat) const;
  // Points (x, r); r = 0 stays on the axis.
  std::string revolve(const std::vector<std::pair<double, double>>& profile, double start_deg, int sides, const Place& place,
                      const Repeat& repeat) const;
  std::string dish(double radius, double depth, double thickness, int rings, int sides, const Place& place, const Repeat& repeat) const;
  std::string rock(const Vec3& size, double roughness, std::uint64_t seed, int fineness, const Place& place) const;

  // What of a length is left, in the caller's unit, where it is as thin as can be.
  double thinnest() const { return 1e-3 * kThinnest_mm / factor_; }

 private:
  static constexpr int kThinnest_mm = 4;
  std::string length(double value) const;
  std::string thickness(double value) const;
  std::string vector(const Vec3& v) const;
  std::string tail(const Place& place, const Repeat& repeat) const;

  double factor_;
};

}  // namespace lasso::mdat
