#include "fsw/pose/silhouette.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "ut/pose/box_contour.hpp"
#include "ut/pose/pose_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using test::BoxEdge;
using test::LineDistance;
using test::RayLine;

constexpr double kRounding = 3e-6;  // m, of a ray in single precision at 2.5 m

// The scene's contour edges, and the box's surface, in closed form.
class SilhouetteTest : public test::PoseFixture {
 protected:
  explicit SilhouetteTest(const Mission& mission = test::box_mission()) : PoseFixture(mission) {
    scan_.side = 40;
    parameters().silhouette_band_m = 0.02;
    search_.covariance = 1e-4 * Mat6::Identity();  // wide enough for the whole band
    search_.range_sigma_m = 1e-4;
    boxes_ = {scan_.model};
  }

  void find() { find_labels(mission_, truth(), search_, *workspace_); }

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
      const double met = test::cast_box(boxes_[i], truth().p, line / range);
      if (met > 0 && met < range) return false;
    }
    return true;
  }

  std::vector<BoxEdge> contour_edges() const {
    std::vector<BoxEdge> edges;
    for (std::size_t box = 0; box < boxes_.size(); ++box) {
      for (int k = 0; k < 12; ++k) {
        if (test::is_contour(boxes_, box, k, truth().p)) edges.push_back(test::edge_of_box(boxes_, box, k));
      }
    }
    return edges;
  }

  // Distance inside the edge's box, as the silhouette has it: positive where the ray meets the box.
  double signed_distance(const RayLine& line, const BoxEdge& edge) const {
    const double distance = test::line_to_edge(line, edge).m;
    return test::cast_box(boxes_[edge.box], line.origin, line.u) > 0 ? distance : -distance;
  }

  // Beside a corner the image's closest point is not quite the one in space: the difference is of second order.
  static double tolerance(double d_m) { return kRounding + 0.5 * d_m * d_m; }

  // The visible contour edge that a label belongs to: the one at its distance.
  const BoxEdge* edge_of(const Label& label, const std::vector<BoxEdge>& edges) const {
    const RayLine line = line_of(label.ray);
    for (const BoxEdge& edge : edges) {
      const LineDistance distance = test::line_to_edge(line, edge);
      if (std::abs(distance.m - std::abs(label.d_m)) < tolerance(label.d_m) && is_visible(edge, distance.point)) return &edge;
    }
    return nullptr;
  }

  double nearest(const RayLine& line, const std::vector<BoxEdge>& edges) const {
    double least = 1e9;
    for (const BoxEdge& edge : edges) least = std::min(least, test::line_to_edge(line, edge).m);
    return least;
  }

  // A return belongs to its contour edge within four edge depths (behind steep faces it lies deeper at once).
  bool may_belong_to_edge(std::size_t ray, double distance, const std::vector<BoxEdge>& edges) const {
    if (workspace_->rays[ray].state == RayState::kMiss) return true;
    for (const BoxEdge& edge : edges) {
      const LineDistance found = test::line_to_edge(line_of(ray), edge);
      const double depth = (found.point - truth().p).norm() - static_cast<double>(workspace_->rays[ray].range);
      if (found.m <= distance && std::abs(depth) > 3.9 * mission_.parameters.edge_depth_m) return false;
    }
    return true;
  }

  void expect_labels_at_contour(std::size_t at_least);

  // A pose that is known well but in one direction: many contours are too certain to be asked.
  void know_all_but_one_direction() {
    const Vec6 loose = test::random_vec6(random_, 1e-2);
    search_.covariance = 1e-7 * Mat6::Identity() + loose * loose.transpose();
  }

  test::Boxes boxes_;
  LabelSearch search_;
};

