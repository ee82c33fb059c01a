#include "fsw/pose/silhouette/contour_probe.hpp"

#include "ut/pose/silhouette_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using test::BoxEdge;
using test::OcclusionTest;
using test::RayLine;

class ContourProbeTest : public OcclusionTest {
 protected:
  ContourPoint probe(const BoxEdge& edge, double along, double range_sigma_m = 1e-4) const {
    const Vec3 point = edge.a + along * (edge.b - edge.a);
    const Vec3 across = (edge.b - edge.a).cross(point - truth().p).normalized();
    return probe_contour(mission_.field, probe_settings(mission_.parameters, range_sigma_m), truth().p, point, across);
  }
  // Range of what the sensor sees a little beside an edge's point, on either side; 0 where nothing is.
  double seen_beside(const BoxEdge& edge, double along, double side) const {
    const Vec3 point = edge.a + along * (edge.b - edge.a);
    const Vec3 across = (edge.b - edge.a).cross(point - truth().p).normalized();
    const RayLine line{truth().p, (point + side * mission_.parameters.probe_step_m * across - truth().p).normalized()};
    const std::size_t box = seen(line);
    return box < boxes_.size() ? cast_box(boxes_[box], line.origin, line.u) : 0;
  }
};

TEST_F(ContourProbeTest, FindsWhatRaysBesideTheEdgeSee) {
  VERIFIES("LASSO-REG-002~1");
  int kinds[3] = {0, 0, 0};
  for (int i = 0; i < 20; ++i) {
    scan_.T_sensor_target = over_face();
    for (const BoxEdge& edge : contour_edges()) {
      const double along = random_.uniform(0.05, 0.95);
      const ContourPoint point = probe(edge, along);
      ++kinds[static_cast<int>(point.kind)];
      const double range = (edge.a + along * (edge.b - edge.a) - truth().p).norm();
      const double plus = seen_beside(edge, along, 1);
      const double minus = seen_beside(edge, along, -1);
      const double depth = mission_.parameters.edge_depth_m;
      const bool plus_meets = std::abs(plus - range) < depth;
      const bool minus_meets = std::abs(minus - range) < depth;
      if (plus_meets == minus_meets) {
        EXPECT_EQ(point.kind, ContourKind::kNone);
        continue;
      }
      const double beside = plus_meets ? minus : plus;
      if (beside > 0 && beside < range + 0.015) continue;  // something in front, or a step that is too small
      EXPECT_EQ(point.kind, beside > 0 ? ContourKind::kInner : ContourKind::kOuter);
      EXPECT_NEAR(point.range_m, range, 1e-9);
      EXPECT_NEAR(point.far_range_m, beside > 0 ? beside : range, 1e-4);
      const Vec3 across = (edge.b - edge.a).cross(edge.a + along * (edge.b - edge.a) - truth().p).normalized();
      EXPECT_GT(point.outward.dot(plus_meets ? Vec3(-across) : across), 0.999);
    }
  }
  for (const int count : kinds) EXPECT_GT(count, 3);
}

TEST_F(ContourProbeTest, AStepThatNoiseHidesIsNoContour) {
  VERIFIES("LASSO-REG-002~1");
  scan_.T_sensor_target = over_face();
  int inner = 0;
  for (const BoxEdge& edge : contour_edges()) {
    const ContourPoint point = probe(edge, 0.4);
    if (point.kind != ContourKind::kInner) continue;
    ++inner;
    const double step_m = point.far_range_m - point.range_m;
    EXPECT_EQ(probe(edge, 0.4, step_m / 8.1).kind, ContourKind::kInner);
    EXPECT_EQ(probe(edge, 0.4, step_m / 7.9).kind, ContourKind::kNone);
    EXPECT_EQ(mission_.parameters.edge_gap_min_m, probe_settings(mission_.parameters, 1e-4).gap_min_m);
  }
  EXPECT_GT(inner, 0);
}

TEST(ContourProbe, ThePointInSpaceProjectsToThePointInTheImage) {
  VERIFIES("LASSO-REG-002~1");
  ContourEdge<FlightNumber> edge{};
  edge.za = FlightNumber::Length{2};
  edge.zb = FlightNumber::Length{5};
  const double t = along_in_space(edge, 0.7);  // of an edge from (0, 2) to (1, 5) in x and depth
  EXPECT_NEAR(t / (2 + 3 * t), 0.7 * (1.0 / 5), 1e-12);
  EXPECT_EQ(along_in_space(edge, 0), 0);
  EXPECT_EQ(along_in_space(edge, 1), 1);
}

}  // namespace
}  // namespace lasso
