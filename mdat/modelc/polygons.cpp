#include "mdat/modelc/polygons.hpp"

#include <algorithm>
#include <cmath>

namespace lasso::mdat {
namespace {

constexpr double kPlaneTolerance = 3e-7;   // of the extent
constexpr double kConvexTolerance = 1e-7;  // of the extent

double corner_angle(const Surface& surface, std::size_t t, int i) {
  const Vec3d a = surface.corner(t, (i + 1) % 3) - surface.corner(t, i);
  const Vec3d b = surface.corner(t, (i + 2) % 3) - surface.corner(t, i);
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// Triangles at each vertex, in one array: those of vertex v are [begin[v], begin[v + 1]).
struct Fans {
  std::vector<std::uint32_t> begin, triangles;
};

Fans make_fans(const Surface& surface) {
  Fans fans;
  fans.begin.assign(surface.vertices.size() + 1, 0);
  for (const auto& triangle : surface.triangles) {
    for (const std::uint32_t v : triangle) ++fans.begin[v + 1];
  }
  for (std::size_t v = 1; v < fans.begin.size(); ++v) fans.begin[v] += fans.begin[v - 1];
  fans.triangles.resize(fans.begin.back());
  std::vector<std::uint32_t> next(fans.begin.begin(), fans.begin.end() - 1);
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    for (const std::uint32_t v : surface.triangles[t]) fans.triangles[next[v]++] = t;
  }
  return fans;
}

Vec3d smooth_normal(const Surface& surface, const Fans& fans, std::size_t t, std::uint32_t vertex, double cos_crease) {
  Vec3d sum = Vec3d::Zero();
  for (std::uint32_t i = fans.begin[vertex]; i < fans.begin[vertex + 1]; ++i) {
    const std::uint32_t other = fans.triangles[i];
    if (surface.sliver[other] != 0 || (other != t && surface.normals[other].dot(surface.normals[t]) <= cos_crease)) continue;
    const auto& corners = surface.triangles[other];
    const auto corner = static_cast<int>(std::find(corners.begin(), corners.end(), vertex) - corners.begin());
    sum += corner_angle(surface, other, corner) * surface.normals[other];
  }
  return sum.normalized();
}

// Normal of the least-squares plane of a quad (Newell's: twice its area vector).
Vec3d quad_normal(const std::array<Vec3d, 4>& q) { return (q[2] - q[0]).cross(q[3] - q[1]).normalized(); }

bool is_planar_and_convex(const std::array<Vec3d, 4>& q, const Vec3d& normal, double extent) {
  const Vec3d center = (q[0] + q[1] + q[2] + q[3]) / 4;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3d& before = q[(i + 3) % 4];
    const Vec3d& after = q[(i + 1) % 4];
    if (std::abs(normal.dot(q[i] - center)) > kPlaneTolerance * extent) return false;
    const Vec3d chord = after - before;
    const double outside = normal.dot((q[i] - before).cross(chord)) / chord.norm();
    if (outside < -kConvexTolerance * extent) return false;
  }
  return true;
}

Polygon triangle_polygon(const Surface& surface, std::size_t t, const std::array<Vec3d, 3>& normals) {
  Polygon polygon;
  for (std::size_t i = 0; i < 3; ++i) {
    polygon.corners[i] = surface.corner(t, static_cast<int>(i));
    polygon.corner_normals[i] = normals[i];
  }
  polygon.corners[3] = polygon.corner_normals[3] = Vec3d::Zero();
  polygon.normal = surface.normals[t];
  polygon.two_sided = surface.two_sided[t] != 0;
  return polygon;
}

// The quad of two triangles: the first, with the far corner of the second put into the common edge.
Polygon quad_polygon(const Surface& surface, const EdgeUse& one, const EdgeUse& two, const std::vector<std::array<Vec3d, 3>>& normals) {
  Polygon polygon = triangle_polygon(surface, one.triangle, normals[one.triangle]);
  const auto& n1 = normals[one.triangle];
  const auto& n2 = normals[two.triangle];
  const std::size_t s1 = one.side, s2 = two.side;
  const Vec3d at_start = (n1[s1] + n2[(s2 + 1) % 3]).normalized();
  const Vec3d at_end = (n1[(s1 + 1) % 3] + n2[s2]).normalized();
  const std::array<Vec3d, 3> corners = {polygon.corners[0], polygon.corners[1], polygon.corners[2]};
  polygon.sides = 4;
  polygon.corners = {corners[s1], surface.corner(two.triangle, static_cast<int>((s2 + 2) % 3)), corners[(s1 + 1) % 3],
                     corners[(s1 + 2) % 3]};
  polygon.corner_normals = {at_start, n2[(s2 + 2) % 3], at_end, n1[(s1 + 2) % 3]};
  polygon.normal = quad_normal(polygon.corners);
  return polygon;
}

bool may_join(const Surface& surface, const EdgeUse& one, const EdgeUse& two) {
  constexpr double kNearlyParallel = 0.9999;
  return one.forward != two.forward && surface.sliver[one.triangle] == 0 && surface.sliver[two.triangle] == 0 &&
         surface.two_sided[one.triangle] == surface.two_sided[two.triangle] &&
         surface.normals[one.triangle].dot(surface.normals[two.triangle]) > kNearlyParallel;
}

struct Joint {
  double length;
  const EdgeUse* uses;
};

std::vector<Joint> find_joints(const Surface& surface, const std::vector<EdgeUse>& uses) {
  std::vector<Joint> joints;
  for_each_edge(uses, [&](const EdgeUse* first, const EdgeUse* last) {
    if (last - first == 2 && may_join(surface, first[0], first[1])) {
      joints.push_back({(surface.vertices[first->a] - surface.vertices[first->b]).norm(), first});
    }
  });
  const auto longer = [](const Joint& x, const Joint& y) { return x.length > y.length || (x.length == y.length && x.uses < y.uses); };
  std::sort(joints.begin(), joints.end(), longer);
  return joints;
}

// For each triangle the one that it makes a quadrilateral with, or kNone, and their edge, at the first of the two.
struct Pairing {
  std::vector<std::uint32_t> partner;
  std::vector<const EdgeUse*> joint;
};

Pairing pair_triangles(const Surface& surface, const std::vector<EdgeUse>& uses, const std::vector<std::array<Vec3d, 3>>& normals) {
  Pairing result{std::vector<std::uint32_t>(surface.triangles.size(), kNone),
                 std::vector<const EdgeUse*>(surface.triangles.size(), nullptr)};
  for (const Joint& candidate : find_joints(surface, uses)) {
    const EdgeUse& one = candidate.uses[0];
    const EdgeUse& two = candidate.uses[1];
    if (result.partner[one.triangle] != kNone || result.partner[two.triangle] != kNone) continue;
    const Polygon quad = quad_polygon(surface, one, two, normals);
    if (!is_planar_and_convex(quad.corners, quad.normal, surface.extent)) continue;
    result.partner[one.triangle] = two.triangle;
    result.partner[two.triangle] = one.triangle;
    result.joint[one.triangle] = candidate.uses;  // uses are sorted by triangle: `one` comes first
  }
  return result;
}

}  // namespace

