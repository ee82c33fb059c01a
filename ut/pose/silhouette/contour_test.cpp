// The contour and the rays near it; and clip.hpp.
#include "fsw/pose/silhouette/contour.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "fsw/pose/scan/clip.hpp"
#include "ut/pose/box_contour.hpp"
#include "ut/pose/pose_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

class ContourTest : public test::PoseFixture {
 protected:
  Vec3 to_sensor(const Vec3& p_target) const { return scan_.T_sensor_target * p_target; }
  // In front of the sensor, so that it has an image.
  bool before(const Vec3& p_target) const { return to_sensor(p_target)[2] > 0; }

  // Near a face's plane rounding decides whether the face is seen.
  bool is_clear() const {
    const Vec3 off = ((truth().p - scan_.model.center).cwiseAbs() - scan_.model.half).cwiseAbs();
    return off.minCoeff() > 1e-4;
  }
  std::vector<std::uint32_t> brute_contour() const {
    std::vector<std::uint32_t> edges;
    for (int k = 0; k < 12; ++k) {
      const test::BoxEdge edge = test::edge_of_box({scan_.model}, 0, k);
      if (test::is_contour({scan_.model}, 0, k, truth().p) && before(edge.a) && before(edge.b))
        edges.push_back(static_cast<std::uint32_t>(k));
    }
    return edges;
  }
  std::vector<std::uint32_t> found_contour() const {
    std::vector<std::uint32_t> edges;
    for (const ContourEdge<N>& edge : workspace_->contour) edges.push_back(edge.edge);
    return edges;
  }
  void find() { find_contour(mission_, make_view(mission_, truth()), *workspace_); }
  // Leaves the model with copies of one of its contour edges alone.
  ModelEdge<N>& keep_contour_edge(std::size_t copies) {
    edges_.assign(copies, mission_.edges[brute_contour().at(0)]);
    mission_.edges = {edges_.data(), edges_.size()};
    return edges_.front();
  }

