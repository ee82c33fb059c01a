#include "fsw/pose/registration/minima.hpp"

#include <cmath>

#include "fsw/geometry/symmetric6.hpp"
#include "fsw/pose/registration/weak_axis.hpp"
#include "ut/pose/pose_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

constexpr double kPeriod_m = 0.04;
constexpr double kSpacing = 1.0 / 30;  // of the radius

// Slats side by side, as in a louvre or a grating.
test::Boxes slats(int each_way, double period_m) {
  test::Boxes boxes;
  for (int i = -each_way; i <= each_way; ++i) boxes.push_back({{period_m * i, 0, 0}, {0.3 * period_m, 0.10, 0.015}, 0.02, 0.2});
  return boxes;
}

const Mission& slat_mission() {
  static const test::LoadedImage loaded(slats(6, kPeriod_m));
  return loaded.mission;
}
const Mission& close_slat_mission() {
  static const test::LoadedImage loaded(slats(12, 0.5 * kPeriod_m));
  return loaded.mission;
}

class MinimaTest : public test::PoseFixture {
 protected:
  explicit MinimaTest(const Mission& mission = slat_mission(), const test::Boxes& boxes = slats(6, kPeriod_m)) : PoseFixture(mission) {
    for (const test::BoxModel& slat : boxes) (slat.center.x() == 0 ? scan_.model = slat : scan_.others.emplace_back(slat));
    scan_.half_angle = 0.12;
    scan_.T_sensor_target.q = exp_so3(Vec3(0.3, 0.45, 0.2));
    scan_.T_sensor_target.p = Vec3(0.03, -0.02, 2.5);
    parameters().sigma0_m = scan_.sigma_m = 2e-3;
    scan();
  }

  // Of what lies within so far of the middle one: no end is seen.
  void keep_middle(double half_m) {
    keep_points([&](std::size_t, const MatchPoint<FlightNumber>& point) {
      const Vec3 p(FlightNumber::to_double(point.p[0]), FlightNumber::to_double(point.p[1]), FlightNumber::to_double(point.p[2]));
      return std::abs((truth() * p).x()) < half_m;
    });
  }

  Pose shifted(double way_m) const {
    Pose pose = truth();
    pose.p.x() += way_m;
    return pose;
  }

  // Along the row of slats, from the registration.
  Minima minima(double sigma_m, const Pose& predicted) {
    const HitSolution hits = register_first(mission_, truth(), *workspace_);
    EXPECT_EQ(hits.stop, StopReason::kConverged);
    Profile profile(mission_, Vec6::Unit(3), hits.usable, *workspace_);
    return find_minima(mission_, profile.cost_at(hits.T_target_sensor), sigma_m, predicted, profile);
  }
  double variance_along(const Mat6& spread) const { return spread(3, 3); }
  double radius_m() const { return mission_.radius_m; }
};

TEST_F(MinimaTest, SlatsLookTheSameAfterEachOfThem) {
  VERIFIES("LASSO-REG-032~3");
  ASSERT_LT(kPeriod_m, 6 * kSpacing * radius_m()) << "within reach";
  keep_middle(0.12);
  const Minima found = minima(1e-3, truth());
  EXPECT_FALSE(found.is_elsewhere);
  EXPECT_TRUE(found.are_apart);
  EXPECT_NEAR(std::sqrt(variance_along(found.spread)), kUnobservableSigma * radius_m(), 1e-6 * radius_m());
  const Vec6 scale = radius_scale(radius_m());
  const Mat6 at_radius = scale.asDiagonal() * found.spread * scale.asDiagonal();
  EXPECT_LT(at_radius.trace(), 1.02 * variance_along(found.spread)) << "all else hardly changes on the way";
}

// The next slat is beyond the last place that is looked at, whose cost still falls towards it.
class WideMinimaTest : public MinimaTest {
 protected:
  static constexpr double kWidePeriod_m = 0.07;
  static const Mission& mission() {
    static const test::LoadedImage loaded(slats(3, kWidePeriod_m));
    return loaded.mission;
  }
  WideMinimaTest() : MinimaTest(mission(), slats(3, kWidePeriod_m)) {}
};