std::vector<std::array<Vec3d, 3>> smooth_normals(const Surface& surface, double crease_angle_rad) {
  const Fans fans = make_fans(surface);
  const double cos_crease = std::cos(crease_angle_rad);
  std::vector<std::array<Vec3d, 3>> normals(surface.triangles.size());
  for (std::size_t t = 0; t < normals.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      normals[t][i] = surface.sliver[t] != 0 ? Vec3d(Vec3d::Zero()) : smooth_normal(surface, fans, t, surface.triangles[t][i], cos_crease);
    }
  }
  return normals;
}

Polygons make_polygons(const Surface& surface, const std::vector<EdgeUse>& uses, const std::vector<std::array<Vec3d, 3>>& normals) {
  const Pairing pairing = pair_triangles(surface, uses, normals);
  Polygons polygons;
  polygons.of_triangle.assign(surface.triangles.size(), kNone);
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    if (surface.sliver[t] != 0 || polygons.of_triangle[t] != kNone) continue;
    const auto index = static_cast<std::uint32_t>(polygons.list.size());
    polygons.of_triangle[t] = index;
    if (pairing.partner[t] != kNone) polygons.of_triangle[pairing.partner[t]] = index;
    polygons.list.push_back(pairing.joint[t] != nullptr ? quad_polygon(surface, pairing.joint[t][0], pairing.joint[t][1], normals)
                                                        : triangle_polygon(surface, t, normals[t]));
  }
  const std::vector<std::uint32_t> flap_of = attach_slivers(surface, uses);
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    if (surface.sliver[t] != 0 && flap_of[t] != kNone) polygons.of_triangle[t] = polygons.of_triangle[flap_of[t]];
  }
  return polygons;
}

}  // namespace lasso::mdat
