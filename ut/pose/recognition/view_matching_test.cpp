#include "fsw/pose/recognition/view_matching.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "fsw/geometry/portable_math.hpp"
#include "fsw/pose/scan/work_units.hpp"
#include "ut/pose/search_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

double angle_between(const Quat& a, const Quat& b) { return 2 * std::acos(std::min(1.0, std::abs(a.dot(b)))); }

class CoarseTest : public test::SearchFixture {
 protected:
  // Angle of the hypothesis that is nearest to the truth, or to it turned by half a turn about an axis of the main box: three boxes leave
  // little to tell them apart by distances alone.
  double nearest(const ShortList& list) const {
    double least = 10;
    for (std::size_t i = 0; i < list.size(); ++i) {
      for (const Quat& symmetric : {Quat(1, 0, 0, 0), Quat(0, 1, 0, 0), Quat(0, 0, 1, 0), Quat(0, 0, 0, 1)}) {
        least = std::min(least, angle_between(list[i].T_target_sensor.q, symmetric * truth().q));
      }
    }
    return least;
  }

  std::size_t search(ViewMatcher& coarse, const ScanSubset& subset) const {
    std::size_t steps = 0;
    while (!coarse.done()) {
      EXPECT_LE(coarse.step(mission_, subset), view_work(kCoarsePoints, kRolls / 2 * kCoarsePoints, kRolls));
      ++steps;
    }
    return steps;
  }

  // The sum of distances, in floating point.
  double sum_at(const Pose& T_target_sensor, const ScanSubset& subset) const {
    const SearchTables<FlightNumber>& tables = mission_.search;
    double sum = 0;
    for (std::size_t i = 0; i < std::min(kCoarsePoints, subset.hits.size()); ++i) {
      const Vec3 p = T_target_sensor * to_vec3(subset.hits[i].p);
      std::uint32_t cell[3];
      for (int k = 0; k < 3; ++k) {
        const double place = static_cast<double>(tables.cells_per_m) * (p[k] - static_cast<double>(tables.origin_m[k]));
        cell[k] = static_cast<std::uint32_t>(static_cast<std::int32_t>(std::floor(place)));
      }
      sum += distance_byte(tables, cell[0], cell[1], cell[2]);
    }
    return sum;
  }

  static bool has_one_as_good(const ShortList& list, const Pose& pose, double sum) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (angle_between(list[i].T_target_sensor.q, pose.q) < 15.1 * kRadPerDeg && list[i].score <= 1.02 * sum) return true;
    }
    return false;
  }
};

// Independently of how it is looked for: each listed hypothesis at each other roll about the line of sight was looked at, too.
TEST_F(CoarseTest, ListsTheSumsAndLeavesOutNothingThatIsClearlyBetter) {
  VERIFIES("LASSO-MOD-111~1");
  int better = 0;
  for (int view = 0; view < 6; ++view) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan();
    const auto subset = make_evidence();
    ViewMatcher coarse;
    coarse.begin(mission_, *subset);
    search(coarse, *subset);
    const ShortList& list = coarse.short_list();
    const Vec3 sight = subset->centroid.normalized();
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Pose& T = list[i].T_target_sensor;
      EXPECT_NEAR(list[i].score, sum_at(T, *subset), 0.02 * list[i].score);
      for (std::uint32_t roll = 1; roll < kRolls; ++roll) {
        Pose turn{exp_so3(2 * kPi / kRolls * roll * sight), Vec3::Zero()};
        turn.p = subset->centroid - rotate(turn.q, subset->centroid);
        const Pose other = T * turn;
        const double sum = sum_at(other, *subset);
        if (sum > 0.8 * list.limit()) continue;
        ++better;
        EXPECT_TRUE(has_one_as_good(list, other, sum)) << sum << " of " << list.limit();
      }
    }
  }
  EXPECT_GT(better, 20);
}

