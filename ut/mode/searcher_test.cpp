#include "fsw/mode/searcher.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "ut/support/box_scan.hpp"
#include "ut/support/box_scene.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

constexpr DurationUs kCycleUs = 200000;

test::TestImage make_image(const test::BoxScene& scene) {
  MissionParameters p = test::box_parameters(scene);
  p.search_slice = 1e7;  // a whole search in one frame
  p.search_frames = 20;
  return test::make_image(p, test::make_box_tables(scene.boxes()));
}

const test::TestImage& uneven_image() {
  static const test::TestImage image = make_image(test::uneven_scene());
  return image;
}

const test::TestImage& box_image() {
  static const test::TestImage image = make_image(test::default_scene());
  return image;
}

Vec3 side_of(const ModelView<FlightNumber>& view) {
  Vec3 direction;
  for (int i = 0; i < 3; ++i) direction[i] = FlightNumber::to_double(view.direction[i]);
  return direction;
}

class SearcherTest : public ::testing::Test {
 protected:
  explicit SearcherTest(const test::BoxScene& scene = test::uneven_scene(), const test::TestImage& image = uneven_image())
      : scene_(scene), image_(image) {
    EXPECT_EQ(load_image(Bytes(image_.data(), image_.size), mission_).status, Status::kOk);
    change_mode(ModeEvent::kSeek, state_);
    change_mode(ModeEvent::kSearch, state_);
    state_.bearing.started = true;
    state_.bearing.t_us = 1000000;
    state_.bearing.p_m = scene_.at_zero.p;
    state_.bearing.scans = 3;
  }

  MissionParameters& parameters() { return mission_.parameters; }
  // Little work that finds the target all the same: the views next to the true one.
  void look_from_the_right_side() {
    const Span<const ModelView<FlightNumber>> all = mission_.search.views;
    const Vec3 to_sensor = inverse(scene_.at_zero).p.normalized();
    std::size_t best = 0;
    for (std::size_t i = 1; i < all.size(); ++i) {
      if (side_of(all[i]).dot(to_sensor) > side_of(all[best]).dot(to_sensor)) best = i;
    }
    mission_.search.views = all.subspan(best, 1);
  }
  // Little work, where the pose that is found does not matter.
  void look_from_few_sides() {
    mission_.search.views = mission_.search.views.first(1);
    mission_.search.symmetries = mission_.search.symmetries.first(1);
  }

  std::unique_ptr<RangeImage> scan(std::uint32_t k) {
    test::BoxScan view{scene_.box, scene_.others, scene_.pose_at(k * kCycleUs), scene_.rates, 1e-3};
    view.half_angle = 0.26;
    auto image = test::scan_box(view, random_);
    image->scan_id = k;
    for (RangeSample& sample : image->samples) sample.t_us += k * kCycleUs;
    return image;
  }

  // A frame as the estimation task has it; its state is not taken.
  TrackStep frame(std::uint32_t k, bool lost = false) {
    const auto image = scan(k);
    TrackStep step;
    step.after = state_;
    step.registration.t_us = image->reference_time_us();
    step.registration.reason = lost ? PoseReason::kNoScan : PoseReason::kOnlyBearing;
    searcher_->work(mission_, lost ? nullptr : image.get(), *workspace_, step);
    return step;
  }
  TrackStep follow(std::uint32_t k, bool lost = false) {
    const TrackStep step = frame(k, lost);
    state_ = step.after;
    return step;
  }
  // The frames that it took.
  std::uint32_t search_to_the_end(std::uint32_t slice) {
    parameters().search_slice = slice;
    state_.held = true;
    std::uint32_t k = 0;
    for (; state_.mode == TrackingMode::kSearching && k < 100; ++k) {
      const std::uint32_t before = found_.work;
      found_ = follow(k).search;
      EXPECT_LE(found_.work - before, slice + kLargestStep);
    }
    return k;
  }
  Vec6 error(const FilterState& filter, std::uint32_t k) const {
    return pose_difference(filter.T_sensor_target, scene_.pose_at(k * kCycleUs));
  }

  test::BoxScene scene_;
  test::TestImage image_;
  Mission mission_;
  test::Generator random_{3};
  TrackState state_;
  SearchResult found_;
  std::unique_ptr<Workspace> workspace_ = std::make_unique<Workspace>();
  std::unique_ptr<Searcher> searcher_ = std::make_unique<Searcher>();
};

