#include "mdat/serve/iterations.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mdat/run/case.hpp"
#include "ut/mdat/serve/small_recording.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::serve {
namespace {

double off_m(const Pose& estimate, const Pose& truth) { return pose_difference(estimate, truth).tail<3>().norm(); }

// The scan is without noise, and the filter of the frame before is right but for a shift: the steps lead from there to the true pose.
TEST(Iterations, LeadFromThePredictionToThePoseOfTheScan) {
  VERIFIES("LASSO-WEB-013~1");
  const TestFolder folder;
  SmallRecording small;
  small.filter_shift_m = Vec3(0.004, -0.003, 0.005);
  const Recording recording(small.write(folder.path() / "a.mcap"));
  const std::vector<RegistrationStep> steps = iterations_of(recording, 1);
  ASSERT_GE(steps.size(), 3U);
  EXPECT_NEAR(off_m(steps.front().T_sensor_target, SmallRecording::truth(1)), small.filter_shift_m.norm(), 1e-6);  // constant rates
  EXPECT_LT(off_m(steps.back().T_sensor_target, SmallRecording::truth(1)), 2e-4);
  EXPECT_EQ(steps.front().step_m, 0);
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const Vec6 difference = pose_difference(steps[i].T_sensor_target, steps[i - 1].T_sensor_target);
    EXPECT_NEAR(steps[i].step_m, difference.tail<3>().norm(), 1e-12);
    EXPECT_NEAR(steps[i].step_rad, difference.head<3>().norm(), 1e-12);
  }
  EXPECT_LT(steps.back().rms_m, 1e-3);
  EXPECT_GT(steps.back().inliers, 50U);
}

TEST(Iterations, AreNotMadeUpWhereNothingTellsTheStart) {
  VERIFIES("LASSO-WEB-013~1");
  const TestFolder folder;
  SmallRecording small;
  const Recording recording(small.write(folder.path() / "a.mcap"));
  EXPECT_TRUE(iterations_of(recording, 0).empty());  // no frame before
  EXPECT_TRUE(iterations_of(recording, 4).empty());  // no registration
  small.with_image = false;
  const Recording without(small.write(folder.path() / "b.mcap"));
  EXPECT_TRUE(iterations_of(without, 1).empty());
}

// Against the boxes by slabs, at a pose that is off.
TEST(Iterations, ResidualsAreThoseOfTheSurfaceAtThePose) {
  VERIFIES("LASSO-WEB-013~1");
  const TestFolder folder;
  const Recording recording(SmallRecording{}.write(folder.path() / "a.mcap"));
  const std::optional<RangeImage> scan = recorded_scan(recording, 2);
  ASSERT_TRUE(scan);
  const Pose off = SmallRecording::estimate(2);
  const Twist rates = SmallRecording::rates();
  const std::vector<float> residuals = residuals_at(recording, *scan, off, rates);
  ASSERT_EQ(residuals.size(), scan->samples.size());
  std::size_t compared = 0;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    const RangeSample& sample = scan->samples[i];
    const Pose T_target_sensor = inverse(propagate(off, rates, to_seconds(sample.t_us - scan->reference_time_us())));
    const Vec3 u =
        Vec3(static_cast<double>(sample.direction[0]), static_cast<double>(sample.direction[1]), static_cast<double>(sample.direction[2]))
            .normalized();
    const double range_m = test::cast_boxes(test::uneven_boxes(), T_target_sensor.p, rotate(T_target_sensor.q, u));
    EXPECT_TRUE(sample.state == RayState::kHit || std::isnan(residuals[i]));
    if (sample.state != RayState::kHit || range_m < 0 || std::isnan(residuals[i])) continue;
    EXPECT_NEAR(residuals[i], static_cast<double>(sample.range_m) - range_m, 1e-5) << i;
    ++compared;
  }
  EXPECT_GT(compared, 50U);
}

TEST(Iterations, TheScanOfAnIterationHasItsResiduals) {
  VERIFIES("LASSO-WEB-013~1");
  const TestFolder folder;
  const Shown shown = shown_of(SmallRecording{}.write(folder.path() / "a.mcap"));
  const std::string bytes = scan_answer(shown, 1, target_of("/?iteration=0")).body;
  const std::size_t n = number_at_byte<std::uint32_t>(bytes, 0);
  std::size_t hits = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto residual_m = static_cast<double>(number_at_byte<float>(bytes, 8 + 4 * (3 * n + i)));
    if (std::isnan(residual_m)) continue;
    ++hits;
    EXPECT_LT(std::abs(residual_m), 1e-4) << i;  // it begins at the true pose
  }
  EXPECT_GT(hits, 50U);
  EXPECT_THROW((void)scan_answer(shown, 1, target_of("/?iteration=99")), Refusal);
  EXPECT_THROW((void)scan_answer(shown, 0, target_of("/?iteration=0")), Refusal);
}

}  // namespace
}  // namespace lasso::mdat::serve
