#include "mdat/benchmark/still_scans.hpp"

#include <gtest/gtest.h>

#include "ut/mdat/benchmark/folder.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

Subject subject_in(const test::PassingFolder& folder) {
  SubjectRequest request;
  request.seed = 52;
  request.mission = folder / "m.toml";
  request.model = folder / "m.stl";
  return make_subject(request);
}

class StillScansTest : public ::testing::Test {
 protected:
  Vec3 middle_m() const { return 0.5 * (subject.truth.low_m + subject.truth.high_m); }

  test::PassingFolder folder;
  Subject subject = subject_in(folder);
};

TEST_F(StillScansTest, PosesLieOnceToTwiceTheNearestRangeOff) {
  VERIFIES("LASSO-GND-120~1");
  StillScans scans(subject, ScanStream::kBenchmark);
  double least = 1e9, most = 0;
  Vec3 mean = Vec3::Zero();
  for (int i = 0; i < 400; ++i) {
    const Pose pose = scans.draw_pose();
    const Vec3 middle = pose * middle_m();
    EXPECT_LE(middle.head<2>().cwiseAbs().maxCoeff(), 0.02 * middle.z() * 1.000001);
    least = std::min(least, middle.z());
    most = std::max(most, middle.z());
    mean += rotate(pose.q, Vec3::UnitX()) / 400;
  }
  EXPECT_GE(least, subject.nearest_m);
  EXPECT_LE(most, 2 * subject.nearest_m);
  EXPECT_GT(most - least, 0.95 * subject.nearest_m);
  EXPECT_LT(mean.norm(), 0.15) << "attitudes are of any kind";
}

TEST_F(StillScansTest, StartsAreTurnedAndShiftedAsFarAsIsAsked) {
  VERIFIES("LASSO-GND-120~1");
  StillScans scans(subject, ScanStream::kBenchmark);
  for (int i = 0; i < 50; ++i) {
    const Pose pose = scans.draw_pose(), start = scans.draw_start(pose, 0.1, 0.3);
    EXPECT_NEAR(pose_difference(start, pose).head<3>().norm(), 0.1, 1e-9);
    EXPECT_NEAR((start * middle_m() - pose * middle_m()).norm(), 0.3, 1e-9);
  }
}

// In their order of time, as a recording has them.
TEST_F(StillScansTest, EachScanBeginsAfterTheOneBeforeHasEnded) {
  VERIFIES("LASSO-GND-120~1");
  StillScans scans(subject, ScanStream::kBenchmark);
  TimeUs ended_us = 0;
  for (int i = 0; i < 3; ++i) {
    const Pose pose = scans.draw_pose();
    const RangeImage& scan = scans.scan(subject.target->surface(), pose, pose);
    EXPECT_GT(scan.samples[0].t_us, ended_us);
    ended_us = scan.samples[scan.samples.size() - 1].t_us;
  }
}

TEST_F(StillScansTest, EachStreamIsItsOwnAndRepeats) {
  VERIFIES("LASSO-GND-120~1");
  StillScans one(subject, ScanStream::kBenchmark), same(subject, ScanStream::kBenchmark), other(subject, ScanStream::kStarts);
  const Pose first = one.draw_pose();
  EXPECT_EQ(first.p, same.draw_pose().p);
  EXPECT_NE(first.p, other.draw_pose().p);
  const RangeImage &a = one.scan(subject.target->surface(), first, first), &b = same.scan(subject.target->surface(), first, first);
  ASSERT_EQ(a.samples.size(), b.samples.size());
  for (std::size_t i = 0; i < a.samples.size(); ++i) EXPECT_EQ(a.samples[i].range_m, b.samples[i].range_m);
}

}  // namespace
}  // namespace lasso::mdat
