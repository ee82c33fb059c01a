#include "fsw/pose/recognition/scan_subset.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "ut/pose/search_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

class EvidenceTest : public test::SearchFixture {
 protected:
  // Of the points on the boxes, to within the noise.
  std::size_t strays(const ScanSubset& subset) const {
    std::size_t count = 0;
    for (const MatchPoint<N>& point : subset.hits) {
      const Vec3 u = rotate(truth().q, to_vec3(point.u));
      test::Boxes boxes = scan_.others;
      boxes.push_back(scan_.model);
      const double range = test::cast_boxes(boxes, truth().p, u);
      if (!(std::abs(range - to_vec3(point.p).norm()) < 0.01)) ++count;
    }
    return count;
  }
};

TEST_F(EvidenceTest, LeavesOutReturnsWithoutCompany) {
  VERIFIES("LASSO-MOD-111~1");
  scan_.outliers = 0.1;
  scan();
  std::size_t before = 0;
  for (const MatchPoint<N>& point : workspace_->points) before += std::abs(to_vec3(point.p).norm() - 2.5) > 0.6 ? 1u : 0u;
  const auto subset = make_evidence();
  EXPECT_GT(before, 40u);
  EXPECT_LT(strays(*subset), 12u);
  EXPECT_GT(subset->hits.size(), 120u);
}

// By trying all of them.
TEST_F(EvidenceTest, EachReturnBelongsToTheClosestOfTheFirst) {
  VERIFIES("LASSO-MOD-115~2");
  scan_.side = 40;
  scan();
  const auto subset = make_evidence();
  ASSERT_GT(subset->hits.size(), 4 * kRegions);
  ASSERT_EQ(subset->regions.size(), subset->hits.size());
  for (std::size_t i = 0; i < subset->hits.size(); ++i) {
    const auto distance = [&](std::size_t k) { return (to_vec3(subset->hits[i].p) - to_vec3(subset->hits[k].p)).norm(); };
    ASSERT_LT(subset->regions[i], kRegions);
    for (std::size_t k = 0; k < kRegions; ++k) EXPECT_LE(distance(subset->regions[i]), distance(k) + 1e-6) << i;
  }
}

TEST_F(EvidenceTest, BeginsWithReturnsThatAreFarApart) {
  VERIFIES("LASSO-MOD-111~1");
  scan_.side = 48;
  scan();
  const auto subset = make_evidence();
  ASSERT_EQ(subset->hits.size(), kSubsetHits);
  EXPECT_GT(subset->returns, kSubsetHits);
  const auto closest = [&](std::size_t count) {
    double least = 1e9;
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < i; ++k) least = std::min(least, (to_vec3(subset->hits[i].p) - to_vec3(subset->hits[k].p)).norm());
    }
    return least;
  };
  EXPECT_GT(closest(12), 0.15);
  EXPECT_GT(closest(12), 2 * closest(96));
}

TEST_F(EvidenceTest, KnowsTheMedianOfTheDepths) {
  VERIFIES("LASSO-MOD-111~1");
  scan();
  const auto subset = make_evidence();
  ASSERT_EQ(subset->reaches.size(), subset->hits.size());
  const Vec3 sight = subset->centroid.normalized();
  int nearer = 0;
  for (std::size_t i = 0; i < subset->hits.size(); ++i) {
    const Vec3 p = to_vec3(subset->hits[i].p);
    nearer += sight.dot(p) < subset->centroid.norm() + subset->median ? 1 : -1;
    EXPECT_NEAR(static_cast<double>(subset->reaches[i].range), p.norm(), 1e-6);
    EXPECT_NEAR(subset->reaches[i].noise_m, 3e-3, 1e-6);
  }
  EXPECT_LT(std::abs(nearer), static_cast<int>(subset->hits.size() / 4));
  EXPECT_NE(subset->median, 0);
}

TEST_F(EvidenceTest, PutsAsManyPointsIntoTheWorkspaceAsAreAskedFor) {
  VERIFIES("LASSO-MOD-111~1");
  scan();
  const auto subset = make_evidence();
  put_points(*subset, 20, *workspace_);
  ASSERT_EQ(workspace_->points.size(), 20u);
  EXPECT_EQ(workspace_->points[19].p[2], subset->hits[19].p[2]);
  put_points(*subset, 1000, *workspace_);
  EXPECT_EQ(workspace_->points.size(), subset->hits.size());
}

