// What the tables of a box image are made of: the faces of its boxes, and numbers as the image holds them.
#pragma once

#include <algorithm>
#include <cstdint>

#include "ut/support/box_image.hpp"

namespace lasso::test {

constexpr int kBits = 24;

inline std::uint32_t length(double m) {
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(m * (1 << kBits) + (m < 0 ? -0.5 : 0.5)));
}
inline std::uint32_t unit(double x) { return static_cast<std::uint32_t>(static_cast<std::int32_t>(x * (1 << 30))); }

// Face f of all: box f / 6, axis f % 6 / 2, side f % 2 (0 low, 1 high).
struct Face {
  const BoxModel& box;
  int axis;
  double sign;
  double place;
};
inline int face_count(const Boxes& boxes) { return 6 * static_cast<int>(boxes.size()); }
inline Face face_of(const Boxes& boxes, int f) {
  const BoxModel& box = boxes[static_cast<std::size_t>(f / 6)];
  const int axis = f % 6 / 2;
  const double sign = f % 2 == 0 ? -1 : 1;
  return {box, axis, sign, box.center[axis] + sign * box.half[axis]};
}
inline double low(const BoxModel& m, int axis) { return m.center[axis] - m.half[axis]; }
inline double high(const BoxModel& m, int axis) { return m.center[axis] + m.half[axis]; }

// The smallest box around all of them, with the first one's cells.
inline BoxModel bounds_of(const Boxes& boxes) {
  BoxModel bounds = boxes[0];
  if (boxes.size() == 1) return bounds;
  for (int i = 0; i < 3; ++i) {
    double from = low(bounds, i);
    double to = high(bounds, i);
    for (const BoxModel& box : boxes) {
      from = std::min(from, low(box, i));
      to = std::max(to, high(box, i));
    }
    bounds.center[i] = (from + to) / 2;
    bounds.half[i] = (to - from) / 2;
  }
  return bounds;
}

inline Vec3 closest_on_face(const Face& face, const Vec3& p) {
  Vec3 q;
  for (int i = 0; i < 3; ++i) q[i] = i == face.axis ? face.place : std::clamp(p[i], low(face.box, i), high(face.box, i));
  return q;
}

inline bool opposed(const Face& a, const Face& b) { return a.axis == b.axis && a.sign != b.sign; }

inline int closest_face(const Boxes& boxes, const Vec3& p, int opposing_to, double limit) {
  int best = -1;
  for (int f = 0; f < face_count(boxes); ++f) {
    if (opposing_to >= 0 && !opposed(face_of(boxes, f), face_of(boxes, opposing_to))) continue;
    const double distance = (closest_on_face(face_of(boxes, f), p) - p).norm();
    if (distance < limit) {
      limit = distance;
      best = f;
    }
  }
  return best;
}

// The tables of search, of which the image's maker is the only user.
Words search_grid_words(const BoxModel& bounds);
Words distance_words(const Boxes& boxes, const BoxModel& bounds);
Words view_words(const Boxes& boxes, const BoxModel& bounds);
Words symmetry_words(const BoxModel& box);

}  // namespace lasso::test
