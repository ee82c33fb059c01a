// The near-symmetries of a search's best pose: competitors that nothing else may have found.
#include <gtest/gtest.h>

#include "fsw/pose/recognition/acceptance.hpp"
#include "ut/pose/whole_search.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

// A single box: each half turn about its axes is a symmetry.
class TwinsTest : public test::WholeSearch {
 protected:
  TwinsTest() : WholeSearch(test::box_mission()) {
    scan_.others.clear();
    limits_.hits_min = 20;  // one box returns few rays
    // The target as the view shows it that has most of all three sides, and no other view.
    std::size_t most = 0;
    for (std::size_t i = 1; i < mission_.search.views.size(); ++i) {
      if (least_share(i) > least_share(most)) most = i;
    }
    // The shortest turn from the view's direction to the sensor: half of the quaternion of their product.
    const Vec3 view = to_vec3(mission_.search.views[most].direction), sensor = -Vec3::UnitZ();
    const Vec3 axis = view.cross(sensor);
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan_.T_sensor_target.q = normalized(Quat(1 + view.dot(sensor), axis.x(), axis.y(), axis.z()));
    mission_.search.views = {&mission_.search.views[most], 1};
  }
  double least_share(std::size_t view) const { return to_vec3(mission_.search.views[view].direction).cwiseAbs().minCoeff(); }
  int steps_of_second_scan(Span<const NearSymmetry<FlightNumber>> symmetries) {
    mission_.search.symmetries = {};
    search_->begin(limits_);
    EXPECT_EQ(search(0), Status::kOk);
    mission_.search.symmetries = symmetries;
    EXPECT_EQ(search_->add_scan(mission_, *scan_at(2), *workspace_), Status::kOk);
    int steps = 1;
    while (!search_->advance(mission_, *workspace_, 1)) ++steps;
    return steps;
  }
  // Half turns of the box, and none, at which a candidate stands.
  int turns_found() const {
    const Quat turns[] = {Quat(1, 0, 0, 0), Quat(0, 1, 0, 0), Quat(0, 0, 1, 0), Quat(0, 0, 0, 1)};
    int found = 0;
    for (const Quat& turn : turns) {
      bool one = false;
      for (const SearchCandidate& candidate : result().candidates) {
        one = one || !are_apart(candidate.T_sensor_target.q, scan_.T_sensor_target.q * turn, kCosHalfSame);
      }
      found += one ? 1 : 0;
    }
    return found;
  }
};

// Twins are settled in the first scan alone; in the second they are found where the best pose has come to.
TEST_F(TwinsTest, OfTheBestPoseAsItStandsAreFoundInTheSecondScan) {
  VERIFIES("LASSO-MOD-121~1 LASSO-MOD-120~2");
  const auto symmetries = mission_.search.symmetries;
  ASSERT_GE(symmetries.size(), 3u);
  mission_.search.symmetries = symmetries.first(0);
  search_->begin(limits_);
  ASSERT_EQ(search(0), Status::kOk);
  EXPECT_LT(turns_found(), 4);
  mission_.search.symmetries = symmetries;
  ASSERT_EQ(search(2), Status::kOk);
  EXPECT_EQ(result().outcome, SearchOutcome::kAmbiguous);
  EXPECT_EQ(result().reason, SearchReason::kCompetitor);
  EXPECT_EQ(turns_found(), 4);
}

TEST_F(TwinsTest, AreFoundInTheFirstScan) {
  VERIFIES("LASSO-MOD-121~1 LASSO-SYS-024~1");
  search_->begin(limits_);
  ASSERT_EQ(search(), Status::kOk);
  EXPECT_EQ(result().outcome, SearchOutcome::kAmbiguous);
  EXPECT_EQ(turns_found(), 4);
}

// A turn that is none of the target's symmetries leads nowhere: it is measured, and that is all.
TEST_F(TwinsTest, ThatFitBadlyAreNoRivals) {
  VERIFIES("LASSO-MOD-122~2");
  NearSymmetry<FlightNumber> none{};
  for (int i = 0; i < 4; ++i) none.q[i] = FlightNumber::to<FlightNumber::Unit>(i == 3 ? 0.8 : i == 0 ? 0.6 : 0.0);
  const test::Generator random = random_;
  const int without = steps_of_second_scan({});
  const SearchResult before = result();
  random_ = random;
  EXPECT_EQ(steps_of_second_scan({&none, 1}), without + 1);
  EXPECT_EQ(result().reason, before.reason);
  EXPECT_EQ(result().ratio, before.ratio);
  EXPECT_EQ(result().T_sensor_target.p, before.T_sensor_target.p);
}

}  // namespace
}  // namespace lasso