TEST_F(CoarseTest, HasAHypothesisNearTheTruth) {
  VERIFIES("LASSO-MOD-111~1");
  int near = 0;
  for (int i = 0; i < 12; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan_.T_sensor_target.p[2] = i % 2 == 0 ? 2.5 : 4.0;
    scan();
    const auto subset = make_evidence();
    ViewMatcher coarse;
    coarse.begin(mission_, *subset);
    const std::size_t steps = search(coarse, *subset);
    EXPECT_GE(steps, mission_.search.views.size());
    EXPECT_LE(steps, 2 * mission_.search.views.size());
    EXPECT_EQ(coarse.short_list().size(), kShortList);
    near += nearest(coarse.short_list()) < 25 * kRadPerDeg ? 1 : 0;
  }
  EXPECT_GE(near, 9);
}

TEST_F(CoarseTest, TakesVeryNearAndEmptyEvidence) {
  VERIFIES("LASSO-MOD-111~1");
  auto subset = std::make_unique<ScanSubset>();
  ViewMatcher coarse;
  coarse.begin(mission_, *subset);
  EXPECT_GT(coarse.step(mission_, *subset), 0u);
  EXPECT_FALSE(coarse.done());
  EXPECT_EQ(coarse.short_list()[0].score, 0u);
}

// A thin part that the returns have and the view has not, or the other way round, moves a middle but not the median.
TEST_F(CoarseTest, LaysAViewByTheMedianOfTheDepthsToo) {
  VERIFIES("LASSO-MOD-111~1");
  ModelView<FlightNumber> view{};
  view.direction[2] = FlightNumber::Unit{1};
  mission_.search.views = {&view, 1};
  auto subset = std::make_unique<ScanSubset>();
  subset->centroid = Vec3(0, 0, 3);
  const double truncation = static_cast<double>(mission_.search.truncation_m);
  for (const double median : {-0.6 * truncation, 0.4 * truncation, 0.6 * truncation}) {
    subset->median = median;
    ViewMatcher coarse;
    coarse.begin(mission_, *subset);
    coarse.step(mission_, *subset);
    EXPECT_EQ(coarse.done(), std::abs(median) < 0.5 * truncation);
    if (coarse.done()) continue;
    EXPECT_EQ(search(coarse, *subset), 1u);
    const Pose first = coarse.short_list()[0].T_target_sensor;
    EXPECT_NEAR((first * subset->centroid).z(), 0, 1e-6);
  }
}

TEST_F(CoarseTest, TheSecondPlaceOfAViewHasTheMediansAlike) {
  VERIFIES("LASSO-MOD-111~1");
  ModelView<FlightNumber> view{};
  view.direction[2] = FlightNumber::Unit{1};
  view.median = view.near_median = FlightNumber::to_length(0.2);
  mission_.search.views = {&view, 1};
  scan();
  auto subset = make_evidence();
  subset->median = 0.05;
  ViewMatcher coarse;
  coarse.begin(mission_, *subset);
  EXPECT_EQ(search(coarse, *subset), 2u);
  int second = 0;
  for (std::size_t i = 0; i < coarse.short_list().size(); ++i) {
    const double z = (coarse.short_list()[i].T_target_sensor * subset->centroid).z();
    EXPECT_TRUE(std::abs(z) < 1e-6 || std::abs(z + 0.15) < 1e-6) << z;
    second += z < -0.1 ? 1 : 0;
  }
  EXPECT_GT(second, 0);
}

