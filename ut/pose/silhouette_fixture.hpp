// What the tests of the silhouettes share: contour edges and surfaces of boxes in closed form, and labels against them.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "fsw/pose/silhouette/silhouette.hpp"
#include "ut/pose/box_contour.hpp"
#include "ut/pose/pose_fixture.hpp"

namespace lasso::test {

constexpr double kRounding = 3e-6;  // m, of a ray in single precision at 2.5 m

// The scene's contour edges, and the box's surface, in closed form.
class SilhouetteTest : public PoseFixture {
 protected:
  explicit SilhouetteTest(const Mission& mission = box_mission()) : PoseFixture(mission) {
    scan_.side = 40;
    parameters().silhouette_band_m = 0.02;
    search_.covariance = 1e-4 * Mat6::Identity();  // wide enough for the whole band
    search_.range_sigma_m = 1e-4;
    boxes_ = {scan_.model};
  }

  void find() {
    search_.band_m = parameters().silhouette_band_m;
    find_labels(mission_, truth(), search_, *workspace_);
  }

  // A ray's line in the target frame at a pose, from the workspace's ray.
  RayLine line_of(std::size_t ray, const Pose& T_target_sensor) const {
    Vec3 o;
    Vec3 u;
    for (int i = 0; i < 3; ++i) {
      o[i] = static_cast<double>(workspace_->rays[ray].o[i]);
      u[i] = static_cast<double>(workspace_->rays[ray].u[i]);
    }
    return {T_target_sensor * o, rotate(T_target_sensor.q, u.normalized())};
  }
  RayLine line_of(std::size_t ray) const { return line_of(ray, truth()); }

  // The sensor sees an edge's point unless a box is in the way.
  bool is_visible(const BoxEdge& edge, const Vec3& point) const {
    const Vec3 line = point - truth().p;
    const double range = line.norm();
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      if (i == edge.box) continue;
      const double met = cast_box(boxes_[i], truth().p, line / range);
      if (met > 0 && met < range) return false;
    }
    return true;
  }

  std::vector<BoxEdge> contour_edges() const {
    std::vector<BoxEdge> edges;
    for (std::size_t box = 0; box < boxes_.size(); ++box) {
      for (int k = 0; k < 12; ++k) {
        if (is_contour(boxes_, box, k, truth().p)) edges.push_back(edge_of_box(boxes_, box, k));
      }
    }
    return edges;
  }

  // Distance inside the edge's box, as the silhouette has it: positive where the ray meets the box.
  double signed_distance(const RayLine& line, const BoxEdge& edge) const {
    const double distance = line_to_edge(line, edge).m;
    return cast_box(boxes_[edge.box], line.origin, line.u) > 0 ? distance : -distance;
  }

  // Beside a corner the image's closest point is not quite the one in space: the difference is of second order.
  static double tolerance(double d_m) { return kRounding + 0.5 * d_m * d_m; }

  // The visible contour edge that a label belongs to: the one that comes nearest to its distance.
  const BoxEdge* edge_of(const Label& label, const std::vector<BoxEdge>& edges) const {
    const RayLine line = line_of(label.ray);
    const BoxEdge* best = nullptr;
    double least = tolerance(label.d_m);
    for (const BoxEdge& edge : edges) {
      const LineDistance distance = line_to_edge(line, edge);
      const double off = std::abs(distance.m - std::abs(label.d_m));
      if (off >= least || !is_visible(edge, distance.point)) continue;
      least = off;
      best = &edge;
    }
    return best;
  }

  double nearest(const RayLine& line, const std::vector<BoxEdge>& edges) const {
    double least = 1e9;
    for (const BoxEdge& edge : edges) least = std::min(least, line_to_edge(line, edge).m);
    return least;
  }

  // A return belongs to its contour edge within four edge depths (behind steep faces it lies deeper at once).
  bool may_belong_to_edge(std::size_t ray, double distance, const std::vector<BoxEdge>& edges) const {
    if (workspace_->rays[ray].state == RayState::kMiss) return true;
    for (const BoxEdge& edge : edges) {
      const LineDistance found = line_to_edge(line_of(ray), edge);
      const double depth = (found.point - truth().p).norm() - static_cast<double>(workspace_->rays[ray].range);
      if (found.m <= distance && std::abs(depth) > 3.9 * mission_.parameters.edge_depth_m) return false;
    }
    return true;
  }

  void expect_labels_at_contour(std::size_t at_least);

  // A pose that is known well but in one direction: many contours are too certain to be asked.
  void know_all_but_one_direction() {
    const Vec6 loose = random_vec6(random_, 1e-2);
    search_.covariance = 1e-7 * Mat6::Identity() + loose * loose.transpose();
  }

  Boxes boxes_;
  LabelSearch search_;
};

inline void SilhouetteTest::expect_labels_at_contour(std::size_t at_least) {
  const std::vector<BoxEdge> edges = contour_edges();
  EXPECT_GE(workspace_->labels.size(), at_least);
  for (const Label& label : workspace_->labels) {
    const BoxEdge* edge = edge_of(label, edges);
    ASSERT_NE(edge, nullptr) << label.d_m;
    if (std::abs(label.d_m) < kRounding) continue;
    EXPECT_NEAR(label.d_m, signed_distance(line_of(label.ray), *edge), tolerance(label.d_m));
    EXPECT_EQ(label.inside > 0, label.d_m > 0);  // seen from the truth, a ray without noise is where it was seen
  }
}

// A small box stands between the sensor and a part of the large one.
class OcclusionTest : public SilhouetteTest {
 protected:
  static BoxModel small_box() {
    BoxModel box;
    box.center = Vec3(0.05, 0.06, -0.25);
    box.half = Vec3(0.09, 0.07, 0.05);
    return box;
  }
  static const Mission& two_box_mission() {
    static const LoadedImage loaded(Boxes{BoxModel{}, small_box()});
    return loaded.mission;
  }
  OcclusionTest() : SilhouetteTest(two_box_mission()) {
    boxes_.push_back(small_box());
    scan_.others = {small_box()};
    scan_.side = 50;
    parameters().silhouette_band_m = 0.01;
  }
  // A pose from which the small box stands before the large one, partly or not at all over its edge.
  Pose over_face() {
    Pose pose;
    pose.q = exp_so3(Vec3(0.1, -0.12, 0.4) + random_vec3(random_, 0.08));
    pose.p = Vec3(0.04, -0.02, 2.4);
    return pose;
  }
  // The box that a ray meets first, or none (size of the scene).
  std::size_t seen(const RayLine& line) const {
    std::size_t box = boxes_.size();
    double nearest = 1e9;
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      const double range = cast_box(boxes_[i], line.origin, line.u);
      if (range <= 0 || range >= nearest) continue;
      nearest = range;
      box = i;
    }
    return box;
  }
};

}  // namespace lasso::test
