// Point-to-plane Gauss-Newton (Chen & Medioni 1992) around any search for the closest surface, with a facing test and a gate that shrinks
// with the residuals. The settings are the ones with which the closest-point peers do best on the benchmark's scans.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "ft/bench/peers/peer.hpp"

namespace lasso::bench {

struct PointToPlane {
  double gate_max_m = 0.015;  // farthest surface that counts as the point's
  double gate_min_m = 0.001;
  double gate_rms = 3;  // gate of the next iteration, in rms residuals of this one
  double stop_m = 1e-4;
  double stop_rad = 0.01 * 3.14159265358979323846 / 180;
  int iterations_max = 20;
  int matches_min = 12;

  PointToPlane() = default;
  explicit PointToPlane(const PeerSettings& settings)
      : gate_max_m(settings.gate_max_m), gate_min_m(settings.gate_min_m), iterations_max(settings.iterations_max) {}
};

// Closest surface: a point on it and its unit normal, target frame.
struct Surface {
  Eigen::Vector3d point, normal;
};

// H x = b over x = (rotation, translation) of the scan in target axes.
struct NormalEquations {
  double H[6][6] = {};
  double b[6] = {};
  double squares_m2 = 0;
  int matches = 0;

  void add(const Eigen::Vector3d& p, const Eigen::Vector3d& n, double residual_m) {
    const Eigen::Vector3d arm = p.cross(n);
    const double J[6] = {arm[0], arm[1], arm[2], n[0], n[1], n[2]};
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j <= i; ++j) H[i][j] += J[i] * J[j];
      b[i] += J[i] * residual_m;
    }
    squares_m2 += residual_m * residual_m;
    ++matches;
  }

  Eigen::Matrix<double, 6, 1> solve() const {
    Eigen::Matrix<double, 6, 6> A;
    Eigen::Matrix<double, 6, 1> right;
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j <= i; ++j) A(i, j) = A(j, i) = H[i][j];
      right[i] = b[i];
    }
    A.diagonal().array() += 1e-9;  // a direction without information stays where it is
    return A.ldlt().solve(right);
  }
};

inline Eigen::Isometry3d from_peer_pose(const PeerPose& pose) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(pose.R.data());
  T.translation() = Eigen::Map<const Eigen::Vector3d>(pose.p_m.data());
  return T;
}

inline PeerPose to_peer_pose(const Eigen::Isometry3d& T) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(Eigen::Matrix3d(T.linear())).normalized();
  PeerPose pose;
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(pose.R.data()) = q.toRotationMatrix();
  Eigen::Map<Eigen::Vector3d>(pose.p_m.data()) = T.translation();
  return pose;
}

inline Eigen::Isometry3d exponential_step(const Eigen::Matrix<double, 6, 1>& x) {
  const double angle_rad = x.head<3>().norm();
  Eigen::Isometry3d step = Eigen::Isometry3d::Identity();
  if (angle_rad > 1e-12) step.linear() = Eigen::AngleAxisd(angle_rad, x.head<3>() / angle_rad).toRotationMatrix();
  step.translation() = x.tail<3>();
  return step;
}

// One pass over the points. find(point, sensor origin, gate, surface) says whether there is a surface within the gate; all in target axes.
template <class Find>
NormalEquations match_all(const std::vector<Eigen::Vector3d>& points_m, const Eigen::Isometry3d& T_target_sensor, double gate_m,
                          const Find& find) {
  NormalEquations sums;
  const Eigen::Matrix3d R = T_target_sensor.linear();
  const Eigen::Vector3d origin = T_target_sensor.translation();
  Surface surface;
  for (const Eigen::Vector3d& point : points_m) {
    const Eigen::Vector3d p = R * point + origin;
    if (!find(p, origin, gate_m, surface) || surface.normal.dot(p - origin) > 0) continue;
    const double residual_m = surface.normal.dot(surface.point - p);
    if (std::fabs(residual_m) <= gate_m) sums.add(p, surface.normal, residual_m);
  }
  return sums;
}

template <class Find>
PeerResult register_points(const std::vector<Eigen::Vector3d>& points_m, const PeerPose& start, const PointToPlane& settings,
                           const Find& find) {
  Eigen::Isometry3d T_target_sensor = from_peer_pose(start).inverse();
  double gate_m = settings.gate_max_m;
  PeerResult result;
  while (result.iterations < settings.iterations_max) {
    ++result.iterations;
    const NormalEquations sums = match_all(points_m, T_target_sensor, gate_m, find);
    if (sums.matches < settings.matches_min) break;
    const Eigen::Matrix<double, 6, 1> x = sums.solve();
    T_target_sensor = exponential_step(x) * T_target_sensor;
    result.converged = x.head<3>().norm() < settings.stop_rad && x.tail<3>().norm() < settings.stop_m;
    if (result.converged) break;
    const double rms_m = std::sqrt(sums.squares_m2 / sums.matches);
    gate_m = std::clamp(settings.gate_rms * rms_m, settings.gate_min_m, settings.gate_max_m);
  }
  result.T_sensor_target = to_peer_pose(T_target_sensor.inverse());
  return result;
}

inline std::vector<Eigen::Vector3d> to_vectors(const std::vector<Triple>& points) {
  std::vector<Eigen::Vector3d> vectors;
  vectors.reserve(points.size());
  for (const Triple& p : points) vectors.emplace_back(p[0], p[1], p[2]);
  return vectors;
}

}  // namespace lasso::bench
