#include "fsw/pose/search.hpp"

#include <gtest/gtest.h>

#include "ut/pose/search_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

constexpr std::uint32_t kSlice = 200'000;

class SearchTest : public test::SearchFixture {
 protected:
  using test::SearchFixture::SearchFixture;

  // A scan at `t_s` of the target as its motion has brought it.
  std::unique_ptr<RangeImage> scan_at(double t_s) {
    test::BoxScan at = scan_;
    at.T_sensor_target = propagate(scan_.T_sensor_target, scan_.rates, t_s);
    auto image = test::scan_box(at, random_);
    for (RangeSample& sample : image->samples) sample.t_us += static_cast<TimeUs>(1e6 * t_s);
    return image;
  }
  void work() {
    while (!search_->advance(mission_, *workspace_, kSlice)) {
    }
  }
  Status search(double t_s = 0) {
    const Status status = search_->add_scan(mission_, *scan_at(t_s), *workspace_);
    work();
    return status;
  }
  bool is_right(const Pose& pose, double t_s = 0) const {
    const Vec6 error = pose_difference(pose, propagate(scan_.T_sensor_target, scan_.rates, t_s));
    return error.head<3>().norm() < 2 * kRadPerDeg && error.tail<3>().norm() < 0.02;
  }
  const SearchResult& result() const { return search_->result(); }
  // Little work, where the pose that is found does not matter.
  void look_from_few_sides() {
    mission_.search.views = mission_.search.views.first(1);
    mission_.search.symmetries = mission_.search.symmetries.first(1);
  }

  SearchLimits limits_;
  std::unique_ptr<Search> search_ = std::make_unique<Search>();
};

TEST_F(SearchTest, FindsTheTargetAtAnyAttitudeAndAcceptsNoWrongPose) {
  VERIFIES("LASSO-MOD-111~1 LASSO-MOD-122~1");
  int right = 0;
  for (int i = 0; i < 4; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    search_->begin(limits_);
    ASSERT_EQ(search(), Status::kOk);
    EXPECT_EQ(result().scans, 1u);
    if (result().outcome != SearchOutcome::kAccepted) continue;
    EXPECT_EQ(result().reason, SearchReason::kDistinct);
    EXPECT_TRUE(is_right(result().T_sensor_target)) << i;
    EXPECT_GE(result().ratio, limits_.ratio_min);
    EXPECT_GT(result().covariance(0, 0), 0);
    EXPECT_LT(result().covariance(5, 5), 2e-3);
    EXPECT_TRUE(result().rates.omega_radps.isZero());
    ++right;
  }
  EXPECT_GE(right, 3);
}

TEST_F(SearchTest, TheSizeOfTheSlicesChangesNothing) {
  VERIFIES("LASSO-MOD-118~1");
  look_from_few_sides();
  const auto image = scan_at(0);
  search_->begin(limits_);
  ASSERT_EQ(search_->add_scan(mission_, *image, *workspace_), Status::kOk);
  work();
  const SearchResult whole = result();
  search_->begin(limits_);
  ASSERT_EQ(search_->add_scan(mission_, *image, *workspace_), Status::kOk);
  std::uint32_t before = 0;
  bool done = false;
  while (!done) {
    EXPECT_TRUE(search_->busy());
    *workspace_ = Workspace();  // others use it between two calls
    done = search_->advance(mission_, *workspace_, 1);
    EXPECT_LE(result().work - before, kLargestStep);
    before = result().work;
  }
  EXPECT_FALSE(search_->busy());
  EXPECT_EQ(result().work, whole.work);
  EXPECT_EQ(result().T_sensor_target.p, whole.T_sensor_target.p);
  EXPECT_EQ(result().T_sensor_target.q.coeffs(), whole.T_sensor_target.q.coeffs());
  EXPECT_EQ(result().ratio, whole.ratio);
}

