// The part of the field that points use: closest elements near the surface, foot points everywhere.
#pragma once

#include <memory>

#include "mdat/modelc/grid.hpp"

namespace lasso::mdat {

struct NearestElement {
  std::uint32_t element = kNone;
  double distance_m = 0;
  Vec3d point = Vec3d::Zero();
};

// Exact closest-element search (Embree point queries over boxes, distances in double). Safe to use from several threads.
class NearestSearch {
 public:
  explicit NearestSearch(const std::vector<Element>& elements);  // must outlive the search
  ~NearestSearch();

  // Of equally close elements (within 1e-9 of the model's size), the one on whose plane the point lies farthest in front or behind, then
  // the first.
  NearestElement closest(const Vec3d& p) const;
  // The closest of those within `radius_m` whose normal points against `normal` (dot product below -1e-6), or kNone.
  NearestElement closest_opposing(const Vec3d& p, const Vec3d& normal, double radius_m) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

struct NearField {
  std::vector<std::uint32_t> brick_words;         // word 1 of each brick
  std::vector<std::uint32_t> cells, foot_points;  // tables kNearCells and kFootPoints
};

NearField make_near_field(const std::vector<Element>& elements, const Grid& grid, const LengthScale& scale, double band_m,
                          CompileReport& report);

}  // namespace lasso::mdat