TEST_F(SearcherTest, OffersWhatTheSearchAcceptsAsAStart) {
  VERIFIES("LASSO-MOD-123~4 LASSO-MOD-111~1 LASSO-MOD-131~1");
  const TrackStep step = follow(0);
  ASSERT_EQ(step.search.outcome, SearchOutcome::kAccepted);
  EXPECT_EQ(step.event, ModeEvent::kPoseValid);
  EXPECT_EQ(step.refusal, StartRefusal::kNone);
  EXPECT_EQ(step.registration.reason, PoseReason::kSearching) << "no scan has confirmed it";
  EXPECT_EQ(state_.mode, TrackingMode::kStarting);
  EXPECT_EQ(state_.source, InitialPoseSource::kSearch);
  EXPECT_EQ(state_.missed, 0);
  EXPECT_EQ(state_.filter.t_us, step.registration.t_us);
  EXPECT_LT(error(state_.filter, 0).head<3>().norm(), 2 * kRadPerDeg);
  EXPECT_LT(error(state_.filter, 0).tail<3>().norm(), 0.02);
}

TEST_F(SearcherTest, WorksASliceAFrameAndSeesTheRateByAnotherScan) {
  VERIFIES("LASSO-MOD-123~4 LASSO-MOD-118~2 LASSO-MOD-116~1");
  look_from_the_right_side();
  const std::uint32_t frames = search_to_the_end(20000);
  EXPECT_GT(frames, 22u);
  EXPECT_EQ(found_.scans, 2u);
  EXPECT_EQ(found_.t_us, scan(10)->reference_time_us()) << "2 s after the first, however long the work takes";
  ASSERT_EQ(state_.mode, TrackingMode::kStarting);
  EXPECT_GT(to_seconds(state_.filter.t_us - found_.t_us), 1);
  EXPECT_LT(error(state_.filter, frames - 1).head<3>().norm(), 2 * kRadPerDeg) << "moved to now";
  EXPECT_LT((state_.filter.rates.omega_radps - scene_.rates.omega_radps).norm(), 0.3 * kRadPerDeg);
}

TEST_F(SearcherTest, NeedsNoOtherScanWhereTheTargetCannotHaveTurnedFar) {
  VERIFIES("LASSO-MOD-116~1");
  look_from_the_right_side();
  parameters().initial_angular_rate_radps = 0.1 * kRadPerDeg;
  search_to_the_end(1000000);
  EXPECT_EQ(found_.scans, 1u);
  EXPECT_EQ(state_.mode, TrackingMode::kStarting);
}

TEST_F(SearcherTest, MakesDoWithASingleScanWhereNoOtherIsAllowed) {
  VERIFIES("LASSO-MOD-116~1");
  look_from_the_right_side();
  SearchLimits limits;
  limits.scans_max = 1;
  searcher_ = std::make_unique<Searcher>(limits);
  search_to_the_end(1000000);
  EXPECT_EQ(found_.scans, 1u);
  EXPECT_EQ(state_.mode, TrackingMode::kStarting);
  EXPECT_GT(square_root(state_.filter.covariance(0, 0)), to_seconds(state_.filter.t_us - found_.t_us) * scene_.rates.omega_radps.norm());
}

TEST_F(SearcherTest, AStartThatIsRefusedSaysWhyAndTheSearchBeginsAnew) {
  VERIFIES("LASSO-MOD-134~3");
  look_from_the_right_side();
  state_.bearing.p_m.z() += 6;
  for (std::uint32_t k = 0; k < 2; ++k) {
    const TrackStep step = follow(k);
    EXPECT_EQ(step.search.outcome, SearchOutcome::kAccepted);
    EXPECT_EQ(step.search.scans, 1u);
    EXPECT_EQ(step.refusal, StartRefusal::kNotAtBearing);
    EXPECT_EQ(state_.mode, TrackingMode::kSearching);
    EXPECT_FALSE(state_.filter.initialised);
  }
}

// The frame that found the pose came too late and was dropped: nothing is lost but time.
TEST_F(SearcherTest, OffersAgainWhatNobodyHasTaken) {
  VERIFIES("LASSO-EXE-003~1");
  look_from_the_right_side();
  const TrackStep dropped = frame(0);
  ASSERT_EQ(dropped.after.mode, TrackingMode::kStarting);
  const TrackStep step = follow(1);
  EXPECT_EQ(step.after.mode, TrackingMode::kStarting);
  EXPECT_EQ(step.search.work, dropped.search.work) << "without another search";
}