TEST_F(SearchTest, RejectsAnotherTarget) {
  VERIFIES("LASSO-MOD-122~1");
  scan_.model.half = Vec3(0.09, 0.42, 0.05);
  scan_.others.clear();
  for (int i = 0; i < 2; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    search_->begin(limits_);
    ASSERT_EQ(search(), Status::kOk);
    EXPECT_NE(result().outcome, SearchOutcome::kAccepted);
    EXPECT_GT(result().disagreement, limits_.disagreement_max);
  }
}

TEST_F(SearchTest, RejectsAPoseThatLeavesTooMuchUnexplained) {
  VERIFIES("LASSO-MOD-122~1");
  look_from_few_sides();
  limits_.disagreement_max = -1;
  search_->begin(limits_);
  ASSERT_EQ(search(), Status::kOk);
  EXPECT_EQ(result().outcome, SearchOutcome::kRejected);
  EXPECT_EQ(result().reason, SearchReason::kUnexplained);
}

TEST_F(SearchTest, RejectsTooFewReturns) {
  VERIFIES("LASSO-MOD-122~1");
  look_from_few_sides();
  limits_.hits_min = 1000;
  search_->begin(limits_);
  ASSERT_EQ(search(), Status::kOk);
  EXPECT_EQ(result().outcome, SearchOutcome::kRejected);
  EXPECT_EQ(result().reason, SearchReason::kTooFewReturns);
}

TEST_F(SearchTest, RejectsWhatCannotBeRegistered) {
  VERIFIES("LASSO-MOD-122~1");
  look_from_few_sides();
  auto image = scan_at(0);
  int hits = 0;
  for (RangeSample& sample : image->samples) {
    if (sample.state == RayState::kHit && ++hits > 9) sample.state = RayState::kInvalid;
  }
  search_->begin(limits_);
  ASSERT_EQ(search_->add_scan(mission_, *image, *workspace_), Status::kOk);
  work();
  EXPECT_EQ(result().outcome, SearchOutcome::kRejected);
  EXPECT_EQ(result().reason, SearchReason::kNotRegistered);
}

TEST_F(SearchTest, RefusesScansOutOfOrder) {
  VERIFIES("LASSO-MOD-111~1");
  look_from_few_sides();
  limits_.disagreement_max = 1;
  limits_.ratio_min = 1e9;
  limits_.scans_max = 2;
  search_->begin(limits_);
  auto empty = std::make_unique<RangeImage>();
  EXPECT_EQ(search_->add_scan(mission_, *empty, *workspace_), Status::kNoData);
  EXPECT_TRUE(search_->advance(mission_, *workspace_, kSlice));
  EXPECT_EQ(result().outcome, SearchOutcome::kNone);
  const auto image = scan_at(0);
  EXPECT_EQ(search_->add_scan(mission_, *image, *workspace_), Status::kOk);
  EXPECT_EQ(search_->add_scan(mission_, *image, *workspace_), Status::kBusy);
  work();
  EXPECT_EQ(search_->add_scan(mission_, *image, *workspace_), Status::kBadOrder);  // the same again
  EXPECT_EQ(search(1), Status::kOk);
  EXPECT_EQ(search(2), Status::kBadOrder);  // one more than allowed
}

TEST_F(SearchTest, CarriesItsCandidatesFromScanToScan) {
  VERIFIES("LASSO-MOD-116~1 LASSO-MOD-120~1");
  limits_.ratio_min = 1e9;  // never enough: all scans are used
  limits_.scans_max = 9;
  scan_.rates.omega_radps = 3 * kRadPerDeg * Vec3(0.6, -0.48, 0.64);
  scan_.rates.v_mps = Vec3(0.01, -0.02, 0.015);
  search_->begin(limits_);
  for (int k = 0; k < 3; ++k) {
    ASSERT_EQ(search(2 * k), Status::kOk);
    EXPECT_EQ(result().outcome, SearchOutcome::kAmbiguous);
    EXPECT_EQ(result().reason, SearchReason::kCompetitor);
    EXPECT_EQ(result().scans, static_cast<std::uint32_t>(k + 1));
    EXPECT_EQ(result().t_us, 1090000 + 2000000 * k);
    EXPECT_TRUE(is_right(result().T_sensor_target, 2 * k)) << k;
    EXPECT_GT(result().candidates.size(), 1u);
    EXPECT_TRUE(is_right(result().candidates[0].T_sensor_target, 2 * k));
    if (k == 0) continue;
    EXPECT_LT((result().rates.omega_radps - scan_.rates.omega_radps).norm(), 0.3 * kRadPerDeg);
    EXPECT_LT((result().rates.v_mps - scan_.rates.v_mps).norm(), 0.005);
  }
  EXPECT_EQ(search(6), Status::kBadOrder);  // as many as it has room for
}

