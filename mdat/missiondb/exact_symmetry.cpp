#include "mdat/missiondb/exact_symmetry.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mdat/missiondb/value_row.hpp"

namespace lasso::mdat {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

// Of the surface, each triangle by its area: the same for any division into triangles.
Vector3d centroid_of(const Mesh& mesh) {
  Vector3d sum = Vector3d::Zero();
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const double twice = (b - a).cross(c - a).norm();
    sum += twice * (a + b + c) / 3;
    area += twice;
  }
  return area > 0 ? Vector3d(sum / area) : sum;
}

// Vertices about the centre, ordered by their distance from it, which a rotation does not change.
class Cloud {
 public:
  Cloud(const Mesh& mesh, const Vector3d& center, double tolerance_m) : tolerance_m_(tolerance_m) {
    for (const Vector3d& v : mesh.vertices) points_.push_back(v - center);
    std::sort(points_.begin(), points_.end(), [](const Vector3d& a, const Vector3d& b) { return a.squaredNorm() < b.squaredNorm(); });
    for (const Vector3d& p : points_) radii_.push_back(p.norm());
  }

  bool has(const Vector3d& p) const {
    const double radius = p.norm();
    auto i = static_cast<std::size_t>(std::lower_bound(radii_.begin(), radii_.end(), radius - tolerance_m_) - radii_.begin());
    for (; i < radii_.size() && radii_[i] <= radius + tolerance_m_; ++i) {
      if ((points_[i] - p).squaredNorm() <= tolerance_m_ * tolerance_m_) return true;
    }
    return false;
  }
  bool is_mapped_by(const Quaterniond& turn) const {
    const Eigen::Matrix3d R = turn.toRotationMatrix();
    return std::all_of(points_.rbegin(), points_.rend(), [&](const Vector3d& p) { return has(R * p); });
  }

  // Groups of points at one distance, rarest first; those near the centre, which tell a rotation badly, are left out.
  std::vector<std::vector<Vector3d>> shells() const {
    constexpr double kNear = 0.05;
    std::vector<std::vector<Vector3d>> shells;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (radii_[i] <= kNear * radii_.back()) continue;
      if (shells.empty() || radii_[i] - radii_[i - 1] > tolerance_m_) shells.emplace_back();
      add_new(shells.back(), points_[i]);
    }
    std::sort(shells.begin(), shells.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
    return shells;
  }

 private:
  // Vertices of several parts may lie in one place.
  void add_new(std::vector<Vector3d>& shell, const Vector3d& p) const {
    const auto same = [&](const Vector3d& q) { return (p - q).squaredNorm() <= tolerance_m_ * tolerance_m_; };
    if (std::none_of(shell.begin(), shell.end(), same)) shell.push_back(p);
  }

  double tolerance_m_;
  std::vector<Vector3d> points_;
  std::vector<double> radii_;
};

// Axes of a right-handed frame: towards `a`, and towards `b` across it.
Eigen::Matrix3d frame_of(const Vector3d& a, const Vector3d& b) {
  Eigen::Matrix3d frame;
  frame.col(0) = a.normalized();
  frame.col(2) = a.cross(b).normalized();
  frame.col(1) = frame.col(2).cross(frame.col(0));
  return frame;
}

bool in_line(const Vector3d& a, const Vector3d& b) { return a.cross(b).norm() < 0.05 * a.norm() * b.norm(); }

// All rotations that bring `a` and `b` onto points of their shells and the whole cloud onto itself.
std::vector<Quaterniond> turns_of(const Cloud& cloud, const std::vector<Vector3d>& shell_a, const std::vector<Vector3d>& shell_b,
                                  const Vector3d& a, const Vector3d& b, double tolerance_m) {
  std::vector<Quaterniond> turns{Quaterniond::Identity()};
  const Eigen::Matrix3d from = frame_of(a, b);
  for (const Vector3d& to_a : shell_a) {
    for (const Vector3d& to_b : shell_b) {
      if (std::fabs((to_a - to_b).norm() - (a - b).norm()) > 2 * tolerance_m) continue;
      const Quaterniond turn(Eigen::Matrix3d(frame_of(to_a, to_b) * from.transpose()));
      if (turn.angularDistance(Quaterniond::Identity()) > 1e-3 && cloud.is_mapped_by(turn)) turns.push_back(turn);
    }
  }
  return turns;
}