TEST_F(EvidenceTest, CentroidIsTheMiddleOfWhatIsSeenAndNotOfThePattern) {
  VERIFIES("LASSO-MOD-111~1");
  scan();
  const Vec3 even = make_evidence()->centroid;
  // The same view with every ray of one half taken five times.
  const auto once = std::make_unique<Workspace>(*workspace_);
  workspace_->rays.clear();
  workspace_->points.clear();
  std::size_t hit = 0;
  for (const ScanRay<N>& ray : once->rays) {
    const double x = static_cast<double>(ray.u[0]) / static_cast<double>(ray.u[2]);
    for (int k = 0; k < (x < 0.02 ? 3 : 1); ++k) {
      ASSERT_TRUE(workspace_->rays.push_back(ray));
      if (ray.state == RayState::kHit) (void)workspace_->points.push_back(once->points[hit]);
    }
    if (ray.state == RayState::kHit) ++hit;
  }
  EXPECT_LT((make_evidence()->centroid - even).norm(), 0.02);
}

TEST_F(EvidenceTest, TakesEveryNthOfLargeScansAndMissesThatPassBy) {
  VERIFIES("LASSO-MOD-118~2");
  scan_.side = 64;
  scan_.half_angle = 0.5;  // most rays miss, and many by far
  scan();
  const auto subset = make_evidence();
  ASSERT_GT(workspace_->rays.size() - workspace_->points.size(), 2 * kPoolRays);
  EXPECT_GT(subset->misses.size(), 60u);
  for (const ScanRay<N>& miss : subset->misses) {
    EXPECT_EQ(miss.state, RayState::kMiss);
    EXPECT_LT(subset->centroid.cross(to_vec3(miss.u)).norm(), mission_.radius_m);
  }
  scan_.half_angle = 0.1;  // every ray hits, or nearly so
  scan();
  ASSERT_GT(workspace_->points.size(), kPoolRays);
  EXPECT_EQ(make_evidence()->hits.size(), kSubsetHits);
}

TEST_F(EvidenceTest, ThinsOutMissesThatPassBy) {
  VERIFIES("LASSO-MOD-118~2");
  scan_.half_angle = 0.3;
  scan_.side = 48;
  scan();
  const auto subset = make_evidence();
  EXPECT_GT(subset->misses_per_hit, 0.5);
  EXPECT_LE(subset->misses.size(), kSubsetMisses);
}

TEST_F(EvidenceTest, IsEmptyWhereAllReturnsAreAlone) {
  VERIFIES("LASSO-MOD-111~1");
  scan();
  keep_points([](std::size_t i, const MatchPoint<N>&) { return i % 150 == 0; });
  std::size_t index = 0;
  const auto all = std::make_unique<Workspace>(*workspace_);
  workspace_->rays.clear();
  for (const ScanRay<N>& ray : all->rays) {
    if (ray.state == RayState::kMiss || index++ % 150 == 0) (void)workspace_->rays.push_back(ray);
  }
  const auto subset = make_evidence();
  EXPECT_TRUE(subset->hits.empty());
  EXPECT_EQ(subset->centroid, Vec3::Zero());
}

TEST_F(EvidenceTest, TakesRaysOfOneDirectionAndFarOffTheBoresight) {
  VERIFIES("LASSO-MOD-111~1");
  scan();
  ScanRay<N> ray = workspace_->rays[0];
  MatchPoint<N> point = workspace_->points[0];
  ray.state = RayState::kHit;
  ray.u[0] = ray.u[1] = point.u[0] = point.u[1] = N::to<N::Unit>(0.7);
  ray.u[2] = point.u[2] = N::to<N::Unit>(-0.1);  // behind the sensor
  workspace_->rays.clear();
  workspace_->points.clear();
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(workspace_->rays.push_back(ray));
    ASSERT_TRUE(workspace_->points.push_back(point));
  }
  EXPECT_LE(make_evidence()->hits.size(), 5u);
}

}  // namespace
}  // namespace lasso
