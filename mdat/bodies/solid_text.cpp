#include "mdat/bodies/solid_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "mdat/missiondb/value_row.hpp"

namespace lasso::mdat {
namespace {

// Exact: integers alone.
std::string millimetres(long long count) {
  char text[40];
  std::snprintf(text, sizeof text, "%s%lld.%03lld", count < 0 ? "-" : "", std::llabs(count) / 1000, std::llabs(count) % 1000);
  return text;
}

// To a millionth of a degree.
std::string degrees(double angle_deg) { return number_text(static_cast<double>(std::llround(1e6 * angle_deg)) / 1e6); }

std::string axis_text(const Vec3& v) { return "[" + number_text(v.x()) + ", " + number_text(v.y()) + ", " + number_text(v.z()) + "]"; }

}  // namespace

std::string SolidText::length(double value) const { return millimetres(std::llround(1000 * factor_ * value)); }

std::string SolidText::thickness(double value) const {
  return millimetres(std::max<long long>(kThinnest_mm, std::llround(1000 * factor_ * value)));
}

std::string SolidText::vector(const Vec3& v) const { return "[" + length(v.x()) + ", " + length(v.y()) + ", " + length(v.z()) + "]"; }

std::string SolidText::tail(const Place& place, const Repeat& repeat) const {
  std::string text;
  for (const PlaceStep& step : place) {
    text += text.empty() ? "place = [" : ", ";
    if (!step.turn) {
      text += "{move = " + vector(step.vector) + "}";
      continue;
    }
    text += "{turn = " + axis_text(step.vector) +
            ", angle_deg = " + (step.parameter.empty() ? degrees(step.angle_deg) : '"' + step.parameter + '"');
    if (!step.through.isZero()) text += ", through = " + vector(step.through);
    text += "}";
  }
  if (!text.empty()) text += "]\n";
  if (repeat.count > 1)
    text += "repeat = {count = " + std::to_string(repeat.count) + ", axis = [1, 0, 0], angle_deg = " + degrees(repeat.step_deg) + "}\n";
  return text;
}

std::string SolidText::box(const Vec3& size, const Place& place, const Repeat& repeat) const {
  return "kind = \"box\"\nsize = [" + thickness(size.x()) + ", " + thickness(size.y()) + ", " + thickness(size.z()) + "]\n" +
         tail(place, repeat);
}

std::string SolidText::rod(const Vec3& from, const Vec3& to, double radius, double radius_to, int sides, const Place& place,
                           const Repeat& repeat) const {
  return "kind = \"rod\"\nfrom = " + vector(from) + "\nto = " + vector(to) + "\nradius = " + thickness(radius) +
         "\nradius_to = " + (radius_to > 0 ? thickness(radius_to) : "0") + "\nsides = " + std::to_string(sides) + "\n" +
         tail(place, repeat);
}

std::string SolidText::revolve(const std::vector<std::pair<double, double>>& profile, double start_deg, int sides, const Place& place,
                               const Repeat& repeat) const {
  std::string text = "kind = \"revolve\"\nprofile = [";
  for (const auto& [x, r] : profile) text += "[" + length(x) + ", " + (r > 0 ? thickness(r) : "0") + "], ";
  text.replace(text.size() - 2, 2, "]\n");
  if (start_deg != 0) text += "start_deg = " + degrees(start_deg) + "\n";
  return text + "sides = " + std::to_string(sides) + "\n" + tail(place, repeat);
}

std::string SolidText::dish(double radius, double depth, double thick, int rings, int sides, const Place& place,
                            const Repeat& repeat) const {
  return "kind = \"dish\"\nradius = " + thickness(radius) + "\ndepth = " + thickness(depth) + "\nthickness = " + thickness(thick) +
         "\nrings = " + std::to_string(rings) + "\nsides = " + std::to_string(sides) + "\n" + tail(place, repeat);
}

std::string SolidText::rock(const Vec3& size, double roughness, std::uint64_t seed, int fineness, const Place& place) const {
  return "kind = \"rock\"\nsize = [" + thickness(size.x()) + ", " + thickness(size.y()) + ", " + thickness(size.z()) +
         "]\nroughness = " + number_text(static_cast<double>(std::llround(1000 * roughness)) / 1000) + "\nseed = " + std::to_string(seed) +
         "\nfineness = " + std::to_string(fineness) + "\n" + tail(place, {});
}

}  // namespace lasso::mdat
