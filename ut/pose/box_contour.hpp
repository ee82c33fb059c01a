// The contour of boxes in closed form: which edges lie on it, and how far rays pass from them.
#pragma once

#include <array>
#include <vector>

#include "fsw/geometry/se3.hpp"
#include "ut/support/box_image.hpp"

namespace lasso::test {

struct BoxEdge {
  Vec3 a, b;
  std::size_t box;  // that it belongs to
};

// Does the sensor see the face of `axis` on the side of `sign`?
inline bool sees_face(const BoxModel& box, const Vec3& sensor, int axis, double sign) {
  return sign * (sensor[axis] - box.center[axis]) > box.half[axis];
}

// Edge k of 12, in the order of the image: along axis k / 4, between faces of the two other axes.
inline BoxEdge edge_of_box(const Boxes& boxes, std::size_t box, int k) {
  const BoxModel& model = boxes[box];
  Vec3 toward;
  toward[k / 4] = -1;
  toward[(k / 4 + 1) % 3] = k % 2 == 0 ? -1 : 1;
  toward[(k / 4 + 2) % 3] = k % 4 < 2 ? -1 : 1;
  BoxEdge edge{model.center + model.half.cwiseProduct(toward), Vec3::Zero(), box};
  toward[k / 4] = 1;
  edge.b = model.center + model.half.cwiseProduct(toward);
  return edge;
}

inline bool is_contour(const Boxes& boxes, std::size_t box, int k, const Vec3& sensor) {
  const int first = (k / 4 + 1) % 3;
  const int second = (k / 4 + 2) % 3;
  return sees_face(boxes[box], sensor, first, k % 2 == 0 ? -1 : 1) != sees_face(boxes[box], sensor, second, k % 4 < 2 ? -1 : 1);
}

// A ray's line, target frame.
struct RayLine {
  Vec3 origin, u;
};

// Distance of a line from a segment in space, and whether the segment's closest point is one of its ends.
struct LineDistance {
  double m = 0;
  bool end = false;
  Vec3 point = Vec3::Zero();  // on the segment
};

inline LineDistance line_to_edge(const RayLine& line, const BoxEdge& edge) {
  // Across the line, the segment from a to b is a segment in a plane.
  const auto across = [&line](const Vec3& v) { return Vec3(v - v.dot(line.u) * line.u); };
  const Vec3 a = across(edge.a - line.origin);
  const Vec3 ab = across(edge.b - edge.a);
  const double t = -a.dot(ab) / ab.squaredNorm();
  const double inside = t < 0 ? 0 : t > 1 ? 1 : t;
  return {(a + inside * ab).norm(), t != inside, edge.a + inside * (edge.b - edge.a)};
}

}  // namespace lasso::test
