#include "fsw/pose/recognition/pose_search.hpp"

#include <gtest/gtest.h>

#include "ut/pose/whole_search.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using SearchTest = test::WholeSearch;

constexpr std::uint32_t kEnough = 100'000'000;

TEST_F(SearchTest, FindsTheTargetAtAnyAttitudeAndAcceptsNoWrongPose) {
  VERIFIES("LASSO-MOD-111~1 LASSO-MOD-122~2");
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
  VERIFIES("LASSO-MOD-118~2");
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

// What adding a scan takes, the slice of the same frame has less.
TEST_F(SearchTest, ASlicePaysForTheScanThatIsAdded) {
  VERIFIES("LASSO-MOD-118~2");
  look_from_few_sides();
  search_->begin(limits_);
  const auto image = scan_at(0);
  ASSERT_EQ(search_->add_scan(mission_, *image, *workspace_), Status::kOk);
  const std::uint32_t adding = result().work;
  EXPECT_EQ(adding, prepare_work(image->samples.size()));
  EXPECT_FALSE(search_->advance(mission_, *workspace_, adding));
  EXPECT_EQ(result().work, adding) << "nothing was left of it";
  EXPECT_EQ(search_->stage(), PoseSearch::Stage::kSubset);
  EXPECT_FALSE(search_->advance(mission_, *workspace_, 1));
  EXPECT_GT(result().work, adding);
  search_->begin(limits_);
  EXPECT_EQ(result().work, 0u);
  EXPECT_TRUE(search_->advance(mission_, *workspace_, 1));
  EXPECT_EQ(result().work, 0u);
}

// Of a fit that was given up only what was looked at is counted.
TEST(SearchWork, OfAFitIsThatOfTheRaysThatWereLookedAt) {
  VERIFIES("LASSO-MOD-118~2");
  HypothesisScore fit;
  fit.hits = 100;
  fit.walks = 32;
  EXPECT_EQ(score_work(fit), score_work(32, 0));
  fit.walks = 100;
  EXPECT_EQ(score_work(fit), score_work(100, 0));
  fit.walks = 148;
  EXPECT_EQ(score_work(fit), score_work(100, 48));
  EXPECT_GT(score_work(100, 48), score_work(100, 0));
}

// Whatever the work may be, it is not exceeded by more than what is always done, and no pose is accepted that more work would not accept.
TEST_F(SearchTest, WhatTheWorkDoesNotAllowIsLeftOpen) {
  VERIFIES("LASSO-MOD-117~2 LASSO-MOD-120~2");
  scan_.T_sensor_target = test::random_box_pose(random_);
  const auto image = scan_at(0);
  const SearchResult whole = search_within(kEnough, *image);
  ASSERT_EQ(whole.outcome, SearchOutcome::kAccepted);
  const SearchResult least = search_within(0, *image);
  EXPECT_LT(least.work, whole.work);
  EXPECT_NE(least.outcome, SearchOutcome::kAccepted);
  int unfinished = 0;
  for (std::uint32_t work_max = least.work; work_max < whole.work; work_max += (whole.work - least.work) / 6 + 1) {
    const SearchResult some = search_within(work_max, *image);
    EXPECT_LE(some.work, whole.work);
    EXPECT_NE(some.outcome, SearchOutcome::kNone);
    if (some.reason == SearchReason::kUnfinished) {
      EXPECT_EQ(some.outcome, SearchOutcome::kAmbiguous);
      ++unfinished;
    }
    if (some.outcome != SearchOutcome::kAccepted) continue;
    EXPECT_TRUE(is_right(some.T_sensor_target)) << work_max;
  }
  EXPECT_GT(unfinished, 0);
}

// A first scan leaves a fifth of the work to those that may join it; where less than 15 % are left, none does.
TEST_F(SearchTest, IsJoinedByFurtherScansWhileWorkIsLeft) {
  VERIFIES("LASSO-MOD-117~2 LASSO-MOD-186~3");
  limits_.ratio_min = 1e9;  // never enough
  search_->begin(limits_);
  EXPECT_TRUE(search_->joins());
  ASSERT_EQ(search(0), Status::kOk);
  const std::uint32_t first = result().work;
  EXPECT_TRUE(search_->joins());
  ASSERT_EQ(search_->add_scan(mission_, *scan_at(2), *workspace_), Status::kOk);
  while (search_->busy()) {
    EXPECT_TRUE(search_->stage() == PoseSearch::Stage::kSubset || search_->stage() > PoseSearch::Stage::kAlignOnRays);
    search_->advance(mission_, *workspace_, 1);
  }
  const std::uint32_t second = result().work - first;
  EXPECT_LT(second, first) << "nothing but what is carried is looked for";
  limits_.work_max = first + second / 2;
  search_->begin(limits_);
  int scans = 0;
  for (; search_->joins(); ++scans) ASSERT_EQ(search(2 * scans), Status::kOk);
  EXPECT_EQ(result().outcome, SearchOutcome::kAmbiguous);
  EXPECT_LT(scans, 3);
  EXPECT_GE(result().work, 0.85 * limits_.work_max);
  EXPECT_LT(result().work, limits_.work_max + second);
  EXPECT_EQ(search(10), Status::kBadOrder);
}

// Registrations and robust refinements that are begun are left, too. What is always done goes on: the scan subset, the finalists, the best
// one's symmetric images.
TEST_F(SearchTest, EndsAStepAfterItsWorkIsUsedUp) {
  VERIFIES("LASSO-MOD-117~2");
  scan_.model.half = Vec3(0.09, 0.42, 0.05);  // all poses leave something unexplained
  scan_.T_sensor_target = test::random_box_pose(random_);
  limits_.scans_max = 1;
  const auto image = scan_at(0);
  const std::uint32_t whole = search_within(kEnough, *image).work;
  const std::uint32_t least = search_within(0, *image).work;
  for (std::uint32_t work_max = least; work_max < whole; work_max += (whole - least) / 20 + 1) {
    EXPECT_LE(search_within(work_max, *image).work, work_max + 3 * kLargestStep) << work_max;
  }
}

TEST_F(SearchTest, CarriesAllCandidatesOfAScanThatWasLeftUnfinished) {
  VERIFIES("LASSO-MOD-186~3");
  scan_.T_sensor_target = test::random_box_pose(random_);
  const auto first = scan_at(0), second = scan_at(2);
  const auto sketches_of_second = [&] {
    int steps = 0;
    EXPECT_EQ(search_->add_scan(mission_, *second, *workspace_), Status::kOk);
    for (bool done = false; !done; done = search_->advance(mission_, *workspace_, 1)) {
      steps += search_->stage() == PoseSearch::Stage::kFastRefine ? 1 : 0;
    }
    EXPECT_EQ(result().scans, 2u);
    EXPECT_TRUE(is_right(result().T_sensor_target, 2));
    return steps;
  };
  ASSERT_EQ(search_within(kEnough, *first).outcome, SearchOutcome::kAccepted);
  const std::uint32_t whole = result().work;
  const int of_finished = sketches_of_second();
  bool joined = false;
  for (std::uint32_t percent = 100; percent < 130 && !joined; percent += 2) {
    joined = search_within(whole / 100 * percent, *first).reason == SearchReason::kUnfinished && search_->joins();
  }
  ASSERT_TRUE(joined);
  EXPECT_GT(sketches_of_second(), of_finished);
}

TEST_F(SearchTest, OfASingleScanHasAllTheWork) {
  VERIFIES("LASSO-MOD-117~2 LASSO-MOD-186~3");
  scan_.T_sensor_target = test::random_box_pose(random_);
  const test::Generator random = random_;
  search_->begin(limits_);
  ASSERT_EQ(search(), Status::kOk);
  ASSERT_EQ(result().outcome, SearchOutcome::kAccepted);
  limits_.work_max = result().work;
  for (const std::uint32_t scans_max : {1u, 2u}) {
    random_ = random;
    limits_.scans_max = scans_max;
    search_->begin(limits_);
    ASSERT_EQ(search(), Status::kOk);
    EXPECT_EQ(result().outcome == SearchOutcome::kAccepted, scans_max == 1) << scans_max;
  }
}

TEST_F(SearchTest, IsNotJoinedWhereItIsRejected) {
  VERIFIES("LASSO-MOD-186~3");
  look_from_few_sides();
  limits_.hits_min = 1e6;
  search_->begin(limits_);
  ASSERT_EQ(search(0), Status::kOk);
  ASSERT_EQ(result().outcome, SearchOutcome::kRejected);
  EXPECT_FALSE(search_->joins());
  EXPECT_EQ(search(2), Status::kBadOrder);
  EXPECT_EQ(result().scans, 1u) << "as it was";
  search_->begin(limits_);
  EXPECT_EQ(search(2), Status::kOk);
}

// Its only view is that of another side.
TEST_F(SearchTest, LooksAtTheQuarterTurnsOfAPoseThatItSuspects) {
  VERIFIES("LASSO-MOD-187~1");
  look_from_few_sides();
  std::unique_ptr<RangeImage> image;
  const auto finds = [&](const Pose* suspect) {
    search_->begin(limits_);
    if (suspect != nullptr) search_->suspect(*suspect);
    EXPECT_EQ(search_->add_scan(mission_, *image, *workspace_), Status::kOk);
    work();
    return is_right(result().T_sensor_target);
  };
  for (bool found = true; found;) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    image = scan_at(0);
    found = finds(nullptr);
  }
  for (const std::size_t turn : {0u, 7u, 18u}) {
    const Pose suspect = inverse(quarter_turned(inverse(scan_.T_sensor_target), turn, mission_.center_m));
    EXPECT_TRUE(finds(&suspect)) << turn;
  }
  EXPECT_FALSE(finds(nullptr)) << "forgotten";
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
  EXPECT_TRUE(search_->advance(mission_, *workspace_, test::kSlice));
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
  VERIFIES("LASSO-MOD-116~1 LASSO-MOD-120~2");
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

}  // namespace
}  // namespace lasso
