#include "fsw/exec/estimation_task.hpp"

#include <memory>

#include "ut/support/box_scene.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

class EstimationTaskTest : public ::testing::Test {
 protected:
  void SetUp() override {
    image_ = test::make_box_image(test::box_parameters(scene_), scene_.box);
    ASSERT_EQ(load_image(Bytes(image_.data(), image_.size), mission_).status, Status::kOk);
    const StartOffer offer = rough_offer(mission_.parameters, scene_.at_zero, scene_.rates, 0);
    ASSERT_EQ(start_track(mission_, InitialPoseSource::kUplink, offer, 0, job_.before), StartRefusal::kNone);
    job_.scan_id = 7;
    job_.t_nominal_us = 90000;
    job_.mission = &mission_;
    job_.parts = &parts_;
  }

  test::BoxScene scene_ = test::default_scene();
  test::TestImage image_;
  Mission mission_;
  Parts parts_;
  EstimationJob job_;
  TrackStep step_;
  std::unique_ptr<EstimationTask> task_ = std::make_unique<EstimationTask>();
};

TEST_F(EstimationTaskTest, GivesTheResultOfAJobThatIsDone) {
  VERIFIES("LASSO-EXE-012~2");
  EXPECT_TRUE(task_->idle());
  EXPECT_FALSE(task_->collect(step_));
  task_->submit(job_);
  EXPECT_TRUE(task_->pending());
  task_->run();
  EXPECT_FALSE(task_->pending());
  EXPECT_FALSE(task_->idle());
  ASSERT_TRUE(task_->collect(step_));
  EXPECT_TRUE(task_->idle());
  EXPECT_EQ(step_.registration.scan_id, 7u);
  EXPECT_EQ(step_.registration.reason, PoseReason::kNoScan);
  EXPECT_EQ(step_.registration.t_us, 90000);
  EXPECT_LT(pose_difference(step_.after.filter.T_sensor_target, scene_.pose_at(90000)).norm(), 1e-12);
}

TEST_F(EstimationTaskTest, RunsAJobOnce) {
  VERIFIES("LASSO-EXE-012~2");
  task_->submit(job_);
  task_->run();
  task_->run();
  EXPECT_TRUE(task_->collect(step_));
  EXPECT_FALSE(task_->collect(step_));
  task_->run();
  EXPECT_TRUE(task_->idle());
}

TEST_F(EstimationTaskTest, DropsALateResultWhole) {
  VERIFIES("LASSO-EXE-003~1");
  task_->submit(job_);
  EXPECT_FALSE(task_->collect(step_));  // the boundary comes first
  EXPECT_FALSE(task_->idle());
  task_->run();
  EXPECT_FALSE(task_->collect(step_));  // done, but too late
  EXPECT_TRUE(task_->idle());
  EXPECT_EQ(step_.registration.scan_id, 0u);
  job_.scan_id = 8;
  task_->submit(job_);
  task_->run();
  ASSERT_TRUE(task_->collect(step_));
  EXPECT_EQ(step_.registration.scan_id, 8u);
}

TEST_F(EstimationTaskTest, SearchesInTheModeSearching) {
  VERIFIES("LASSO-MOD-111~1");
  change_mode(ModeEvent::kSearch, job_.before);
  task_->submit(job_);
  task_->run();
  ASSERT_TRUE(task_->collect(step_));
  EXPECT_EQ(step_.after.mode, TrackingMode::kSearching);
  EXPECT_EQ(step_.registration.reason, PoseReason::kNoScan);
  EXPECT_EQ(step_.event, ModeEvent::kPoseInvalid);
  EXPECT_EQ(step_.after.missed, 1);
}

TEST_F(EstimationTaskTest, AScanOfAPartConfirmsNoStart) {
  VERIFIES("LASSO-MOD-164~2");
  const auto scan = std::make_unique<RangeImage>();
  job_.scan = scan.get();
  job_.part = 1;
  task_->submit(job_);
  task_->run();
  ASSERT_TRUE(task_->collect(step_));
  EXPECT_EQ(step_.registration.reason, PoseReason::kNoScan);
  EXPECT_EQ(step_.parts.scanned, 1);
  EXPECT_EQ(step_.after.mode, TrackingMode::kStarting);
}

TEST_F(EstimationTaskTest, TwoJobsAtOnceAreABug) {
  VERIFIES("LASSO-EXE-012~2");
  task_->submit(job_);
  EXPECT_DEATH(task_->submit(job_), "busy");
}

}  // namespace
}  // namespace lasso