  static Eigen::Vector2d image_of(const ScanRay<N>& ray) {
    const Vec3 u = to_vec3(ray.u);
    return u.head<2>() / u[2];
  }
  // Distances of all contour edges from a ray's point in the image, at the edges' own depth, nearest first.
  std::vector<double> brute_distances(const ScanRay<N>& ray) const {
    const Eigen::Vector2d at = image_of(ray);
    std::vector<double> distances;
    for (const std::uint32_t k : brute_contour()) {
      const test::BoxEdge edge = test::edge_of_box({scan_.model}, 0, static_cast<int>(k));
      const Vec3 a = to_sensor(edge.a);
      const Vec3 b = to_sensor(edge.b);
      const Eigen::Vector2d image_a = a.head<2>() / a[2];
      const Eigen::Vector2d ab = b.head<2>() / b[2] - image_a;
      const double t = std::clamp((at - image_a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
      const double depth = 1 / ((1 - t) / a[2] + t / b[2]);
      distances.push_back((at - image_a - t * ab).norm() * depth);
    }
    std::sort(distances.begin(), distances.end());
    return distances;
  }
  void expect_edges(const ScanRay<N>& ray, const RayEdges<N>& found, double band_m) const;

  std::vector<ModelEdge<N>> edges_;
};

// The path takes depths between an edge's ends as linear in the image: within 2 % for this box.
constexpr double kDepthError = 0.02;

void ContourTest::expect_edges(const ScanRay<N>& ray, const RayEdges<N>& found, double band_m) const {
  const std::vector<double> truth = brute_distances(ray);
  const auto within = [&truth](double band) { return std::count_if(truth.begin(), truth.end(), [band](double d) { return d < band; }); };
  ASSERT_LE(found.count, std::min<long>(within(band_m * (1 + kDepthError)), kEdgesPerRay));
  ASSERT_GE(found.count, std::min<long>(within(band_m * (1 - kDepthError)), kEdgesPerRay));
  for (std::uint32_t i = 0; i < found.count; ++i) {
    EXPECT_NEAR(std::sqrt(static_cast<double>(found.distance2[i])), truth[i], kDepthError * truth[i] + 2e-6);
    EXPECT_GE(found.along[i], N::Unit{0});
    EXPECT_LE(found.along[i], N::Unit{1});
    EXPECT_FALSE(found.distance2[i] < found.distance2[i > 0 ? i - 1 : 0]);
  }
}

TEST(Project, IsAlongTheDepthAndOfNothingBehind) {
  VERIFIES("LASSO-REG-013~1");
  const PathPose<N> pose = to_path<N>(Pose());
  const N::Length before[3] = {N::to_length(0.5), N::to_length(-1), N::to_length(4)};
  EXPECT_NEAR(N::to_double(project(pose, before).x), 0.125, 1e-6);
  EXPECT_NEAR(N::to_double(project(pose, before).y), -0.25, 1e-6);
  EXPECT_EQ(project(pose, before).z, before[2]);
  const N::Length behind[3] = {N::to_length(0.5), N::to_length(-1), N::to_length(-4)};
  EXPECT_EQ(project(pose, behind).z, N::Length{0});
}

TEST_F(ContourTest, IsTheEdgesWithOneFaceTowardsTheSensor) {
  VERIFIES("LASSO-REG-002~1");
  int hexagons = 0;
  for (int i = 0; i < 200; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    if (!is_clear()) continue;
    find();
    EXPECT_EQ(found_contour(), brute_contour());
    hexagons += workspace_->contour.size() == 6 ? 1 : 0;
  }
  EXPECT_GT(hexagons, 150);
}

TEST_F(ContourTest, EdgesAreProjectedToTheTangentPlane) {
  VERIFIES("LASSO-REG-002~1");
  for (int i = 0; i < 20; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    find();
    for (const ContourEdge<N>& edge : workspace_->contour) {
      const test::BoxEdge truth = test::edge_of_box({scan_.model}, 0, static_cast<int>(edge.edge));
      const Vec3 a = to_sensor(truth.a);
      const Vec3 b = to_sensor(truth.b);
      EXPECT_NEAR(static_cast<double>(edge.x), a[0] / a[2], 5e-7);
      EXPECT_NEAR(static_cast<double>(edge.y), a[1] / a[2], 5e-7);
      EXPECT_NEAR(static_cast<double>(edge.x + edge.dx), b[0] / b[2], 5e-7);
      EXPECT_NEAR(static_cast<double>(edge.y + edge.dy), b[1] / b[2], 5e-7);
      EXPECT_NEAR(static_cast<double>(edge.za), a[2], 2e-6);
      EXPECT_NEAR(static_cast<double>(edge.zb), b[2], 2e-6);
      const double length = std::hypot(static_cast<double>(edge.dx), static_cast<double>(edge.dy));
      const double half = static_cast<double>(share_along(half_of(edge.dx) * edge.dx + half_of(edge.dy) * edge.dy, edge.length));
      EXPECT_NEAR(half, 0.5, 4 * test::rounding_of<N::Tangent>(length) / length);
    }
  }
}

TEST_F(ContourTest, EdgesBehindTheSensorAreLeftOut) {
  VERIFIES("LASSO-REG-002~1");
  int left_out = 0;
  for (int i = 0; i < 100; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan_.T_sensor_target.p = test::random_vec3(random_, 0.4) + Vec3(0, 0.4, 0);
    if (!is_clear()) continue;
    find();
    EXPECT_EQ(found_contour(), brute_contour());
    left_out += workspace_->contour.size() < 4 ? 1 : 0;
  }
  EXPECT_GT(left_out, 20);
}

TEST_F(ContourTest, AnEdgeWithoutLengthIsAPoint) {
  VERIFIES("LASSO-REG-002~1");
  scan();
  ModelEdge<N>& edge = keep_contour_edge(1);
  for (int i = 0; i < 3; ++i) edge.b[i] = edge.a[i];
  find();
  ASSERT_EQ(workspace_->contour.size(), 1u);
  find_ray_edges(make_view(mission_, truth()), FlightNumber::to_length(0.05), *workspace_);
  const Vec3 a = to_sensor(to_vec3(edge.a));
  int near = 0;
  for (std::size_t i = 0; i < workspace_->rays.size(); ++i) {
    const ScanRay<N>& ray = workspace_->rays[i];
    const double distance = (image_of(ray) - a.head<2>() / a[2]).norm() * a[2];
    if (std::abs(distance - 0.05) < 1e-5) continue;
    const RayEdges<N>& found = workspace_->ray_edges[i];
    ASSERT_EQ(found.count, distance < 0.05 ? 1u : 0u);
    if (found.count == 0) continue;
    EXPECT_NEAR(std::sqrt(static_cast<double>(found.distance2[0])), distance, 3e-6);
    EXPECT_EQ(found.along[0], N::Unit{0});
    ++near;
  }
  EXPECT_GT(near, 4);
}

TEST_F(ContourTest, ALongerContourIsCutAtItsCapacity) {
  VERIFIES("LASSO-REG-011~2");
  keep_contour_edge(kMaxContourEdges + 5);
  find();
  ASSERT_EQ(workspace_->contour.size(), kMaxContourEdges);
  EXPECT_EQ(workspace_->contour[kMaxContourEdges - 1].edge, kMaxContourEdges - 1);
}

TEST_F(ContourTest, EveryRayHasItsNearestEdges) {
  VERIFIES("LASSO-REG-002~1");
  scan_.side = 14;
  for (const double band_m : {0.006, 0.03, 0.8}) {  // the last one holds all edges: only the nearest four are kept
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan();
    find();
    find_ray_edges(make_view(mission_, truth()), FlightNumber::to_length(band_m), *workspace_);
    std::size_t edges = 0;
    for (std::size_t i = 0; i < workspace_->rays.size(); ++i) {
      expect_edges(workspace_->rays[i], workspace_->ray_edges[i], band_m);
      edges += workspace_->ray_edges[i].count;
    }
    find_rays_near_contour(make_view(mission_, truth()), FlightNumber::to_length(band_m), *workspace_);
    for (std::size_t i = 0; i < workspace_->rays.size(); ++i) {
      EXPECT_EQ(workspace_->near_contour[i], workspace_->ray_edges[i].count > 0);
    }
    EXPECT_GT(edges, band_m > 0.5 ? 3 * workspace_->rays.size() : 4u);
  }
}

TEST_F(ContourTest, EveryRayIsInItsBinOnce) {
  VERIFIES("LASSO-REG-002~1");
  scan_.side = 20;
  scan();
  find();
  find_ray_edges(make_view(mission_, truth()), FlightNumber::to_length(0.01), *workspace_);
  const RayBins<N>& bins = workspace_->bins;
  const auto bin = [](N::Tangent v, N::Tangent origin, N::BinRate scale) {
    return std::clamp(static_cast<int>(static_cast<double>((v - origin) * scale)), 0, kRayBins - 1);
  };
  std::vector<int> seen(workspace_->rays.size(), 0);
  EXPECT_EQ(bins.start[0], 0);
  EXPECT_EQ(bins.start[kRayBins * kRayBins], workspace_->rays.size());
  for (int b = 0; b < kRayBins * kRayBins; ++b) {
    ASSERT_LE(bins.start[b], bins.start[b + 1]);
    for (int k = bins.start[b]; k < bins.start[b + 1]; ++k) {
      const std::uint16_t ray = bins.ray[k];
      ++seen[ray];
      EXPECT_EQ(bin(bins.x[ray], bins.x0, bins.bins_per_x), b % kRayBins);
      EXPECT_EQ(bin(bins.y[ray], bins.y0, bins.bins_per_y), b / kRayBins);
    }
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<long>(seen.size()));
}

TEST_F(ContourTest, RaysOnOneLineOrPointHaveTheirEdgesToo) {
  VERIFIES("LASSO-REG-002~1");
  scan_.side = 12;
  scan();
  find();
  const ScanRay<N> one = workspace_->rays[30];
  for (const double tilt : {0.0, 0.02}) {
    for (std::size_t i = 0; i < workspace_->rays.size(); ++i) {
      workspace_->rays[i] = one;
      workspace_->rays[i].u[1] += N::to<N::Unit>(tilt * static_cast<double>(i) / 144);
    }
    find_ray_edges(make_view(mission_, truth()), FlightNumber::to_length(0.1), *workspace_);
    for (std::size_t i = 0; i < workspace_->rays.size(); ++i) expect_edges(workspace_->rays[i], workspace_->ray_edges[i], 0.1);
  }
}

TEST_F(ContourTest, NothingIsNearATargetBehindTheSensor) {
  VERIFIES("LASSO-REG-002~1");
  scan();
  find();
  find_rays_near_contour(make_view(mission_, truth()), FlightNumber::to_length(1.0), *workspace_);
  EXPECT_TRUE(workspace_->near_contour[0]);
  scan_.T_sensor_target.p = -scan_.T_sensor_target.p;
  find_ray_edges(make_view(mission_, truth()), FlightNumber::to_length(1.0), *workspace_);
  find_rays_near_contour(make_view(mission_, truth()), FlightNumber::to_length(1.0), *workspace_);
  for (std::size_t i = 0; i < workspace_->rays.size(); ++i) {
    EXPECT_EQ(workspace_->ray_edges[i].count, 0u);
    EXPECT_FALSE(workspace_->near_contour[i]);
  }
}

TEST_F(ContourTest, WithoutRaysThereAreNoBins) {
  VERIFIES("LASSO-REG-002~1");
  find();
  ASSERT_GT(workspace_->contour.size(), 0U);
  workspace_->bins.x0 = N::Tangent{0};
  find_ray_edges(make_view(mission_, truth()), FlightNumber::to_length(0.05), *workspace_);
  EXPECT_EQ(workspace_->bins.x0, N::Tangent{0}) << "nobody has asked where none is";
}

class ClipTest : public test::PoseFixture {
 protected:
  // How deep inside the grid the ray is at t, in cells; negative outside. A slab that the ray runs along counts as inside.
  double depth(const FieldRay<N>& ray, double t) const {
    double least = 1e9;
    for (int i = 0; i < 3; ++i) {
      if (ray.cell_u[i] == N::CellRate{0}) continue;
      const double at = static_cast<double>(ray.cell_m[i]) + t * static_cast<double>(ray.cell_u[i]);
      least = std::min({least, at, mission_.field.cells[i] - at});
    }
    return least;
  }
  FieldRay<N> random_ray(int parallel_axis) {
    FieldRay<N> ray{};
    const Vec3 m = mission_.center_m + test::random_vec3(random_, 1.2);
    Vec3 u = test::random_vec3(random_, 1);
    if (parallel_axis < 3) u[parallel_axis] = 0;
    u.normalize();
    for (int i = 0; i < 3; ++i) {
      ray.m[i] = N::to_length(m[i]);
      ray.u[i] = N::to<N::Unit>(u[i]);
    }
    set_cells(mission_.field, ray);
    return ray;
  }
};

TEST_F(ClipTest, ARayIsInsideTheGridExactlyWithinItsSpan) {
  VERIFIES("LASSO-IMG-007~2");
  int met = 0;
  for (int i = 0; i < 100; ++i) {
    const FieldRay<N> ray = random_ray(i % 8);
    const FieldSpan<N> span = clip_to_grid(mission_.field, ray);
    bool inside_somewhere = false;
    for (int k = -200; k <= 200; ++k) {
      const double t = 0.02 * k;
      const double cells = depth(ray, t);
      if (std::abs(cells) < 1e-3) continue;
      EXPECT_EQ(cells > 0, t > static_cast<double>(span.enter) && t < static_cast<double>(span.leave)) << t;
      inside_somewhere = inside_somewhere || cells > 0;
    }
    met += inside_somewhere ? 1 : 0;
  }
  EXPECT_GT(met, 25);
  EXPECT_LT(met, 95);
}

TEST_F(ClipTest, ARayWithoutDirectionIsNotBounded) {
  VERIFIES("LASSO-IMG-007~2");
  FieldRay<N> ray{};
  set_cells(mission_.field, ray);
  const FieldSpan<N> span = clip_to_grid(mission_.field, ray);
  EXPECT_EQ(span.enter, N::to_length(-N::kFarthest_m));
  EXPECT_EQ(span.leave, N::to_length(N::kFarthest_m));
}

// From twice as far as places in the grid have numbers for.
TEST(CastRay, ARayFromFarAwayMeetsWhatOneFromNearbyMeets) {
  VERIFIES("LASSO-IMG-007~2");
  const test::BoxModel box{{0.002, -0.001, 0.003}, {0.03, 0.02, 0.012}, 0.001, 0.01};
  test::TestImage image = test::make_box_image(preset_parameters(), box);
  const auto mission = std::make_unique<Mission>();
  ASSERT_EQ(load_image(Bytes(image.data(), image.size), *mission).status, Status::kOk);
  const double far_m = 2 * box.cell_m * static_cast<double>(N::kFarthestCell);
  test::Generator random{5};
  for (int i = 0; i < 200; ++i) {
    const Vec3 u = test::random_vec3(random, 1).normalized();
    const Vec3 through = box.center + test::random_vec3(random, 0.01);
    const auto ray_through = [&](const Vec3& place, double side) {
      FieldRay<N> ray{};
      for (int k = 0; k < 3; ++k) {
        ray.u[k] = N::to<N::Unit>(side * u[k]);
        ray.m[k] = N::to_length(place[k] - far_m * u[k]);
      }
      return ray;
    };
    const FieldHit<N> hit = cast_ray(mission->field, ray_through(through, 1));
    ASSERT_TRUE(hit.found) << i;
    EXPECT_NEAR(static_cast<double>(hit.t), test::cast_box(box, through - far_m * u, u), 1e-6 * far_m) << i;
    EXPECT_FALSE(cast_ray(mission->field, ray_through(through, -1)).found) << "it is behind";
    const Vec3 beside = u.cross(Vec3(0.6, 0.8, 0)).normalized();
    EXPECT_FALSE(cast_ray(mission->field, ray_through(through + 0.06 * beside, 1)).found) << "it is passed";
    EXPECT_FALSE(cast_ray(mission->field, ray_through(through + far_m * beside, 1)).found) << "and from afar";
  }
}

}  // namespace
}  // namespace lasso
