#include "mdat/modelc/elements.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "cfg/capacities.hpp"

namespace lasso::mdat {
namespace {

constexpr int kBitsMin = 8;
constexpr int kBitsMax = 30;
constexpr double kUnitOne = 1 << kUnitFractionBits;
constexpr double kCurvatureOne = 1 << kCurvatureFractionBits;
constexpr double kFlatAngle = 1e-4;  // corner normals within this of the plane's: flat

void set_plane_and_sides(const Polygon& polygon, const LengthScale& scale, double relaxation, Element& e) {
  e.sides = polygon.sides;
  e.corners = polygon.corners;
  e.two_sided = polygon.two_sided;
  e.n = round_unit(polygon.normal);
  const auto sides = static_cast<std::size_t>(e.sides);
  double d = 0;
  for (std::size_t i = 0; i < sides; ++i) d += e.n.dot(e.corners[i]) / e.sides;
  e.d = scale.round(d);
  for (std::size_t i = 0; i < sides; ++i) {
    const Vec3d& a = e.corners[i];
    const Vec3d& b = e.corners[(i + 1) % sides];
    e.m[i] = round_unit(polygon.normal.cross(b - a).normalized());
    e.c[i] = scale.round(std::min(e.m[i].dot(a), e.m[i].dot(b)) - relaxation);
  }
}

// Corners of the accepted region: the plane met with neighbouring sides. Where those are nearly parallel, the mesh corner moved outward.
void set_outline(double relaxation, Element& e) {
  constexpr double kParallel = 1e-9;
  const auto sides = static_cast<std::size_t>(e.sides);
  for (std::size_t i = 0; i < sides; ++i) {
    const std::size_t before = (i + sides - 1) % sides;
    Eigen::Matrix3d rows;
    rows << e.n.transpose(), e.m[before].transpose(), e.m[i].transpose();
    e.outline[i] = std::abs(rows.determinant()) > kParallel ? Vec3d(rows.inverse() * Vec3d(e.d, e.c[before], e.c[i]))
                                                            : Vec3d(e.corners[i] - relaxation * (e.m[before] + e.m[i]));
  }
}

void append(std::vector<std::uint32_t>& words, std::int32_t value) { words.push_back(static_cast<std::uint32_t>(value)); }

void append_unit(std::vector<std::uint32_t>& words, const Vec3d& v) {
  for (int i = 0; i < 3; ++i) append(words, unit_word(v[i]));
}

void append_element(const Element& e, const LengthScale& scale, std::vector<std::uint32_t>& words) {
  append_unit(words, e.n);
  append(words, scale.to_word(e.d));
  words.push_back(e.curvature);
  words.push_back(e.two_sided ? kElementTwoSided : 0);
  const auto used = static_cast<std::size_t>(e.sides);
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < 4; ++i) append(words, i < used ? unit_word(e.m[i][axis]) : 0);
  }
  for (std::size_t i = 0; i < 4; ++i) append(words, i < used ? scale.to_word(e.c[i]) : std::numeric_limits<std::int32_t>::min());
}

bool is_flat(const Polygon& polygon) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(polygon.sides); ++i) {
    if ((polygon.corner_normals[i] - polygon.normal).norm() > kFlatAngle) return false;
  }
  return true;
}

struct Curvature {
  Vec3d n, c;
  Eigen::Matrix3d g;
};

