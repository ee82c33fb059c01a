// One pass over points whose match is known by construction: the box's front face, seen straight on. The sums by brute force are in
// gauss_newton_test.cpp.
#include "fsw/pose/registration/match.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "fsw/pose/registration/gauss_newton.hpp"
#include "ut/pose/pose_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

class MatchTest : public test::PoseFixture {
 protected:
  PassSums<N> match(const PassKind& kind, double gate_m = 0.02) {
    PassSums<N> sums(mission_.radius_m);
    MatchSettings<N> settings = make_settings(mission_.parameters, *workspace_);
    set_gate(gate_m, settings);
    match_points(mission_.field, to_path<N>(truth()), settings, {workspace_->points.begin(), workspace_->points.size()}, kind, sums);
    return sums;
  }
  std::size_t matched() const {
    std::size_t count = 0;
    for (const MatchPoint<N>& point : workspace_->points) count += point.element != kNoElement ? 1u : 0u;
    return count;
  }
};

TEST_F(MatchTest, TakesEachPointOnceAndKeepsItsElement) {
  VERIFIES("LASSO-REG-001~1");
  scan();
  const PassSums<N> all = match({});
  EXPECT_GT(all.rows.count(), 100U);
  EXPECT_LE(all.rows.count(), matched());
  EXPECT_EQ(match({1, Lookup::kLast}).rows.count(), all.rows.count());
}

TEST_F(MatchTest, AStrideTakesEveryNthPoint) {
  VERIFIES("LASSO-REG-001~1");
  scan();
  const std::size_t count = workspace_->points.size();
  (void)match({4, Lookup::kWalk});
  EXPECT_LE(matched(), (count + 3) / 4);
  EXPECT_GT(matched(), count / 8);
}

TEST_F(MatchTest, AnAimedPointBesideTheModelIsNotHeldAgainstThePose) {
  VERIFIES("LASSO-REG-017~2");
  scan();
  for (MatchPoint<N>& point : workspace_->points) point.p[2] += N::to_length(5);
  EXPECT_EQ(match({}).usable, workspace_->points.size());
  for (MatchPoint<N>& point : workspace_->points) point.aimed = true;
  EXPECT_EQ(match({}).usable, 0U);
}

// Nearer to the sensor than the box by a little less, and a little more, than what the mission's noise and the gate let a match reach.
TEST_F(MatchTest, AnAimedPointCountsAsAnyOtherWhereASurfaceIsWithinItsReach) {
  VERIFIES("LASSO-REG-017~2");
  parameters().sigma_k_per_m = 2e-4;
  parameters().sigma_angle_rad = 3e-4;
  parameters().surface_sigma_m = 5e-4;
  const MissionParameters& p = parameters();
  for (const double gate_m : {0.0, 0.02}) {
    for (const double share : {0.98, 1.02}) {
      scan();
      for (MatchPoint<N>& point : workspace_->points) {
        const double z = to_vec3(point.p).norm();
        const double noise_m = p.sigma0_m + p.sigma_k_per_m * z * z + p.surface_sigma_m + 4 * p.sigma_angle_rad * z;
        const double nearer_m = share * (p.kernel_width * noise_m + 3 * gate_m);
        for (int k = 0; k < 3; ++k) point.p[k] += N::to_length(-nearer_m * N::to_double(point.u[k]));
        point.aimed = true;
      }
      EXPECT_EQ(match({}, gate_m).usable, share < 1 ? workspace_->points.size() : 0U) << "gate " << gate_m << " m, share " << share;
    }
  }
}

// Where a curved surface's normal is longer than 1 no part of the ray's noise is across it, and none is less than none.
TEST_F(MatchTest, ALongNormalLeavesNoNoiseAcrossTheRay) {
  VERIFIES("LASSO-REG-001~1");
  parameters().sigma_angle_rad = 0.01;
  scan();
  const std::uint32_t flat = match({}).rows.count();
  std::vector<Element<N>> elements(mission_.field.elements, mission_.field.elements + mission_.field.element_count);
  std::vector<Curvature<N>> curved(elements.size() + 1);
  for (std::uint32_t i = 0; i < elements.size(); ++i) {
    elements[i].curvature = i + 1;
    for (int k = 0; k < 3; ++k) curved[i + 1].n[k] = N::to<N::Unit>(1.9 * static_cast<double>(elements[i].n[k]));
  }
  mission_.field.elements = elements.data();
  mission_.field.curvatures = curved.data();
  const PassSums<N> sums = match({});
  EXPECT_GE(sums.rows.count(), flat);
  EXPECT_GE(sums.rows.chi_squared(), 0);
}

}  // namespace
}  // namespace lasso
