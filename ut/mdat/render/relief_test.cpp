#include "mdat/render/relief.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "hal_sim/random.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

Vec3 place(sim::Random& random) {
  const double x = random.uniform(-100, 100), y = random.uniform(-100, 100);
  return {x, y, random.uniform(-100, 100)};
}

TEST(Relief, TiltsAreOfUnitSizeAndWithoutDirection) {
  VERIFIES("LASSO-PIC-012~1");
  sim::Random random(3);
  Vec3 sum = Vec3::Zero(), squares = Vec3::Zero();
  constexpr int kPlaces = 20000;
  for (int i = 0; i < kPlaces; ++i) {
    const Vec3 tilt = facet_tilt(place(random), 5);
    sum += tilt / kPlaces;
    squares += tilt.cwiseProduct(tilt) / kPlaces;
  }
  EXPECT_LT(sum.cwiseAbs().maxCoeff(), 0.05);
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(squares[axis], 1, 0.05);
}

// Along a line a facet's tilt is one for a stretch, then another: so many stretches as cells are crossed.
TEST(Relief, TiltIsOneAllOverAFacet) {
  VERIFIES("LASSO-PIC-012~1");
  std::set<double> tilts;
  int changes = 0;
  double before = 0;
  for (int i = 0; i < 20000; ++i) {
    const double tilt = facet_tilt(Vec3(0.3, -7.2, 0.001 * i), 9).x();
    tilts.insert(tilt);
    if (i > 0 && tilt != before) ++changes;
    before = tilt;
  }
  EXPECT_EQ(static_cast<int>(tilts.size()), changes + 1);  // none comes back: cells are convex
  EXPECT_GT(changes, 12);                                  // 20 units of length
  EXPECT_LT(changes, 60);
}

TEST(Relief, DependsOnPlaceAndSeedAlone) {
  VERIFIES("LASSO-PIC-012~1");
  const Vec3 p(12.3, -4.5, 6.7);
  EXPECT_EQ(facet_tilt(p, 1), facet_tilt(p, 1));
  EXPECT_NE(facet_tilt(p, 1), facet_tilt(p, 2));
  EXPECT_EQ(smooth_noise(p, 1), smooth_noise(p, 1));
  EXPECT_NE(smooth_noise(p, 1), smooth_noise(p, 2));
}

TEST(Relief, NoiseIsSmoothAndBounded) {
  VERIFIES("LASSO-PIC-012~1");
  sim::Random random(4);
  double largest = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 p = place(random);
    const double value = smooth_noise(p, 3);
    largest = std::max(largest, std::fabs(value));
    EXPECT_LT(std::fabs(smooth_noise(p + Vec3(1e-4, -1e-4, 1e-4), 3) - value), 1.5e-3);  // slopes are 3 at most along each axis
  }
  EXPECT_LE(largest, 1);
  EXPECT_GT(largest, 0.5);
}

}  // namespace
}  // namespace lasso::mdat