TEST_F(WideMinimaTest, FromALastPlaceThatFallsTheMinimumBeyondIsReached) {
  VERIFIES("LASSO-REG-032~3");
  ASSERT_GT(kWidePeriod_m, 6 * kSpacing * radius_m());
  parameters().sigma0_m = scan_.sigma_m = 8e-3;
  scan();
  keep_middle(0.11);
  const Minima found = minima(1e-3, shifted(0.9 * kWidePeriod_m));
  EXPECT_TRUE(found.is_elsewhere);
  EXPECT_TRUE(found.are_apart);
  EXPECT_NEAR((found.T_target_sensor * scan_.T_sensor_target.p).x(), kWidePeriod_m, 5e-3) << "where the middle slat is taken to be";
}

// The last place lies on the slope to the second slat, higher than the place beside the first one.
class SlopingMinimaTest : public MinimaTest {
 protected:
  static constexpr double kSlopingPeriod_m = 0.03;
  static const Mission& mission() {
    static const test::LoadedImage loaded(slats(8, kSlopingPeriod_m));
    return loaded.mission;
  }
  SlopingMinimaTest() : MinimaTest(mission(), slats(8, kSlopingPeriod_m)) {}
};

TEST_F(SlopingMinimaTest, TheMinimumBeforeTheLastPlaceIsReachedWhereItLiesLower) {
  VERIFIES("LASSO-REG-032~3");
  ASSERT_NEAR(6 * kSpacing * radius_m() / kSlopingPeriod_m, 1.8, 0.05);
  keep_middle(0.12);
  const Minima found = minima(1e-3, shifted(kSlopingPeriod_m));
  EXPECT_TRUE(found.is_elsewhere);
  EXPECT_TRUE(found.are_apart);
  EXPECT_NEAR((found.T_target_sensor * scan_.T_sensor_target.p).x(), kSlopingPeriod_m, 5e-3);
}

// One slat, whose neighbours are not there.
class OneSlatTest : public MinimaTest {
 protected:
  static const Mission& mission() {
    static const test::LoadedImage loaded(slats(0, 0.07));
    return loaded.mission;
  }
  OneSlatTest() : MinimaTest(mission(), slats(0, 0.07)) {}
};

// Where the look begins all else is not yet as the hits have it: the places beside it cost less, and lead back.
TEST_F(OneSlatTest, ADescentThatEndsWhereItBeganIsNoOtherMinimum) {
  VERIFIES("LASSO-REG-032~3");
  const HitSolution hits = register_first(mission_, truth(), *workspace_);
  Profile profile(mission_, Vec6::Unit(3), hits.usable, *workspace_);
  Pose off = hits.T_target_sensor;
  off.p.z() += 0.003;
  const CostedPose from = profile.cost_at(off);
  ASSERT_LT(profile.draw_at(off, kSpacing * radius_m(), 1).cost, from.cost);
  const Minima found = find_minima(mission_, from, 1e-3, truth(), profile);
  EXPECT_FALSE(found.is_elsewhere);
  EXPECT_FALSE(found.are_apart);
  EXPECT_EQ(found.spread, Mat6(Mat6::Zero()));
}

// Two or three of them are within reach on either side.
class CloseMinimaTest : public MinimaTest {
 protected:
  CloseMinimaTest() : MinimaTest(close_slat_mission(), slats(12, 0.5 * kPeriod_m)) {}
};

TEST_F(CloseMinimaTest, OfSeveralOnASideTheLowestIsLookedAt) {
  VERIFIES("LASSO-REG-032~3");
  for (int i = 0; i < 4; ++i) {
    scan();
    keep_middle(0.12);
    const Minima found = minima(1e-4, truth());
    EXPECT_TRUE(found.are_apart);
    EXPECT_NEAR(std::sqrt(variance_along(found.spread)), kUnobservableSigma * radius_m(), 1e-6 * radius_m());
    EXPECT_LT(error_of(found.T_target_sensor).tail<3>().norm(), 5e-3);
  }
}

TEST_F(MinimaTest, OfPlacesThatLookTheSameThePredictionTells) {
  VERIFIES("LASSO-REG-032~3 LASSO-REG-033~1");
  keep_middle(0.12);
  for (const double slats : {-1.0, 1.0}) {
    const Minima found = minima(1e-3, shifted(0.8 * slats * kPeriod_m));
    EXPECT_TRUE(found.is_elsewhere) << slats;
    EXPECT_TRUE(found.are_apart) << slats;
    EXPECT_NEAR((found.T_target_sensor.p - truth().p).x(), slats * kPeriod_m, 2e-3) << slats;
  }
  const Minima found = minima(1e-3, shifted(0.4 * kPeriod_m));
  EXPECT_FALSE(found.is_elsewhere) << "the nearest";
}

