#include "mdat/modelc/outward.hpp"

#include <cmath>
#include <numbers>

#include "mdat/modelc/embree_scene.hpp"
#include "mdat/modelc/parallel.hpp"
#include "mdat/modelc/random.hpp"

namespace lasso::mdat {
namespace {

constexpr int kRaysPerSide = 64;
constexpr int kEscapesMin = 2;         // fewer are leaks through cracks
constexpr double kShareOfSheet = 0.5;  // of a component's lit area
constexpr double kLift = 4e-6;         // start of a ray above the surface, as a share of the extent
constexpr std::uint64_t kSeed = 20050331;

struct Escapes {
  int front = 0, back = 0;
};

Vec3d random_point(const Surface& surface, std::size_t t, Random& random) {
  const double root = std::sqrt(random.uniform());
  const double v = random.uniform();
  return (1 - root) * surface.corner(t, 0) + root * (1 - v) * surface.corner(t, 1) + root * v * surface.corner(t, 2);
}

// Cosine-weighted about +z.
Vec3d random_direction(Random& random) {
  const double r2 = random.uniform();
  const double angle = 2 * std::numbers::pi * random.uniform();
  return {std::sqrt(r2) * std::cos(angle), std::sqrt(r2) * std::sin(angle), std::sqrt(1 - r2)};
}

Escapes count_escapes(const Surface& surface, const EmbreeScene& scene, std::size_t t) {
  Escapes escapes;
  if (surface.sliver[t] != 0) return escapes;
  Random random(kSeed + t);
  const Vec3d& n = surface.normals[t];
  const Vec3d u = n.unitOrthogonal();
  const Vec3d v = n.cross(u);
  for (int i = 0; i < 2 * kRaysPerSide; ++i) {
    const double side = i % 2 == 0 ? 1 : -1;
    const Vec3d from = random_point(surface, t, random) + side * kLift * surface.extent * n;
    const Vec3d local = random_direction(random);
    const bool escaped = scene.escapes(from, local.x() * u + local.y() * v + side * local.z() * n);
    (i % 2 == 0 ? escapes.front : escapes.back) += escaped;
  }
  return escapes;
}

struct ComponentLight {
  double front = 0, back = 0, volume = 0;
  double lit = 0, lit_twice = 0;  // area lit from any side, from both
};

std::vector<ComponentLight> sum_light(const Surface& surface, const Components& components, const std::vector<Escapes>& escapes) {
  std::vector<ComponentLight> light(components.count());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    ComponentLight& sum = light[components.of_triangle[t]];
    const Vec3d a = surface.corner(t, 0) - surface.low, b = surface.corner(t, 1) - surface.low, c = surface.corner(t, 2) - surface.low;
    const double area = (b - a).cross(c - a).norm();
    const int less = std::min(escapes[t].front, escapes[t].back);
    sum.lit += escapes[t].front + escapes[t].back > 0 ? area : 0;
    sum.lit_twice += less >= kEscapesMin ? area : 0;
    sum.front += area * escapes[t].front;
    sum.back += area * escapes[t].back;
    sum.volume += a.dot(b.cross(c));
  }
  return light;
}

bool is_inside_out(const ComponentLight& light, bool open) {
  if (light.front == 0 && light.back == 0) return !open && light.volume < 0;
  return light.back > light.front;
}

}  // namespace

void turn_outward(Surface& surface, const Components& components, CompileReport& report, const std::vector<double>& asked) {
  EmbreeScene scene;
  scene.add_triangles(surface);
  scene.commit();
  std::vector<Escapes> escapes(surface.triangles.size());
  parallel_for(escapes.size(), [&](std::size_t t) {
    if (asked.empty() || asked[t] > 0) escapes[t] = count_escapes(surface, scene, t);
  });
  const std::vector<ComponentLight> light = sum_light(surface, components, escapes);
  std::vector<std::uint8_t> flip(light.size()), sheet(light.size()), any_two_sided(light.size(), 0);
  for (std::size_t c = 0; c < light.size(); ++c) {
    flip[c] = is_inside_out(light[c], components.open[c] != 0);
    report.flipped_components += flip[c];
    report.hidden_components += light[c].front + light[c].back == 0;
    sheet[c] = components.open[c] != 0 && light[c].lit_twice > kShareOfSheet * light[c].lit;
  }
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const std::uint32_t c = components.of_triangle[t];
    if (flip[c] != 0) surface.flip(t);
    report.flipped_triangles += flip[c];
    const int back = flip[c] != 0 ? escapes[t].front : escapes[t].back;
    const bool lit_behind = components.open[c] != 0 && (sheet[c] != 0 || back >= kEscapesMin);
    surface.two_sided[t] = surface.two_sided[t] != 0 || lit_behind;
    report.two_sided_triangles += surface.two_sided[t];
    any_two_sided[c] = any_two_sided[c] != 0 || surface.two_sided[t] != 0;
  }
  for (const std::uint8_t any : any_two_sided) report.two_sided_components += any;
}

}  // namespace lasso::mdat