void SilhouetteTest::expect_labels_at_contour(std::size_t at_least) {
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

TEST_F(SilhouetteTest, LabelsAreTheDistancesInsideTheBoxesSilhouette) {
  VERIFIES("LASSO-REG-002~1");
  for (int i = 0; i < 10; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan();
    find();
    expect_labels_at_contour(40);
  }
}

// Past a contour that gives no label, the end of the next edge of its corner would put the ray on the wrong side.
TEST_F(SilhouetteTest, CornersDoNotMislead) {
  VERIFIES("LASSO-REG-002~1");
  scan_.side = 32;
  for (int i = 0; i < 60; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan();
    know_all_but_one_direction();
    find();
    expect_labels_at_contour(3);
  }
}

TEST_F(SilhouetteTest, EveryRayNearTheContourIsLabelled) {
  VERIFIES("LASSO-REG-002~1");
  std::size_t checked = 0;
  for (int i = 0; i < 10; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan();
    find();
    std::vector<bool> labelled(workspace_->rays.size(), false);
    for (const Label& label : workspace_->labels) labelled[label.ray] = true;
    const std::vector<BoxEdge> edges = contour_edges();
    for (std::size_t ray = 0; ray < workspace_->rays.size() && !workspace_->labels.full(); ++ray) {
      const double distance = nearest(line_of(ray), edges);
      if (distance > 0.005 || !may_belong_to_edge(ray, distance, edges)) continue;
      EXPECT_TRUE(labelled[ray]) << ray;
      ++checked;
    }
  }
  EXPECT_GT(checked, 200u);
}

TEST_F(SilhouetteTest, LabelsKnowHowTheyChangeWithThePose) {
  VERIFIES("LASSO-REG-002~1");
  constexpr double kStep = 1e-5;
  for (int i = 0; i < 5; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan();
    find();
    const std::vector<BoxEdge> edges = contour_edges();
    for (const Label& label : workspace_->labels) {
      const BoxEdge* edge = edge_of(label, edges);
      if (edge == nullptr || std::abs(label.d_m) < 1e-3) continue;  // the sign of the distance must not change
      const double side = label.d_m > 0 ? 1 : -1;
      for (int k = 0; k < 6; ++k) {
        const Vec6 step = kStep * Vec6::Unit(k);
        const double more = test::line_to_edge(line_of(label.ray, step_pose(truth(), step)), *edge).m;
        const double less = test::line_to_edge(line_of(label.ray, step_pose(truth(), -step)), *edge).m;
        // In rotation the lever ends on the image's closest point, which is about the distance off the one in space.
        EXPECT_NEAR(label.a[k], side * (more - less) / (2 * kStep), 3e-4 + (k < 3 ? 2 : 0.5) * std::abs(label.d_m)) << k;
      }
    }
  }
}

TEST_F(SilhouetteTest, LabelsSayWhereARayWasSeenNotWhereThePoseHasIt) {
  VERIFIES("LASSO-REG-002~1");
  scan();
  find();
  const auto before = std::make_unique<Workspace>(*workspace_);
  // The pose moves by 8 mm across the view: labels whose distance changed its sign keep what was seen.
  Vec6 step = Vec6::Zero();
  step.tail<3>() = rotate(truth().q, Vec3(0.006, -0.005, 0));
  const Pose moved = step_pose(truth(), step);
  find_labels(mission_, moved, search_, *workspace_);
  std::size_t contradictions = 0;
  for (const Label& label : workspace_->labels) {
    EXPECT_EQ(label.inside > 0, workspace_->rays[label.ray].state == RayState::kHit);
    contradictions += (label.inside > 0) != (label.d_m > 0) ? 1u : 0u;
    for (const Label& old : before->labels) {
      if (old.ray != label.ray || (old.a.tail<3>() - label.a.tail<3>()).norm() > 0.02) continue;
      EXPECT_NEAR(label.d_m, old.d_m + old.a.dot(step), 2e-4);
    }
  }
  EXPECT_GT(contradictions, 10u);
}

TEST_F(SilhouetteTest, LabelsFollowRaysOfTheirOwnTime) {
  VERIFIES("LASSO-REG-002~1 LASSO-REG-004~1");
  scan_.rates.omega_radps = Vec3(0.08, -0.06, 0.05);
  scan_.rates.v_mps = Vec3(0.06, -0.09, 0.05);
  for (int i = 0; i < 5; ++i) {
    scan_.T_sensor_target = test::disturb(test::generic_box_pose(), 0.3, 0.1, random_);
    scan();
    find();
    expect_labels_at_contour(40);
    for (const Label& label : workspace_->labels) {  // hit or missed as the box stood at the ray's own time
      const double tau_s = to_seconds(image_->samples[label.ray].t_us - image_->reference_time_us());
      const Pose then = inverse(propagate(scan_.T_sensor_target, scan_.rates, tau_s));
      const float* u = image_->samples[label.ray].direction;
      const RayLine line{then.p, rotate(then.q, Vec3(static_cast<double>(u[0]), static_cast<double>(u[1]), static_cast<double>(u[2])))};
      EXPECT_NEAR(nearest(line, contour_edges()), nearest(line_of(label.ray), contour_edges()), 3e-6);
    }
  }
}

TEST_F(SilhouetteTest, UnknownMissesLeaveNoOuterContour) {
  VERIFIES("LASSO-REG-009~1");
  scan();
  search_.misses_known = false;
  find();
  EXPECT_EQ(workspace_->labels.size(), 0u);
}

TEST_F(SilhouetteTest, LabelsThatThePoseMakesCertainAreLeftOut) {
  VERIFIES("LASSO-REG-002~1");
  scan();
  find();
  const std::size_t all = workspace_->labels.size();
  search_.covariance = 2e-7 * Mat6::Identity();
  find();
  EXPECT_LT(workspace_->labels.size(), all / 2);
  EXPECT_GT(workspace_->labels.size(), 5u);
  const double own_variance = parameters().silhouette_sigma_m * parameters().silhouette_sigma_m;
  for (const Label& label : workspace_->labels) {
    const double variance = label.a.dot(search_.covariance * label.a) + own_variance;
    EXPECT_LT(label.d_m * label.d_m, 36 * variance * (1 + 1e-4));
  }
}

TEST_F(SilhouetteTest, PointingNoiseAtTheTargetsRangeIsTheLabelsOwn) {
  VERIFIES("LASSO-REG-003~1");
  parameters().sigma_angle_rad = 5e-4;
  scan();
  find();
  const double range = (scan_.T_sensor_target * scan_.model.center)[2];
  ASSERT_GT(workspace_->labels.size(), 0u);
  for (const Label& label : workspace_->labels) EXPECT_NEAR(label.across_variance, std::pow(5e-4 * range, 2), 1e-12);
}

TEST_F(SilhouetteTest, ReturnsFarFromTheEdgeSayNothing) {
  VERIFIES("LASSO-REG-006~1");
  scan();
  for (ScanRay<FlightNumber>& ray : workspace_->rays) {
    if (ray.state == RayState::kHit) ray.range -= 0.5F;  // stray light in front of the target
  }
  find();
  EXPECT_GT(workspace_->labels.size(), 20u);
  for (const Label& label : workspace_->labels) EXPECT_EQ(label.inside, -1);
}

TEST_F(SilhouetteTest, NoMoreLabelsThanSites) {
  VERIFIES("LASSO-REG-002~1");
  scan_.side = 64;
  scan();
  find();
  EXPECT_TRUE(workspace_->labels.full());
  std::size_t last = 0;
  for (const Label& label : workspace_->labels) {  // the first ones in the order of the rays
    EXPECT_GE(label.ray, last);
    last = label.ray;
  }
  EXPECT_LT(last, workspace_->rays.size() * 9 / 10);
}

// A small box stands between the sensor and a part of the large one.
class OcclusionTest : public SilhouetteTest {
 protected:
  static test::BoxModel small_box() {
    test::BoxModel box;
    box.center = Vec3(0.05, 0.06, -0.25);
    box.half = Vec3(0.09, 0.07, 0.05);
    return box;
  }
  static const Mission& two_box_mission() {
    static const test::LoadedImage loaded(test::Boxes{test::BoxModel{}, small_box()});
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
    pose.q = exp_so3(Vec3(0.1, -0.12, 0.4) + test::random_vec3(random_, 0.08));
    pose.p = Vec3(0.04, -0.02, 2.4);
    return pose;
  }
  // The box that a ray meets first, or none (size of the scene).
  std::size_t seen(const RayLine& line) const {
    std::size_t box = boxes_.size();
    double nearest = 1e9;
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      const double range = test::cast_box(boxes_[i], line.origin, line.u);
      if (range <= 0 || range >= nearest) continue;
      nearest = range;
      box = i;
    }
    return box;
  }
};

