#include "mdat/missiondb/solid.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>

#include "mdat/modelc/random.hpp"

namespace lasso::mdat {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Index = std::uint32_t;

void orient_outwards(Mesh& mesh) {
  if (signed_volume(mesh) >= 0) return;
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
}

double cross2(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

bool inside(const Vector2d& p, const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return cross2(b - a, p - a) >= 0 && cross2(c - b, p - b) >= 0 && cross2(a - c, p - c) >= 0;
}

bool is_ear(const std::vector<Vector2d>& points, const std::vector<Index>& polygon, std::size_t i, std::size_t& tests) {
  const std::size_t n = polygon.size();
  const Vector2d& a = points[polygon[(i + n - 1) % n]];
  const Vector2d& b = points[polygon[i]];
  const Vector2d& c = points[polygon[(i + 1) % n]];
  ++tests;
  if (cross2(b - a, c - b) <= 0) return false;
  tests += n;
  for (const Index k : polygon) {
    const bool corner = points[k] == a || points[k] == b || points[k] == c;
    if (!corner && inside(points[k], a, b, c)) return false;
  }
  return true;
}

// The vertices of a turned profile: a ring for each point off the axis, one vertex for each point on it.
struct Rings {
  std::vector<Index> first;
  std::vector<bool> on_axis;
  Index columns = 0;
  bool closed = false;
  Index at(std::size_t ring, Index column) const {
    if (on_axis[ring]) return first[ring];
    return first[ring] + (closed ? column % columns : column);
  }
};

Rings make_rings(const std::vector<Vector2d>& profile, const Turn& turn, Mesh& mesh) {
  Rings rings;
  const auto sides = static_cast<Index>(turn.sides);
  rings.closed = turn.sweep_rad > 2 * std::numbers::pi - 1e-9;
  rings.columns = rings.closed ? sides : sides + 1;
  for (const Vector2d& point : profile) {
    rings.first.push_back(static_cast<Index>(mesh.vertices.size()));
    rings.on_axis.push_back(point.y() <= 0);
    for (Index column = 0; column < (point.y() <= 0 ? 1 : rings.columns); ++column) {
      const double angle = turn.start_rad + turn.sweep_rad * column / sides;
      mesh.vertices.emplace_back(point.x(), point.y() * std::cos(angle), point.y() * std::sin(angle));
    }
  }
  return rings;
}

void add_band(const Rings& rings, std::size_t from, std::size_t to, Index sides, Mesh& mesh) {
  for (Index k = 0; k < sides; ++k) {
    const std::array<Index, 4> quad{rings.at(from, k), rings.at(to, k), rings.at(to, k + 1), rings.at(from, k + 1)};
    if (!rings.on_axis[to]) mesh.triangles.push_back({quad[0], quad[1], quad[2]});
    if (!rings.on_axis[from]) mesh.triangles.push_back({quad[0], quad[2], quad[3]});
  }
}

// The two ends of a partial turn. With the profile counter-clockwise in (x, r), bands from point to point face the other way than the
// first end's triangles.
void add_caps(const Rings& rings, const std::vector<Vector2d>& profile, Index sides, Mesh& mesh) {
  double area = 0;
  for (std::size_t i = 0; i < profile.size(); ++i) area += cross2(profile[i], profile[(i + 1) % profile.size()]);
  for (auto triangle : triangulate_polygon(profile)) {
    if (area < 0) std::swap(triangle[1], triangle[2]);
    mesh.triangles.push_back({rings.at(triangle[0], 0), rings.at(triangle[2], 0), rings.at(triangle[1], 0)});
    mesh.triangles.push_back({rings.at(triangle[0], sides), rings.at(triangle[1], sides), rings.at(triangle[2], sides)});
  }
}

// Two unit vectors that form a right-handed frame with `axis`.
std::pair<Vector3d, Vector3d> across(const Vector3d& axis) {
  const Vector3d u = axis.unitOrthogonal();
  return {u, axis.cross(u)};
}

// Of radius 1: corners of three golden rectangles.
Mesh icosahedron() {
  const double golden = 0.5 * (1 + std::sqrt(5.0));
  Mesh mesh;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-golden, golden}) {
      for (const Vector3d& corner : {Vector3d(0, a, b), Vector3d(a, b, 0), Vector3d(b, 0, a)}) mesh.vertices.push_back(corner.normalized());
    }
  }
  mesh.triangles = {{0, 1, 2},  {0, 7, 1}, {0, 2, 6},  {0, 6, 5},  {0, 5, 7}, {1, 8, 2},  {1, 7, 3},  {1, 3, 8},  {2, 4, 6},   {2, 8, 4},
                    {3, 7, 11}, {3, 9, 8}, {3, 11, 9}, {4, 10, 6}, {4, 8, 9}, {4, 9, 10}, {5, 6, 10}, {5, 11, 7}, {5, 10, 11}, {9, 11, 10}};
  return mesh;
}

