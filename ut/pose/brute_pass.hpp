// A pass over the points of a scan of the box by brute force, in double: the truth for what passes sum up.
#pragma once

#include <algorithm>
#include <cmath>

#include "fsw/pose/registration/gauss_newton.hpp"
#include "ut/pose/pose_fixture.hpp"

namespace lasso::test {

// A measured point and the box, in double: where along its ray the box's front is met, and on which face.
struct Met {
  bool met = false;
  bool clear = false;  // not at an edge of a face, where rounding decides
  double t = 0;        // m, from the point along its ray
  Vec3 m = Vec3::Zero(), u = Vec3::Zero(), n = Vec3::Zero();
  double residual() const { return t * n.dot(u); }
  Vec3 q() const { return m + t * u; }
};

inline Met meet(const BoxModel& box, const Pose& T_target_sensor, const MatchPoint<FlightNumber>& point) {
  Met met;
  met.m = T_target_sensor * to_vec3(point.p);
  met.u = rotate(T_target_sensor.q, to_vec3(point.u));
  const double range = cast_box(box, met.m - 10 * met.u, met.u);
  met.met = range > 0;
  met.t = range - 10;
  Vec3 depth = (met.m + met.t * met.u - box.center).cwiseAbs() - box.half;  // 0 for the face's own axis
  int axis = 0;
  (void)depth.maxCoeff(&axis);
  met.n[axis] = met.u[axis] < 0 ? 1 : -1;
  depth[axis] = -1;
  met.clear = !met.met || depth.maxCoeff() < -1e-3;
  return met;
}

// A pass over every stride-th point by brute force, in double.
struct BruteSums {
  Mat6 H = Mat6::Zero();
  Vec6 b = Vec6::Zero();
  double chi_squared = 0, squared_range = 0;
  std::uint32_t count = 0, usable = 0;
};

struct BruteSettings {
  double width, surface2, reference2, cos_incidence_max, gate;
};

inline void add_brute(const BruteSettings& s, const MatchPoint<FlightNumber>& point, const Met& met, BruteSums& sums) {
  const double tilt = met.n.dot(met.u);
  if (met.met && std::abs(met.t) < static_cast<double>(point.reach) + 3 * s.gate && std::abs(tilt) < s.cos_incidence_max) return;
  ++sums.usable;
  if (!met.met || std::abs(met.t) > static_cast<double>(point.reach) + 3 * s.gate) return;
  const double variance =
      tilt * tilt * static_cast<double>(point.range_variance) + (1 - tilt * tilt) * static_cast<double>(point.across_variance) + s.surface2;
  const double r = met.residual();
  const double limit = s.width * s.width * variance + s.gate * s.gate;
  if (r * r >= limit) return;
  const double weight = std::pow(1 - r * r / limit, 2) / variance;
  Vec6 J;
  J << met.q().cross(met.n), met.n;
  sums.H += weight * J * J.transpose();
  sums.b += weight * r * J;
  sums.chi_squared += weight * r * r;
  sums.squared_range += met.t * met.t;
  ++sums.count;
}

class BrutePassFixture : public PoseFixture {
 protected:
  BrutePassFixture() {
    scan_.side = 20;
    scan_.sigma_m = 1e-3;
    parameters().sigma_angle_rad = 3e-4;
    parameters().surface_sigma_m = 2e-4;
  }

  MatchSettings<FlightNumber> settings(double gate_m = 0) {
    MatchSettings<FlightNumber> s = make_settings(parameters(), *workspace_);
    set_gate(gate_m, s);
    return s;
  }

  Span<MatchPoint<FlightNumber>> points() { return {workspace_->points.begin(), workspace_->points.size()}; }

  // Leaves the points out that an edge of the box could push to either side.
  void keep_clear_points(const Pose& pose) {
    keep_points([&](std::size_t, const MatchPoint<FlightNumber>& point) { return meet(scan_.model, pose, point).clear; });
  }

  BruteSums brute(const Pose& pose, double gate_m, std::size_t stride) const {
    const MissionParameters& p = mission_.parameters;
    const double surface2 = p.surface_sigma_m * p.surface_sigma_m;
    const auto reference2 = static_cast<double>(workspace_->points[workspace_->points.size() / 2].range_variance) + surface2;
    const BruteSettings s{p.kernel_width, surface2, reference2, std::cos(p.incidence_max_rad), gate_m};
    BruteSums sums;
    for (std::size_t i = 0; i < workspace_->points.size(); i += stride) {
      add_brute(s, workspace_->points[i], meet(scan_.model, pose, workspace_->points[i]), sums);
    }
    return sums;
  }

  // The mean over the points that count.
  double brute_bounded(const Pose& pose) const {
    const MissionParameters& p = mission_.parameters;
    double cost = 0;
    int usable = 0;
    for (const MatchPoint<FlightNumber>& point : workspace_->points) {
      const Met met = meet(scan_.model, pose, point);
      const bool hit = met.met && std::abs(met.t) < static_cast<double>(point.reach);
      const double tilt = met.n.dot(met.u);
      if (hit && std::abs(tilt) < std::cos(p.incidence_max_rad)) continue;
      ++usable;
      const double variance = tilt * tilt * static_cast<double>(point.range_variance) +
                              (1 - tilt * tilt) * static_cast<double>(point.across_variance) + p.surface_sigma_m * p.surface_sigma_m;
      const double share = hit ? std::min(1.0, met.residual() * met.residual() / (3 * kMostOfAReturn * variance)) : 1;
      cost += kMostOfAReturn * (1 - std::pow(1 - share, 3));
    }
    return cost / usable;
  }

  void expect_sums(const PassSums<FlightNumber>& sums, const BruteSums& truth, double reference_variance) const {
    Mat6 H;
    Vec6 b;
    sums.rows.unpack(H, b);
    H /= reference_variance;
    b /= reference_variance;
    EXPECT_EQ(sums.rows.count(), truth.count);
    EXPECT_EQ(sums.usable, truth.usable);
    const double size = std::sqrt(truth.chi_squared);
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) EXPECT_NEAR(H(i, j), truth.H(i, j), 1e-3 * std::sqrt(truth.H(i, i) * truth.H(j, j)));
      EXPECT_NEAR(b[i], truth.b[i], 1e-3 * std::sqrt(truth.H(i, i)) * size);
    }
    EXPECT_NEAR(sums.rows.chi_squared() / reference_variance, truth.chi_squared, 1e-3 * truth.chi_squared);
    EXPECT_NEAR(sums.rows.squared_range(), truth.squared_range, 1e-3 * truth.squared_range);
  }
};

}  // namespace lasso::test