class SymmetricTest : public SearchTest {
 protected:
  SymmetricTest() : SearchTest(test::box_mission()) { scan_.others.clear(); }
};

TEST_F(SymmetricTest, ASymmetricTargetIsAmbiguousWithItsCandidates) {
  VERIFIES("LASSO-MOD-121~1 LASSO-MOD-120~1");
  for (int i = 0; i < 2; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    search_->begin(limits_);
    for (int k = 0; k < 2; ++k) {
      ASSERT_EQ(search(k), Status::kOk);
      EXPECT_EQ(result().outcome, SearchOutcome::kAmbiguous);
      EXPECT_LT(result().ratio, 1.3);
      ASSERT_GE(result().candidates.size(), 2u);
    }
    bool found = false;
    for (const SearchCandidate& candidate : result().candidates) {
      const Vec6 error = pose_difference(candidate.T_sensor_target, scan_.T_sensor_target);
      found = found || (error.head<3>().norm() < 2 * kRadPerDeg && error.tail<3>().norm() < 0.02);
    }
    EXPECT_TRUE(found);
  }
}

TEST_F(SymmetricTest, FewDistinctHypothesesAreEnough) {
  VERIFIES("LASSO-MOD-111~1");
  mission_.search.views = mission_.search.views.first(1);
  mission_.search.symmetries = mission_.search.symmetries.first(0);
  search_->begin(limits_);
  ASSERT_EQ(search(), Status::kOk);
  EXPECT_NE(result().outcome, SearchOutcome::kNone);
}

// Only memory that was hit can hold such a view: it has no axes, all its rolls are one hypothesis, and that is no pose.
TEST_F(SearchTest, AViewWithoutADirectionLeadsToNoPose) {
  VERIFIES("LASSO-MOD-111~1");
  const ModelView<FlightNumber> none{};
  mission_.search.views = {&none, 1};
  mission_.search.symmetries = mission_.search.symmetries.first(0);
  search_->begin(limits_);
  ASSERT_EQ(search(), Status::kOk);
  EXPECT_EQ(result().outcome, SearchOutcome::kRejected);
}

TEST(SearchText, NamesOutcomesAndReasons) {
  VERIFIES("LASSO-MOD-122~1");
  EXPECT_STREQ(to_string(SearchOutcome::kNone), "none");
  EXPECT_STREQ(to_string(SearchOutcome::kAccepted), "accepted");
  EXPECT_STREQ(to_string(SearchOutcome::kAmbiguous), "ambiguous");
  EXPECT_STREQ(to_string(SearchOutcome::kRejected), "rejected");
  EXPECT_STREQ(to_string(static_cast<SearchOutcome>(99)), "unknown");
  EXPECT_STREQ(to_string(SearchReason::kNotDone), "not_done");
  EXPECT_STREQ(to_string(SearchReason::kDistinct), "distinct");
  EXPECT_STREQ(to_string(SearchReason::kCompetitor), "competitor");
  EXPECT_STREQ(to_string(SearchReason::kTooFewReturns), "too_few_returns");
  EXPECT_STREQ(to_string(SearchReason::kUnexplained), "unexplained");
  EXPECT_STREQ(to_string(SearchReason::kNotRegistered), "not_registered");
  EXPECT_STREQ(to_string(static_cast<SearchReason>(99)), "unknown");
}

}  // namespace
}  // namespace lasso
