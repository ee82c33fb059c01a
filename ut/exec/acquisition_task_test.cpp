#include "fsw/exec/acquisition_task.hpp"

#include <cmath>
#include <memory>

#include "fsw/sense/pixel_selector.hpp"
#include "ut/support/box_scene.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

class AcquisitionTaskTest : public ::testing::Test {
 protected:
  void SetUp() override {
    MissionParameters p = test::box_parameters(scene_);
    p.points = 4096;
    image_ = test::make_box_image(p, scene_.box);
    ASSERT_EQ(load_image(Bytes(image_.data(), image_.size), mission_).status, Status::kOk);
  }
  void start(std::uint32_t scan_id, TimeUs t_us) {
    task_->start(0, mission_, {scene_.pose_at(t_us), 0, false, false, {}}, scan_id, t_us, plan_);
  }

  test::BoxScene scene_ = test::default_scene();
  test::TestImage image_;
  Mission mission_;
  ScanPlan plan_;
  test::BoxSensor sensor_{scene_};
  std::unique_ptr<AcquisitionTask> task_ = std::make_unique<AcquisitionTask>(only(sensor_));
};

TEST_F(AcquisitionTaskTest, TakesTheLargestScanInOnePoll) {
  VERIFIES("LASSO-EXE-005~2 LASSO-SNS-032~1");
  start(3, 1000);
  EXPECT_EQ(plan_.scan_id, 3u);
  task_->poll(200000);
  EXPECT_TRUE(task_->finish(plan_).verdict.usable);
  EXPECT_EQ(task_->filling().samples.size(), 4096u);
  EXPECT_EQ(task_->filling().scan_id, 3u);
}

TEST_F(AcquisitionTaskTest, FillsTheOtherImageAfterTheHandOver) {
  VERIFIES("LASSO-EXE-002~1");
  start(0, 0);
  task_->poll(200000);
  ASSERT_TRUE(task_->finish(plan_).verdict.usable);
  const RangeImage& handed_over = task_->filling();
  const TimeUs t_us = handed_over.reference_time_us();
  task_->swap_images();
  start(1, 200000);
  task_->poll(400000);
  ASSERT_TRUE(task_->finish(plan_).verdict.usable);
  EXPECT_NE(&task_->filling(), &handed_over);
  EXPECT_EQ(handed_over.scan_id, 0u);
  EXPECT_EQ(handed_over.reference_time_us(), t_us);
  EXPECT_EQ(task_->filling().scan_id, 1u);
}

// Whatever the attitude, no part of the model is outside the scan.
TEST_F(AcquisitionTaskTest, ATargetOfUnknownAttitudeIsScannedAllAround) {
  VERIFIES("LASSO-MOD-123~4 LASSO-MOD-111~1");
  Aim aim;
  aim.T_sensor_target.p = Vec3(0.2, -0.1, 3.0);
  aim.any_attitude = true;
  aim.uncertainty_m = 0.25 * mission_.radius_m;
  task_->start(0, mission_, aim, 4, 0, plan_);
  const double least = std::tan(std::asin(mission_.radius_m / 3.0));  // of the ball around the model
  EXPECT_GT(plan_.half_x, least);
  EXPECT_GT(plan_.half_y, least);
  EXPECT_LT(plan_.half_x, 1.3 * least);
  EXPECT_LT(plan_.half_y, 1.3 * least);
  EXPECT_NEAR(plan_.center_x, 0.2 / 3, 0.01);
  EXPECT_NEAR(plan_.center_y, -0.1 / 3, 0.01);
}

TEST_F(AcquisitionTaskTest, ScanThatFailsOrNeverStartsIsNotFit) {
  VERIFIES("LASSO-EXE-005~2");
  sensor_.refused = {0};
  sensor_.lost = {1};
  start(0, 0);
  task_->poll(200000);
  EXPECT_FALSE(task_->finish(plan_).verdict.usable);
  start(1, 200000);
  task_->poll(400000);
  EXPECT_FALSE(task_->finish(plan_).verdict.usable);
  Pose behind = scene_.at_zero;
  behind.p.z() = -2;
  task_->start(0, mission_, {behind, 0, false, false, {}}, 2, 400000, plan_);  // nothing to aim at
  task_->poll(600000);
  EXPECT_FALSE(task_->finish(plan_).verdict.usable);
  EXPECT_TRUE(task_->filling().samples.empty());
  start(3, 600000);
  task_->poll(800000);
  EXPECT_TRUE(task_->finish(plan_).verdict.usable);
}

TEST_F(AcquisitionTaskTest, LostScansAreCountedByTheirCause) {
  VERIFIES("LASSO-LCS-012~1");
  sensor_.refused = {0};
  sensor_.lost = {1, 2};
  for (std::uint32_t scan = 0; scan < 5; ++scan) {
    const TimeUs t_us = scan * 200000;
    start(scan, t_us);
    task_->poll(scan == 3 ? t_us + 50000 : t_us + 200000);  // of scan 3 a quarter is there
    static_cast<void>(task_->finish(plan_));
  }
  const ScanTally& tally = task_->tally(0);
  EXPECT_EQ(tally.scans, 5u);
  EXPECT_EQ(tally.lost[static_cast<std::size_t>(ScanLoss::kRefused)], 1u);
  EXPECT_EQ(tally.lost[static_cast<std::size_t>(ScanLoss::kOther)], 2u);
  EXPECT_EQ(tally.lost[static_cast<std::size_t>(ScanLoss::kUnfinished)], 1u);
  EXPECT_EQ(tally.last_loss, ScanLoss::kUnfinished);
  std::uint32_t sum = 0;
  for (const std::uint32_t count : tally.lost) sum += count;
  EXPECT_EQ(sum, 4u);
  EXPECT_EQ(task_->counters(0).frames, 0u) << "a sensor without a line";
  static_cast<void>(task_->finish(plan_));
  EXPECT_EQ(tally.scans, 5u) << "no scan was asked for";
}