TEST_F(OcclusionTest, LabelsAreAtTheVisibleContoursOfBoth) {
  VERIFIES("LASSO-REG-002~1");
  for (int i = 0; i < 6; ++i) {
    scan_.T_sensor_target = i % 2 == 0 ? over_face() : test::disturb(test::generic_box_pose(), 0.3, 0.1, random_);
    scan();
    find();
    expect_labels_at_contour(40);
  }
}

TEST_F(OcclusionTest, CornersDoNotMislead) {
  VERIFIES("LASSO-REG-002~1");
  parameters().silhouette_band_m = 0.02;
  for (int i = 0; i < 40; ++i) {
    scan_.T_sensor_target = i % 2 == 0 ? over_face() : test::disturb(test::generic_box_pose(), 0.3, 0.1, random_);
    scan();
    if (i % 4 < 2) know_all_but_one_direction();
    find();
    expect_labels_at_contour(3);
  }
}

TEST_F(OcclusionTest, StepsInRangeNeedNoMisses) {
  VERIFIES("LASSO-REG-002~1 LASSO-REG-009~1");
  search_.misses_known = false;
  std::size_t behind = 0;
  for (int i = 0; i < 4; ++i) {
    scan_.T_sensor_target = over_face();
    scan();
    find();
    expect_labels_at_contour(15);
    for (const Label& label : workspace_->labels) {
      ASSERT_EQ(workspace_->rays[label.ray].state, RayState::kHit);
      EXPECT_EQ(seen(line_of(label.ray)), label.inside > 0 ? 1u : 0u);  // the small box inside, the large one beside it
      behind += label.inside > 0 ? 0u : 1u;
    }
  }
  EXPECT_GT(behind, 20u);
}

TEST_F(OcclusionTest, StepsSmallerThanTheNoiseOrTheLimitAreNoContour) {
  VERIFIES("LASSO-REG-002~1");
  search_.misses_known = false;
  scan_.T_sensor_target = over_face();
  scan();
  parameters().edge_gap_min_m = 0.5;  // the boxes are about 0.1 m apart
  find();
  EXPECT_EQ(workspace_->labels.size(), 0u);
  parameters().edge_gap_min_m = 0.01;
  search_.range_sigma_m = 0.5 / 8;
  find();
  EXPECT_EQ(workspace_->labels.size(), 0u);
  search_.range_sigma_m = 1e-4;
  find();
  EXPECT_GT(workspace_->labels.size(), 15u);
}

}  // namespace
}  // namespace lasso
