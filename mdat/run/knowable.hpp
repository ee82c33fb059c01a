// Whether a scan can tell the pose at all: what its hits and its hit or miss labels say at the true pose.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "fsw/geometry/se3.hpp"
#include "fsw/sense/range_image.hpp"
#include "hal_sim/ray_caster.hpp"
#include "mdat/modelc/mesh.hpp"
#include "mdat/run/symmetric_error.hpp"

namespace lasso::mdat {

struct KnowableNoise {
  double sigma0_m = 0, sigma_k_per_m = 0;  // along the ray: sqrt(sigma0^2 + (k z^2)^2)
  double sigma_angle_rad = 0;              // of the ray
  double surface_sigma_m = 0;              // of the model, along the normal
};

// The target's surface with smooth normals, as the estimator has them: the facets of a round solid tell nothing of its roll.
class KnowableTarget {
 public:
  // Faces that meet at less than `crease_rad` are one smooth surface.
  KnowableTarget(const Mesh& mesh, double crease_rad, const KnowableNoise& noise, double size_m);

  // True where three Cramer-Rao sigmas of the hits lie within kWrongShare of the size and kWrongTurn_rad, in each direction; or where, for
  // each direction that the hits leave open, a pose that far off along it either way changes the label of at least three rays: hit becomes
  // miss or the reverse, or the range jumps by more than a hundredth of the size and 10 sigma. Each label is nearly certain, so three
  // exclude that pose. Only poses that near are asked: one at another attitude may explain the scan as well. The target stands still;
  // `scan` has the directions, and which rays the sensor looked along.
  bool is_determined(const Pose& T_sensor_target, std::span<const RangeSample> scan) const;

  const sim::RayCaster& surface() const { return *surface_; }

 private:
  struct Return;
  std::vector<Return> cast_all(const Pose& T_sensor_target, std::span<const RangeSample> scan) const;
  Mat6 information_of(const std::vector<Return>& returns) const;
  int changed_labels(const std::vector<Return>& before, const std::vector<Return>& after) const;
  Vec3 smooth_normal(std::uint32_t triangle, const Vec3& p) const;
  double range_sigma_m(double depth_m) const;

  std::vector<std::array<Vec3, 3>> corners_, normals_;  // of each triangle that the surface has
  std::unique_ptr<sim::RayCaster> surface_;
  KnowableNoise noise_;
  double size_m_;
};

}  // namespace lasso::mdat