// Each triangle in four, with the new vertices on the unit sphere.
Mesh divided(const Mesh& coarse) {
  Mesh mesh{coarse.vertices, {}};
  std::map<std::pair<Index, Index>, Index> middles;
  const auto middle = [&](Index a, Index b) {
    const auto [place, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<Index>(mesh.vertices.size()));
    if (fresh) mesh.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]).normalized());
    return place->second;
  };
  for (const auto& [a, b, c] : coarse.triangles) {
    const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const auto& triangle : {std::array{a, ab, ca}, std::array{b, bc, ab}, std::array{c, ca, bc}, std::array{ab, bc, ca}})
      mesh.triangles.push_back(triangle);
  }
  return mesh;
}

Vector3d drawn_direction(Random& random) {
  for (;;) {
    const double x = 2 * random.uniform() - 1, y = 2 * random.uniform() - 1, z = 2 * random.uniform() - 1;
    const Vector3d direction(x, y, z);
    if (direction.norm() > 0.1 && direction.norm() <= 1) return direction.normalized();
  }
}

// A hill or a hollow: `height` in its middle, falling smoothly to 0 where the cosine of the angle from it is `edge`.
struct Bump {
  Vector3d direction = Vector3d::UnitX();
  double edge = 0, height = 0;
  double at(const Vector3d& u) const {
    const double share = std::max(0.0, (u.dot(direction) - edge) / (1 - edge));
    return height * share * share * (3 - 2 * share);
  }
};

// Wide ones are high and narrow ones low.
std::vector<Bump> drawn_bumps(std::uint64_t seed) {
  constexpr int kBumps = 40;
  Random random(seed);
  std::vector<Bump> bumps;
  for (int i = 0; i < kBumps; ++i) {
    const double edge = 0.3 + 0.65 * random.uniform();
    const double height = std::sqrt(1 - edge) * (2 * random.uniform() - 1);
    bumps.push_back({drawn_direction(random), edge, height});
  }
  return bumps;
}

}  // namespace

std::vector<std::array<Index, 3>> triangulate_polygon(const std::vector<Vector2d>& points, std::size_t* tests) {
  double area = 0;
  for (std::size_t i = 0; i < points.size(); ++i) area += cross2(points[i], points[(i + 1) % points.size()]);
  std::vector<Index> polygon;
  for (std::size_t i = 0; i < points.size(); ++i) polygon.push_back(static_cast<Index>(area > 0 ? i : points.size() - 1 - i));
  std::vector<std::array<Index, 3>> triangles;
  std::size_t made = 0;
  while (polygon.size() > 2) {
    const std::size_t n = polygon.size();
    std::size_t ear = 0;
    while (ear < n && !is_ear(points, polygon, ear, made)) ++ear;
    if (ear == n) break;
    triangles.push_back({polygon[(ear + n - 1) % n], polygon[ear], polygon[(ear + 1) % n]});
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  // Without an ear it crosses itself, or has no area: any cut is as good as another.
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) triangles.push_back({polygon[0], polygon[i], polygon[i + 1]});
  if (tests != nullptr) *tests += made;
  return triangles;
}