TEST_F(AcquisitionTaskTest, AimedRaysArePlannedAndScannedButNotInTheWholeField) {
  VERIFIES("LASSO-SNS-007~1");
  AimedRay rays[] = {{0.01F, 0.02F}, {-0.03F, 0.04F}};
  Aim aim{scene_.at_zero, 0, false, false, {}};
  aim.rays = Span<const AimedRay>(rays);
  task_->start(0, mission_, aim, 0, 0, plan_);
  rays[0] = rays[1] = {};  // the task keeps its own
  ASSERT_EQ(plan_.aimed.size(), 2u);
  EXPECT_EQ(plan_.aimed[1].y, 0.04F);
  EXPECT_EQ(sensor_.last_plan.aimed.data(), plan_.aimed.data());
  task_->poll(200000);
  EXPECT_TRUE(task_->finish(plan_).verdict.usable);
  EXPECT_EQ(task_->filling().samples.size(), 4096u);
  const RangeSample& first = task_->filling().samples[2047];
  EXPECT_NEAR(first.direction[0] / first.direction[2], 0.01F, 1e-6F);
  aim.rays = Span<const AimedRay>(rays);
  aim.full_field = true;
  task_->start(0, mission_, aim, 1, 200000, plan_);
  EXPECT_TRUE(plan_.aimed.empty());
}

// A sensor that measures all its pixels at once: a field of 64 x 64 pixels in which nothing returns.
class EmptyField final : public PixelSensor {
 public:
  PixelPitch pitch() const override { return {0.008, 0.008}; }
  Status start(const ScanPlan&, TimeUs t_start_us) override {
    t_us_ = t_start_us;
    next_ = 0;
    return Status::kOk;
  }
  PixelPoll poll(TimeUs, Span<RangeSample> out) override {
    PixelPoll result;
    result.t_us = t_us_;
    for (; result.count < out.size() && next_ < 4096; ++next_) {
      const Vec3 ray = Vec3(0.008 * (next_ % 64 - 31.5), 0.008 * (next_ / 64 - 31.5), 1).normalized();
      RangeSample& pixel = out[result.count++];
      pixel = RangeSample{};
      for (int axis = 0; axis < 3; ++axis) pixel.direction[axis] = static_cast<float>(ray[axis]);
      pixel.state = RayState::kMiss;
    }
    result.complete = next_ == 4096;
    return result;
  }
  void abort() override {}
  void permit_laser(bool) override {}

 private:
  TimeUs t_us_ = 0;
  int next_ = 0;
};

TEST_F(AcquisitionTaskTest, ASensorThatCannotAimGetsNoAimedRaysAndMaySeeAnEmptyFieldAgainAndAgain) {
  VERIFIES("LASSO-SNS-050~1");
  EmptyField pixels;
  const auto selector = std::make_unique<PixelSelector>(pixels);
  AcquisitionTask task(only(*selector));
  AimedRays rays;
  ASSERT_TRUE(rays.push_back({0.01F, 0.02F}));
  for (std::uint32_t scan = 0; scan < 3; ++scan) {
    const TimeUs t_us = scan * 200000;
    task.start(0, mission_, {scene_.pose_at(0), 0, false, false, rays.span()}, scan, t_us, plan_);
    EXPECT_TRUE(plan_.aimed.empty());
    task.poll(t_us + 100000);
    const ScanEnd end = task.finish(plan_);
    EXPECT_TRUE(end.verdict.usable) << scan << ": every pixel is kept, and all of them are as before";
    EXPECT_EQ(end.verdict.misses, end.verdict.count);
    task.swap_images();
  }
}

TEST_F(AcquisitionTaskTest, AsksTheSensorThatItIsTold) {
  VERIFIES("LASSO-SNS-041~1");
  test::BoxSensor other(scene_);
  SensorBank bank = only(sensor_);
  ASSERT_TRUE(bank.push_back(&other));
  task_ = std::make_unique<AcquisitionTask>(bank);
  EXPECT_EQ(task_->sensors(), 2U);
  EXPECT_FALSE(task_->finish(plan_).asked);
  task_->start(1, mission_, {scene_.pose_at(0), 0, false, false, {}}, 1, 0, plan_);
  task_->poll(200000);
  const ScanEnd end = task_->finish(plan_);
  EXPECT_TRUE(end.asked);
  EXPECT_TRUE(end.verdict.usable);
  EXPECT_EQ(other.starts, 1);
  EXPECT_EQ(sensor_.starts, 0);
  EXPECT_FALSE(task_->finish(plan_).asked) << "that scan has ended";
}

TEST_F(AcquisitionTaskTest, NoSensorIsAskedForAScanThatCannotBePlanned) {
  VERIFIES("LASSO-SNS-044~2");
  Pose behind = scene_.pose_at(0);
  behind.p.z() = -3;
  task_->start(0, mission_, {behind, 0, false, false, {}}, 1, 0, plan_);
  EXPECT_FALSE(task_->finish(plan_).asked);
  EXPECT_EQ(sensor_.starts, 0);
}

}  // namespace
}  // namespace lasso
