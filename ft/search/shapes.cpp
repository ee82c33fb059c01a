#include "ft/search/shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "fsw/geometry/portable_math.hpp"

namespace lasso {
namespace {

void add(mdat::Mesh& mesh, const mdat::Mesh& other) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& t : other.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

void add_quad(mdat::Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

// A surface of revolution about x: radii at places along it.
mdat::Mesh turned(const std::vector<std::array<double, 2>>& profile, std::uint32_t sides) {
  mdat::Mesh mesh;
  for (const auto& [x, r] : profile) {
    for (std::uint32_t k = 0; k < sides; ++k) {
      const double angle = 2 * kPi * k / sides;
      mesh.vertices.emplace_back(x, r * std::cos(angle), r * std::sin(angle));
    }
  }
  for (std::uint32_t i = 0; i + 1 < profile.size(); ++i) {
    for (std::uint32_t k = 0; k < sides; ++k) {
      const std::uint32_t next = (k + 1) % sides;
      add_quad(mesh, i * sides + k, i * sides + next, (i + 1) * sides + next, (i + 1) * sides + k);
    }
  }
  return mesh;
}

}  // namespace

mdat::Mesh cylinder(double half, double radius) { return turned({{-half, 1e-6}, {-half, radius}, {half, radius}, {half, 1e-6}}, 48); }

mdat::Mesh sphere(double radius) {
  std::vector<std::array<double, 2>> profile;
  for (int i = 0; i <= 24; ++i) {
    const double angle = kPi * i / 24;
    profile.push_back({-radius * std::cos(angle), std::max(radius * std::sin(angle), 1e-6)});
  }
  return turned(profile, 48);
}

namespace {

mdat::Mesh box(const Vec3& low, const Vec3& high) {
  mdat::Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back((i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(), (i & 4) != 0 ? high.z() : low.z());
  }
  add_quad(mesh, 0, 2, 3, 1);
  add_quad(mesh, 4, 5, 7, 6);
  add_quad(mesh, 0, 1, 5, 4);
  add_quad(mesh, 2, 6, 7, 3);
  add_quad(mesh, 0, 4, 6, 2);
  add_quad(mesh, 1, 3, 7, 5);
  return mesh;
}

}  // namespace

// Another spacecraft of about the same size: a body with two panels.
mdat::Mesh panels(double size) {
  mdat::Mesh mesh = box(size * Vec3(-0.12, -0.12, -0.18), size * Vec3(0.12, 0.12, 0.18));
  add(mesh, box(size * Vec3(-0.08, 0.14, -0.01), size * Vec3(0.08, 0.5, 0.01)));
  add(mesh, box(size * Vec3(-0.08, -0.5, -0.01), size * Vec3(0.08, -0.14, 0.01)));
  return mesh;
}

// The mesh and the same turned by half a turn about x.
mdat::Mesh twofold(const mdat::Mesh& mesh) {
  mdat::Mesh both = mesh;
  mdat::Mesh other = mesh;
  for (auto& v : other.vertices) v = Vec3(v.x(), -v.y(), -v.z());
  add(both, other);
  return both;
}

}  // namespace lasso