TEST_F(MinimaTest, ARowWhoseEndsAreSeenHasOnePlace) {
  VERIFIES("LASSO-REG-032~3 LASSO-REG-033~1");
  const Minima found = minima(1e-3, shifted(kPeriod_m));
  EXPECT_FALSE(found.is_elsewhere) << "the prediction does not matter where the scan tells";
  EXPECT_FALSE(found.are_apart);
  EXPECT_EQ(found.spread, Mat6(Mat6::Zero()));
}

// Both neighbours are within five sigmas: their ways join the covariance as they are.
TEST_F(MinimaTest, MinimaThatTheSigmaCoversAddTheirWays) {
  VERIFIES("LASSO-REG-032~3");
  keep_middle(0.12);
  const Minima found = minima(0.011, truth());
  EXPECT_FALSE(found.are_apart);
  EXPECT_NEAR(std::sqrt(variance_along(found.spread) / 2), kPeriod_m, 1e-3);
}

// One slat's middle tells nothing of where along itself it is: no minimum, and no end of it.
TEST_F(MinimaTest, ThatNothingEndsWithinReachIsSeen) {
  VERIFIES("LASSO-REG-032~3");
  keep_points([&](std::size_t, const MatchPoint<FlightNumber>& point) {
    const Vec3 p(FlightNumber::to_double(point.p[0]), FlightNumber::to_double(point.p[1]), FlightNumber::to_double(point.p[2]));
    return std::abs((truth() * p).y()) < 0.03;
  });
  const HitSolution hits = register_first(mission_, truth(), *workspace_);
  Profile profile(mission_, Vec6::Unit(4), hits.usable, *workspace_);
  const CostedPose here = profile.cost_at(hits.T_target_sensor);
  EXPECT_TRUE(find_minima(mission_, here, 1e-3, truth(), profile).are_apart);
  EXPECT_FALSE(find_minima(mission_, here, 0.02, truth(), profile).are_apart) << "five sigmas reach beyond the last place";
}

// A pose that is sure of its place may be far from its prediction, as at a start: it is moved at most.
TEST_F(MinimaTest, WhereTheAxisIsCertainNoOthersAreLookedFor) {
  VERIFIES("LASSO-REG-032~3");
  keep_middle(0.12);
  HitSolution hits = register_first(mission_, truth(), *workspace_);
  const Vec6 row = hits.H.col(3) / std::sqrt(hits.H(3, 3));
  hits.H = 36 * (hits.H - 0.995 * row * row.transpose());  // the least certain axis, and certain, as of a sixth of the noise
  Directions unseen;
  const Eigen6 axes = axes_at_radius(covariance_of_hits(radius_m(), hits.H, 1, unseen), radius_m());
  ASSERT_LT(std::sqrt(axes.values[5]), 0.002 * radius_m());
  ASSERT_GT(std::abs(axes.vectors(3, 5)), 0.95);
  minimise_weak_axis(mission_, tracked_at(shifted(0.8 * kPeriod_m)), *workspace_, hits);
  EXPECT_FALSE(hits.others_apart);
  EXPECT_EQ(hits.spread, Mat6(Mat6::Zero()));
}

// What a registration does with it: the axis is none that the hits show, and its sigma says so.
TEST_F(MinimaTest, TheCovarianceKnowsOfTheOthers) {
  VERIFIES("LASSO-REG-032~3");
  keep_middle(0.12);
  HitSolution hits = register_first(mission_, truth(), *workspace_);
  const Vec6 row = hits.H.col(3) / std::sqrt(hits.H(3, 3));
  hits.H -= 0.995 * row * row.transpose();  // the least certain axis, and weak
  minimise_weak_axis(mission_, tracked_at(truth()), *workspace_, hits);
  ASSERT_TRUE(hits.others_apart);
  Directions unseen;
  Mat6 covariance = covariance_of_hits(radius_m(), hits.H, 1, unseen);
  ASSERT_EQ(unseen.count, 0);
  add_others(hits, covariance, unseen);
  ASSERT_EQ(unseen.count, 1);
  EXPECT_GT(std::abs(unseen.vectors(3, 0)), 0.95);
  EXPECT_GT(std::sqrt(covariance(3, 3)), 0.95 * kUnobservableSigma * radius_m());
  EXPECT_LT(error_of(hits.T_target_sensor).tail<3>().norm(), 5e-3);
  unseen.count = 6;
  add_others(hits, covariance, unseen);
  EXPECT_EQ(unseen.count, 6) << "there are no more";
}

}  // namespace
}  // namespace lasso