// A pose of a single scan has no rate: 5 deg of turn since then are too many.
TEST_F(SearcherTest, WhatNobodyHasTakenIsOfferedAsLongAsTheTargetCannotHaveTurnedFar) {
  VERIFIES("LASSO-MOD-116~1");
  look_from_the_right_side();
  ASSERT_EQ(frame(0).after.mode, TrackingMode::kStarting);
  parameters().search_slice = 100;
  const double age_s = to_seconds(10 * kCycleUs);
  parameters().initial_angular_rate_radps = 4.9 * kRadPerDeg / age_s;
  EXPECT_EQ(frame(10).after.mode, TrackingMode::kStarting);
  parameters().initial_angular_rate_radps = 5.1 * kRadPerDeg / age_s;
  EXPECT_EQ(frame(10).after.mode, TrackingMode::kSearching);
}

TEST_F(SearcherTest, WaitsForAScanThatABearingAimed) {
  VERIFIES("LASSO-MOD-123~4 LASSO-MOD-111~1");
  look_from_few_sides();
  state_.bearing.scans = 2;
  EXPECT_EQ(follow(0).search.work, 0u);
  state_.bearing.scans = 3;
  EXPECT_EQ(follow(1, true).search.work, 0u) << "lost";
  EXPECT_EQ(follow(2).search.scans, 1u);
}

TEST_F(SearcherTest, ALostScanIsToldAndTheWorkGoesOn) {
  VERIFIES("LASSO-MOD-118~2");
  parameters().search_slice = 1000;
  follow(0);
  const TrackStep step = follow(1, true);
  EXPECT_EQ(step.registration.reason, PoseReason::kNoScan);
  EXPECT_GT(step.search.work, 1000u);
  EXPECT_EQ(state_.missed, 2);
}

TEST_F(SearcherTest, ANewSearchForgetsTheOneBefore) {
  VERIFIES("LASSO-MOD-111~1");
  parameters().search_slice = 1000;
  look_from_few_sides();
  follow(0);
  follow(1);
  ++state_.searches;
  EXPECT_LT(follow(2).search.work, 1000 + kLargestStep);
}

TEST_F(SearcherTest, AScanAfterARejectionBeginsAnotherSearch) {
  VERIFIES("LASSO-MOD-186~3");
  look_from_the_right_side();
  SearchLimits limits;
  limits.hits_min = 1e5;
  searcher_ = std::make_unique<Searcher>(limits);
  for (std::uint32_t k = 0; k < 3; ++k) {
    const TrackStep step = follow(k);
    EXPECT_EQ(step.search.outcome, SearchOutcome::kRejected);
    EXPECT_EQ(step.search.scans, 1u) << k;
    EXPECT_EQ(state_.mode, TrackingMode::kSearching);
  }
}

class SymmetricSearcherTest : public SearcherTest {
 protected:
  SymmetricSearcherTest() : SearcherTest(test::default_scene(), box_image()) { look_from_few_sides(); }
};

TEST_F(SymmetricSearcherTest, AnAmbiguousTargetTakesFurtherScansAndThenASearchAnew) {
  VERIFIES("LASSO-MOD-120~2");
  SearchLimits limits;
  limits.scans_max = 2;
  limits.ratio_min = 100;
  limits.disagreement_max = 1;
  limits.hits_min = 12;
  searcher_ = std::make_unique<Searcher>(limits);
  for (std::uint32_t k = 0; k < 4; ++k) {
    const TrackStep step = follow(k);
    EXPECT_EQ(step.search.outcome, SearchOutcome::kAmbiguous) << to_string(step.search.reason);
    EXPECT_GE(step.search.candidates.size(), 2u);
    EXPECT_EQ(step.search.scans, 1 + k % 2);
    EXPECT_EQ(step.event, ModeEvent::kPoseInvalid);
    EXPECT_EQ(state_.mode, TrackingMode::kSearching);
  }
}

TEST_F(SymmetricSearcherTest, IsGivenUpAfterItsFrames) {
  VERIFIES("LASSO-MOD-138~1 LASSO-MOD-142~2 LASSO-MOD-171~3");
  parameters().search_frames = 2;
  SearchLimits limits;
  limits.ratio_min = 100;
  searcher_ = std::make_unique<Searcher>(limits);
  const TrackState begun = state_;
  for (const bool recover : {true, false}) {
    state_ = begun;
    parameters().recover = recover ? 1 : 0;
    EXPECT_EQ(follow(0).after.mode, TrackingMode::kSearching);
    EXPECT_EQ(follow(1).after.mode, TrackingMode::kSearching);
    const TrackStep last = follow(2);
    EXPECT_EQ(last.event, recover ? ModeEvent::kRecover : ModeEvent::kExhausted);
    EXPECT_EQ(last.after.mode, recover ? TrackingMode::kBearing : TrackingMode::kLost);
  }
}

}  // namespace
}  // namespace lasso
