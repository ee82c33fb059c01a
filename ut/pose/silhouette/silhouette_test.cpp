#include "fsw/pose/silhouette/silhouette.hpp"

#include "ut/pose/silhouette_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using test::BoxEdge;
using test::kRounding;
using test::OcclusionTest;
using test::RayLine;
using test::SilhouetteTest;

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
  VERIFIES("LASSO-REG-002~1 LASSO-REG-004~2");
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
  VERIFIES("LASSO-REG-003~2");
  parameters().sigma_angle_rad = 5e-4;
  scan();
  find();
  const double range = (scan_.T_sensor_target * scan_.model.center)[2];
  ASSERT_GT(workspace_->labels.size(), 0u);
  for (const Label& label : workspace_->labels) EXPECT_NEAR(label.across_variance, std::pow(5e-4 * range, 2), 1e-12);
}

TEST_F(SilhouetteTest, ReturnsFarFromTheEdgeSayNothing) {
  VERIFIES("LASSO-REG-006~2");
  scan();
  for (ScanRay<FlightNumber>& ray : workspace_->rays) {
    if (ray.state == RayState::kHit) ray.range = ray.range - FlightNumber::Length{0.5};  // stray light in front of the target
  }
  find();
  EXPECT_GT(workspace_->labels.size(), 20u);
  for (const Label& label : workspace_->labels) EXPECT_EQ(label.inside, -1);
}

TEST_F(SilhouetteTest, NoMoreLabelsThanSites) {
  VERIFIES("LASSO-REG-002~1");
  scan_.side = 64;
  parameters().silhouette_band_m = 0.05;
  search_.covariance = 1e-3 * Mat6::Identity();
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