// Least-squares fit of n + G (p - c) to the corner normals; G maps the plane's normal to zero. In a direction in which the polygon is so
// thin that G would leave its number range, G is zero.
Curvature fit_curvature(const Polygon& polygon) {
  Curvature k{Vec3d::Zero(), Vec3d::Zero(), Eigen::Matrix3d::Zero()};
  const auto sides = static_cast<std::size_t>(polygon.sides);
  for (std::size_t i = 0; i < sides; ++i) {
    k.n += polygon.corner_normals[i] / polygon.sides;
    k.c += polygon.corners[i] / polygon.sides;
  }
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero(), turn = Eigen::Matrix3d::Zero();
  const Eigen::Matrix3d flatten = Eigen::Matrix3d::Identity() - polygon.normal * polygon.normal.transpose();
  for (std::size_t i = 0; i < sides; ++i) {
    const Vec3d x = flatten * (polygon.corners[i] - k.c);
    spread += x * x.transpose();
    turn += (polygon.corner_normals[i] - k.n) * x.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  constexpr double kLargest = 0.9 * 32768;
  for (int i = 1; i < 3; ++i) {  // the smallest eigenvalue belongs to the plane's normal
    const Vec3d axis = (flatten * axes.eigenvectors().col(i)).normalized();
    const Vec3d slope = turn * axis / axes.eigenvalues()[i];
    if (slope.allFinite() && slope.norm() < kLargest / 2) k.g += slope * axis.transpose();
  }
  return k;
}

void append_curvature(const Curvature& k, const LengthScale& scale, std::vector<std::uint32_t>& words) {
  append_unit(words, k.n);
  for (int i = 0; i < 3; ++i) append(words, scale.to_word(k.c[i]));
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) append(words, static_cast<std::int32_t>(std::lround(k.g(row, column) * kCurvatureOne)));
  }
}

Vec3d closest_on_segment(const Vec3d& a, const Vec3d& b, const Vec3d& p) {
  const Vec3d ab = b - a;
  return a + std::clamp(ab.dot(p - a) / ab.squaredNorm(), 0.0, 1.0) * ab;
}

}  // namespace

LengthScale::LengthScale(double reach_m) : bits_(kBitsMax), resolution_(0) {
  while (bits_ >= kBitsMin && std::ldexp(2 * reach_m, bits_) >= 0x1p31) --bits_;
  if (bits_ < kBitsMin) fail("lengths of ", reach_m, " m do not fit the image's 32-bit numbers");
  resolution_ = std::ldexp(1.0, -bits_);
}

std::int32_t LengthScale::to_word(double metres) const {
  const double word = std::nearbyint(metres / resolution_);
  if (!(std::abs(word) < 0x1p31)) fail("a length of ", metres, " m does not fit the image's 32-bit numbers");
  return static_cast<std::int32_t>(word);
}

std::int32_t unit_word(double value) {
  if (!(std::abs(value) < 2)) fail("a unit vector has the component ", value);
  return static_cast<std::int32_t>(std::nearbyint(value * kUnitOne));
}

Vec3d round_unit(const Vec3d& v) { return Vec3d(unit_word(v.x()), unit_word(v.y()), unit_word(v.z())) / kUnitOne; }

ElementSet make_elements(const std::vector<Polygon>& polygons, const LengthScale& scale, double extent_m, CompileReport& report) {
  if (polygons.size() > kMaxElements) fail("the model has ", polygons.size(), " elements; the limit is ", kMaxElements, ": ", kCoarserMesh);
  const double relaxation = kSideRelaxation * extent_m;
  ElementSet set;
  set.curvature_words.assign(kCurvatureWords, 0);
  for (const Polygon& polygon : polygons) {
    Element e;
    set_plane_and_sides(polygon, scale, relaxation, e);
    set_outline(relaxation, e);
    if (!is_flat(polygon)) {
      e.curvature = static_cast<std::uint32_t>(set.curvature_words.size() / kCurvatureWords);
      append_curvature(fit_curvature(polygon), scale, set.curvature_words);
      ++report.curved_elements;
    }
    report.quads += e.sides == 4;
    append_element(e, scale, set.words);
    set.list.push_back(e);
  }
  report.elements = set.list.size();
  return set;
}

Vec3d closest_point(const Element& e, const Vec3d& p) {
  const auto sides = static_cast<std::size_t>(e.sides);
  bool inside = true;
  Vec3d best = e.corners[0];
  double best2 = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < sides; ++i) {
    const Vec3d& a = e.corners[i];
    if (e.m[i].dot(p - a) >= 0) continue;
    inside = false;
    const Vec3d q = closest_on_segment(a, e.corners[(i + 1) % sides], p);
    const double distance2 = (p - q).squaredNorm();
    if (distance2 < best2) {
      best = q;
      best2 = distance2;
    }
  }
  return inside ? Vec3d(p - (e.n.dot(p) - e.d) * e.n) : best;
}

}  // namespace lasso::mdat