// One of the two directions of an axis: the one whose largest coordinate is positive.
Vector3d directed(const Vector3d& axis) {
  int largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  return axis[largest] < 0 ? Vector3d(-axis) : axis;
}

Vector3d axis_of(const Quaterniond& turn) { return directed(Eigen::AngleAxisd(turn).axis()); }

// Of a group with at least kRoundTurns turns about one axis: that axis, and one turn for each way that it may point.
void make_round(ExactSymmetry& symmetry) {
  const auto about = [](const Quaterniond& turn, const Vector3d& axis) { return axis_of(turn).cross(axis).norm() < 1e-3; };
  const std::vector<Quaterniond> turns(symmetry.turns.begin() + 1, symmetry.turns.end());
  for (const Quaterniond& turn : turns) {
    const Vector3d axis = axis_of(turn);
    const auto count = std::count_if(turns.begin(), turns.end(), [&](const Quaterniond& other) { return about(other, axis); });
    if (static_cast<std::size_t>(count) + 1 < kRoundTurns) continue;
    symmetry.axis = axis;
    symmetry.turns.resize(1);
    const auto flip = std::find_if(turns.begin(), turns.end(), [&](const Quaterniond& other) { return (other * axis).dot(axis) < 0; });
    if (flip != turns.end()) symmetry.turns.push_back(*flip);
    return;
  }
}

std::string direction_text(const Vector3d& v) {
  const auto hundredth = [](double x) { return number_text(std::round(100 * x) / 100 + 0.0); };
  return "(" + hundredth(v.x()) + ", " + hundredth(v.y()) + ", " + hundredth(v.z()) + ")";
}

}  // namespace

ExactSymmetry exact_symmetry(const Mesh& mesh, double tolerance) {
  Vector3d low = mesh.vertices.at(0), high = low;
  for (const Vector3d& v : mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  const double tolerance_m = tolerance * (high - low).maxCoeff();
  ExactSymmetry symmetry;
  symmetry.center = centroid_of(mesh);
  symmetry.turns = {Quaterniond::Identity()};
  const Cloud cloud(mesh, symmetry.center, tolerance_m);
  const auto shells = cloud.shells();
  symmetry.sphere = shells.size() == 1 && shells[0].size() > 12 * kRoundTurns;
  if (symmetry.sphere || shells.empty()) return symmetry;
  for (const auto& second : shells) {
    const Vector3d& a = shells[0].front();
    const auto b = std::find_if(second.begin(), second.end(), [&](const Vector3d& p) { return !in_line(a, p); });
    if (b == second.end()) continue;
    symmetry.turns = turns_of(cloud, shells[0], second, a, *b, tolerance_m);
    break;
  }
  make_round(symmetry);
  return symmetry;
}

std::string symmetry_text(const ExactSymmetry& symmetry) {
  if (symmetry.sphere) return "any turn";
  if (symmetry.axis) return "any turn about " + direction_text(*symmetry.axis) + (symmetry.turns.size() > 1 ? ", and end for end" : "");
  if (symmetry.turns.size() == 1) return "none";
  const auto angle = [](const Quaterniond& turn) { return turn.angularDistance(Quaterniond::Identity()); };
  const auto least = std::min_element(symmetry.turns.begin() + 1, symmetry.turns.end(),
                                      [&](const Quaterniond& a, const Quaterniond& b) { return angle(a) < angle(b) - 1e-6; });
  return std::to_string(symmetry.turns.size() - 1) + (symmetry.turns.size() == 2 ? " turn, by " : " turns, the least by ") +
         number_text(std::round(1800 * angle(*least) / std::numbers::pi) / 10) + " deg about " + direction_text(axis_of(*least));
}

}  // namespace lasso::mdat
