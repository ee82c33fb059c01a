// Where a contour says nothing, or less than it could: bounds and degenerate views of silhouette.hpp.
#include "ut/pose/silhouette_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using N = FlightNumber;
using test::BoxModel;
using test::OcclusionTest;
using test::SilhouetteTest;

// The model has one edge alone, which is on the contour: a at `a_sensor`, b at `b_sensor`.
class OneEdgeTest : public SilhouetteTest {
 protected:
  void find_from_edge(const Vec3& a_sensor, const Vec3& b_sensor) {
    const Vec3 a = truth() * a_sensor;
    const Vec3 b = truth() * b_sensor;
    ModelEdge<N> edge = mission_.edges[0];
    for (int i = 0; i < 3; ++i) {
      edge.a[i] = N::to_length(a[i]);
      edge.b[i] = N::to_length(b[i]);
    }
    const auto beyond_sensor = [&](const N::Unit* n, double by_m) { return N::to_length(truth().p.dot(to_vec3(n)) + by_m); };
    edge.d0 = beyond_sensor(edge.n0, -1);  // this face sees the sensor
    edge.d1 = beyond_sensor(edge.n1, 1);   // and this one does not
    mission_.edges = {&edge, 1};
    find();
  }
  std::size_t rays_near_the_edge() const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < workspace_->rays.size(); ++i) count += workspace_->ray_edges[i].count;
    return count;
  }
};

TEST_F(OneEdgeTest, AtTheSensorItIsNoContour) {
  VERIFIES("LASSO-REG-002~1");
  scan();
  find_from_edge(Vec3(-2e-4, 1e-4, 5e-4), Vec3(2e-4, 1e-4, 5e-4));
  EXPECT_EQ(rays_near_the_edge(), workspace_->rays.size());
  EXPECT_EQ(workspace_->labels.size(), 0u);
}

TEST_F(OneEdgeTest, WithoutLengthItHasNoSides) {
  VERIFIES("LASSO-REG-002~1");
  scan();
  const Vec3 corner = scan_.T_sensor_target * Vec3(scan_.model.center - scan_.model.half);
  find_from_edge(corner, corner);
  EXPECT_GT(rays_near_the_edge(), 3u);
  EXPECT_EQ(workspace_->labels.size(), 0u);
}

// A box with a corner at the target's origin, on the boresight: no rounding on the way.
class CornerTest : public SilhouetteTest {
 protected:
  static BoxModel corner_box() {
    BoxModel box;
    box.center = box.half;
    return box;
  }
  static const Mission& corner_mission() {
    static const test::LoadedImage loaded({corner_box()});
    return loaded.mission;
  }
  CornerTest() : SilhouetteTest(corner_mission()) {
    scan_.model = corner_box();
    boxes_ = {scan_.model};
    scan_.T_sensor_target.q = Quat(1, 0, 0, 0);
    scan_.T_sensor_target.p = Vec3(0, 0, 2.5);
  }
};

TEST_F(CornerTest, ARayThroughItIsOnItsEdge) {
  VERIFIES("LASSO-REG-002~1");
  ScanRay<N> ray{};
  ray.u[2] = N::Unit{1};
  ray.range = N::Length{2.5};
  ray.state = RayState::kHit;
  ASSERT_TRUE(workspace_->rays.push_back(ray));
  find();
  ASSERT_EQ(workspace_->labels.size(), 1u);
  const Label& label = workspace_->labels[0];
  EXPECT_EQ(label.inside, 1);
  EXPECT_EQ(label.d_m, 0);
  const Vec3 outward = -label.a.tail<3>();  // across one of the two edges that meet there, away from the box
  EXPECT_NEAR(outward.norm(), 1, 1e-12);
  EXPECT_NEAR(outward.minCoeff(), -1, 1e-12);
  EXPECT_EQ(outward[2], 0);
}

