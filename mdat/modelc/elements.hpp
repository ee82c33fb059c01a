// Scaled integers of the image, and the elements as the flight component will see them: everything downstream is computed from these.
#pragma once

#include "mdat/modelc/model.hpp"
#include "mdat/modelc/polygons.hpp"

namespace lasso::mdat {

// Lengths as words: value = word * 2^-bits metres.
class LengthScale {
 public:
  // The finest scale at which twice `reach_m` fits 32 bits; throws CompileError if even the coarsest is too fine.
  explicit LengthScale(double reach_m);
  int bits() const { return bits_; }
  std::int32_t to_word(double metres) const;
  double round(double metres) const { return static_cast<double>(to_word(metres)) * resolution_; }
  double resolution_m() const { return resolution_; }

 private:
  int bits_;
  double resolution_;
};

// Vectors as the image rounds them.
std::int32_t unit_word(double value);  // Q1.30
Vec3d round_unit(const Vec3d& v);

// An element in the image's own numbers.
struct Element {
  Vec3d n;
  double d = 0;
  int sides = 3;
  std::array<Vec3d, 4> m;        // inward side normals
  std::array<double, 4> c;       // side offsets: inside where m.p >= c
  std::array<Vec3d, 4> corners;  // of the polygon it stands for, in the mesh
  std::array<Vec3d, 4> outline;  // of the region that the flight component accepts, a little larger
  std::uint32_t curvature = 0;
  bool two_sided = false;
};

// Side offsets are relaxed outward by this share of the extent, so that rays cannot slip between neighbours.
constexpr double kSideRelaxation = 2e-7;

struct ElementSet {
  std::vector<Element> list;
  std::vector<std::uint32_t> words, curvature_words;  // tables kElements and kCurvatures
};

// Throws CompileError over kMaxElements.
ElementSet make_elements(const std::vector<Polygon>& polygons, const LengthScale& scale, double extent_m, CompileReport& report);

// Closest point of an element's polygon (its corners, not the relaxed outline).
Vec3d closest_point(const Element& element, const Vec3d& p);

}  // namespace lasso::mdat