Mesh make_box(const Vector3d& size) {
  Mesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d sign((corner & 1) != 0 ? 0.5 : -0.5, (corner & 2) != 0 ? 0.5 : -0.5, (corner & 4) != 0 ? 0.5 : -0.5);
    mesh.vertices.push_back(size.cwiseProduct(sign));
  }
  constexpr Index kQuads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& quad : kQuads) {
    mesh.triangles.push_back({quad[0], quad[1], quad[2]});
    mesh.triangles.push_back({quad[0], quad[2], quad[3]});
  }
  return mesh;
}

Mesh make_revolve(const std::vector<Vector2d>& profile, const Turn& turn) {
  Mesh mesh;
  const Rings rings = make_rings(profile, turn, mesh);
  const auto sides = static_cast<Index>(turn.sides);
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const std::size_t next = (i + 1) % profile.size();
    if (!(rings.on_axis[i] && rings.on_axis[next])) add_band(rings, i, next, sides, mesh);
  }
  if (!rings.closed) add_caps(rings, profile, sides, mesh);
  orient_outwards(mesh);
  return mesh;
}

Mesh make_rod(const Vector3d& from, const Vector3d& to, double radius_from, double radius_to, int sides) {
  const double length = (to - from).norm();
  const Vector3d axis = (to - from) / length;
  const auto [u, v] = across(axis);
  Mesh mesh = make_revolve({{0, 0}, {0, radius_from}, {length, radius_to}, {length, 0}}, {0, 2 * std::numbers::pi, sides});
  for (Vector3d& p : mesh.vertices) p = (from + axis * p.x() + u * p.y() + v * p.z()).eval();
  return mesh;
}

Mesh make_dish(const DishShape& shape) {
  std::vector<Vector2d> profile;
  const auto depth_at = [&](double r) { return shape.depth * (r / shape.radius) * (r / shape.radius); };
  for (int i = 0; i <= shape.rings; ++i) {
    const double r = shape.radius * i / shape.rings;
    profile.emplace_back(depth_at(r), r);
  }
  for (int i = shape.rings; i >= 0; --i) {
    const double r = shape.radius * i / shape.rings;
    profile.emplace_back(depth_at(r) - shape.thickness, r);
  }
  return make_revolve(profile, {0, 2 * std::numbers::pi, shape.sides});
}

Mesh make_rock(const RockShape& shape) {
  Mesh mesh = icosahedron();
  for (int i = 0; i < shape.fineness; ++i) mesh = divided(mesh);
  const std::vector<Bump> bumps = drawn_bumps(shape.seed);
  std::vector<double> heights;
  double highest = 0;
  for (const Vector3d& u : mesh.vertices) {
    double height = 0;
    for (const Bump& bump : bumps) height += bump.at(u);
    heights.push_back(height);
    highest = std::max(highest, std::fabs(height));
  }
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const double radius = 1 + (highest > 0 ? shape.roughness * heights[i] / highest : 0);
    mesh.vertices[i] = 0.5 * radius * shape.size.cwiseProduct(mesh.vertices[i]);
  }
  return mesh;
}

double signed_volume(const Mesh& mesh) {
  double volume = 0;
  for (const auto& triangle : mesh.triangles) {
    const Vector3d& a = mesh.vertices[triangle[0]];
    volume += a.dot(mesh.vertices[triangle[1]].cross(mesh.vertices[triangle[2]])) / 6;
  }
  return volume;
}

void append(Mesh& mesh, const Mesh& part) {
  const auto base = static_cast<Index>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const auto& triangle : part.triangles) mesh.triangles.push_back({triangle[0] + base, triangle[1] + base, triangle[2] + base});
}

}  // namespace lasso::mdat