TEST_F(OcclusionTest, BesideWhatHidesOneSideOfItAnEdgeIsNoContour) {
  VERIFIES("LASSO-REG-002~1");
  parameters().probe_step_m = 0.008;
  for (int i = 0; i < 60; ++i) {
    scan_.T_sensor_target = test::disturb(over_face(), 0.7, 0.1, random_);
    scan();
    find();
    expect_labels_at_contour(10);
  }
}

TEST_F(OcclusionTest, ReturnsFarBehindAStepSayNothing) {
  VERIFIES("LASSO-REG-006~2");
  search_.misses_known = false;
  scan_.T_sensor_target = over_face();
  scan();
  std::size_t behind = 0;
  for (std::size_t i = 0; i < workspace_->rays.size(); ++i) {
    if (workspace_->rays[i].state == RayState::kHit && seen(line_of(i)) == 0) {
      workspace_->rays[i].range += N::Length{0.5};
      ++behind;
    }
  }
  ASSERT_GT(behind, 100u);
  find();
  EXPECT_GT(workspace_->labels.size(), 5u);
  for (const Label& label : workspace_->labels) EXPECT_EQ(label.inside, 1);
}

// Seen from its edge: rays that hit it pass between two contours.
class PlateTest : public SilhouetteTest {
 protected:
  static constexpr double kHalfThickness_m = 0.004;
  static BoxModel plate() {
    BoxModel box;
    box.half = Vec3(0.06, kHalfThickness_m, 0.12);
    return box;
  }
  static const Mission& plate_mission() {
    static const test::LoadedImage loaded({plate()});
    return loaded.mission;
  }
  PlateTest() : SilhouetteTest(plate_mission()) {
    scan_.model = plate();
    boxes_ = {scan_.model};
    scan_.side = 64;
    scan_.half_angle = 0.03;
  }
  void look_along() {
    const Quat about_boresight = exp_so3(Vec3(0, 0, random_.uniform(-3, 3)));
    scan_.T_sensor_target.q = about_boresight * exp_so3(Vec3(0, random_.uniform(-0.2, 0.2), 0));
    scan_.T_sensor_target.p = Vec3(0, 0, 2.5) - rotate(about_boresight, Vec3(0, scan_.model.center[1], 0));
    scan();
    find();
  }
};

TEST_F(PlateTest, RaysBetweenTwoContoursAreLabelledByBoth) {
  VERIFIES("LASSO-REG-002~1");
  std::size_t pairs = 0;
  for (int i = 0; i < 10; ++i) {
    look_along();
    for (std::size_t k = 1; k < workspace_->labels.size(); ++k) {
      const Label& one = workspace_->labels[k - 1];
      const Label& other = workspace_->labels[k];
      if (one.ray != other.ray) continue;
      EXPECT_EQ(one.inside, 1);
      EXPECT_EQ(other.inside, 1);
      EXPECT_LT(one.a.tail<3>().dot(other.a.tail<3>()), -0.5);
      EXPECT_LE(one.d_m, other.d_m);
      if (one.a.tail<3>().dot(other.a.tail<3>()) < -0.999) {
        EXPECT_NEAR(one.d_m + other.d_m, 2 * kHalfThickness_m, 1e-3);
        ++pairs;
      }
    }
  }
  EXPECT_GT(pairs, 100u);
}

TEST_F(PlateTest, TheLastSiteMayHoldTheFirstOfTwoLabels) {
  VERIFIES("LASSO-REG-002~1 LASSO-REG-011~2");
  int full = 0;
  int cut = 0;
  for (int i = 0; i < 40; ++i) {
    look_along();
    if (!workspace_->labels.full()) continue;
    ++full;
    EXPECT_EQ(workspace_->labels.size(), kMaxSites);
    const Label& last = workspace_->labels[kMaxSites - 1];
    cut += last.d_m > 0 && workspace_->labels[kMaxSites - 2].ray != last.ray ? 1 : 0;
  }
  EXPECT_GT(full, 10);
  EXPECT_GT(cut, 0);
}

}  // namespace
}  // namespace lasso