// All returns lie in one cell, whose byte is 1 in the first views' half of the grid and 0 in the last one's: the list is full of sums that
// are smaller than the number of returns, and their shares are fractions.
TEST_F(CoarseTest, ASmallLimitStillLetsABetterOneIn) {
  VERIFIES("LASSO-MOD-111~1");
  SearchTables<FlightNumber>& tables = mission_.search;
  const std::size_t cells = std::size_t{tables.cells[0]} * tables.cells[1] * tables.cells[2];
  std::vector<std::uint8_t> distances(cells + sizeof(std::uint32_t), 1);
  std::fill(distances.begin() + static_cast<std::ptrdiff_t>(cells / 2), distances.end(), std::uint8_t{0});
  std::vector<ModelView<FlightNumber>> views;
  for (std::size_t i = 0; i <= 12; ++i) {
    ModelView<FlightNumber>& view = views.emplace_back(tables.views[i * (tables.views.size() / 13)]);
    view.median = view.near_median = FlightNumber::Length{0};
    for (std::size_t k = 0; k < 3; ++k) {
      const double place = k < 2 ? 0.5 : i < 12 ? 0.25 : 0.75;
      const double x = static_cast<double>(tables.origin_m[k]) + place * tables.cells[k] / static_cast<double>(tables.cells_per_m);
      view.centroid[k] = view.near_centroid[k] = FlightNumber::to_length(x);
    }
  }
  tables.distances = distances.data();
  tables.views = {views.data(), views.size()};
  auto subset = std::make_unique<ScanSubset>();
  subset->centroid = Vec3(0, 0, 3);
  MatchPoint<FlightNumber> point{};
  point.p[2] = FlightNumber::to_length(3);
  while (subset->hits.size() < kCoarsePoints) ASSERT_TRUE(subset->hits.push_back(point));
  ViewMatcher coarse;
  coarse.begin(mission_, *subset);
  while (!coarse.done()) {
    coarse.step(mission_, *subset);
  }
  ASSERT_EQ(coarse.short_list().size(), kShortList);
  EXPECT_LE(coarse.short_list().limit(), kCoarsePoints);
  std::size_t better = 0;
  for (std::size_t i = 0; i < kShortList; ++i) better += coarse.short_list()[i].score == 0 ? 1u : 0u;
  EXPECT_GE(better, kRolls / 2);
}

Hypothesis at(double angle, std::uint32_t score) {
  Hypothesis h;
  h.T_target_sensor.q = exp_so3(angle * Vec3(0.36, -0.48, 0.8));
  h.score = score;
  return h;
}

TEST(ShortList, KeepsTheBetterOfTwoThatAreNear) {
  VERIFIES("LASSO-MOD-111~1");
  ShortList list;
  list.offer(at(0.0, 50));
  list.offer(at(0.2, 60));
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].score, 50u);
  list.offer(at(0.2, 40));
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].score, 40u);
  list.offer(at(0.5, 70));
  EXPECT_EQ(list.size(), 2u);
  EXPECT_GT(list.limit(), 1000u);
  list.clear();
  EXPECT_EQ(list.size(), 0u);
}

TEST(ShortList, LetsTheWorstGoWhenFull) {
  VERIFIES("LASSO-MOD-111~1");
  ShortList list;
  test::Generator random(5);
  std::uint32_t offered = 0;
  while (list.size() < kShortList) {
    Hypothesis h;
    for (int i = 0; i < 4; ++i) h.T_target_sensor.q.coeffs()[i] = random.normal();
    h.T_target_sensor.q = normalized(h.T_target_sensor.q);
    h.score = 100 + offered++;
    list.offer(h);
  }
  std::uint32_t worst = 0;
  for (std::size_t i = 0; i < list.size(); ++i) worst = std::max(worst, list[i].score);
  EXPECT_EQ(list.limit(), worst);
  Hypothesis far;
  double apart = 0;
  while (apart < 0.3) {  // from all
    for (int i = 0; i < 4; ++i) far.T_target_sensor.q.coeffs()[i] = random.normal();
    far.T_target_sensor.q = normalized(far.T_target_sensor.q);
    apart = 10;
    for (std::size_t i = 0; i < list.size(); ++i) apart = std::min(apart, angle_between(far.T_target_sensor.q, list[i].T_target_sensor.q));
  }
  far.score = worst + 1;
  list.offer(far);
  for (std::size_t i = 0; i < list.size(); ++i) EXPECT_LE(list[i].score, worst);
  far.score = 1;
  list.offer(far);
  EXPECT_EQ(list.size(), kShortList);
  for (std::size_t i = 0; i < list.size(); ++i) EXPECT_LT(list[i].score, worst);
}

}  // namespace
}  // namespace lasso
