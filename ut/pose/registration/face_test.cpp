// A box's face, whose outline says where it is (outline_fit.hpp), as the estimator uses it.
#include "fsw/geometry/symmetric6.hpp"
#include "fsw/pose/scan/path_pose.hpp"
#include "ut/pose/estimator_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

// A face seen straight on holds neither its shifts nor the turn about its normal; its rim does.
class FaceTest : public test::EstimatorTest {
 protected:
  FaceTest() {
    scan_.T_sensor_target.q = exp_so3(Vec3(0, 0, 0.35));
    scan_.sigma_m = 1e-3;
  }

  // Slid within the face by up to `shift_m` each way, and turned.
  Registration estimate_slid(double turn_rad, double shift_m, bool partial = false, bool wide = false) {
    StartPoint start;
    start.wide = wide;
    Vec6 x = Vec6::Zero();
    x[2] = random_.uniform(-turn_rad, turn_rad);
    for (int i = 3; i < 5; ++i) x[i] = random_.uniform(-shift_m, shift_m);
    start.T_sensor_target = inverse(step_pose(inverse(scan_.T_sensor_target), x));
    start.partial = partial;
    image_of_scan_ = test::scan_box(scan_, random_);
    image_of_scan_->misses_known = misses_known_;
    return estimate(*image_of_scan_, start);
  }

  int count_held(int scans) {
    int held = 0;
    for (int i = 0; i < scans; ++i) held += estimate_slid(0.05, 0.03).labels > 0 ? 1 : 0;
    return held;
  }

  std::unique_ptr<RangeImage> image_of_scan_;
  bool misses_known_ = true;
};

// A regular raster along an edge may leave a face free by a whole row: not every scan holds it. One that does is right.
TEST_F(FaceTest, AFaceThatSlidIsBroughtBackByItsOutline) {
  VERIFIES("LASSO-REG-022~3");
  scan_.side = 44;
  const auto count_brought_back = [this](double turn_rad, double shift_m) {
    int held = 0;
    for (int i = 0; i < 16; ++i) {
      const Registration r = estimate_slid(turn_rad, shift_m);
      if (!r.valid()) {
        EXPECT_EQ(r.reason, PoseReason::kModelMismatch);
        EXPECT_GT(error(r).tail<3>().norm() + mission_->radius_m * error(r).head<3>().norm(), 8e-3) << i << ": it was not brought back";
      }
      if (r.weak > 0 || !r.valid()) continue;
      EXPECT_GT(r.labels, 0);
      EXPECT_LT(error(r).tail<3>().norm(), 8e-3) << i;
      EXPECT_LT(error(r).head<3>().norm(), 0.03) << i;
      ++held;
    }
    return held;
  };
  EXPECT_GE(count_brought_back(0.01, 0.01), 7);
  EXPECT_GE(count_brought_back(0.04, 0.03), 2);
  (void)count_brought_back(0.1, 0.08);
}

// Coarse alignment has centred the face before the outline is asked, and a start has nothing else.
TEST_F(FaceTest, ARoughStartBesideAFaceIsBroughtBackByItsOutline) {
  VERIFIES("LASSO-REG-022~3");
  scan_.side = 44;
  int found = 0;
  for (int i = 0; i < 60; ++i) {
    scan_.T_sensor_target.q = exp_so3(Vec3(0, 0, random_.uniform(-3, 3)));
    const Registration r = estimate_slid(0.2, 0.1 + 0.2 * (i % 2), false, true);
    const Vec6 e = error(r);
    found += r.valid() && e.tail<3>().norm() < 0.02 && e.head<3>().norm() < 0.05 ? 1 : 0;
  }
  EXPECT_GE(found, 40);
}

TEST_F(FaceTest, ThePoseKnowsHowWellItsLabelsHoldIt) {
  VERIFIES("LASSO-REG-023~1");
  double sum = 0;
  int held = 0;
  scan_.side = 40;
  for (int i = 0; i < 90; ++i) {
    scan_.T_sensor_target.q = exp_so3(Vec3(0, 0, random_.uniform(-3, 3)));
    scan_.T_sensor_target.p = test::disturb(test::generic_box_pose(), 0, 0.05, random_).p;
    const Registration r = estimate_slid(0.05, 0.03);
    if (r.labels == 0) continue;
    const Vec6 e = error(r);
    Mat6 information;
    ASSERT_EQ(invert6(r.covariance, information), Status::kOk);
    sum += e.dot(information * e);
    ++held;
  }
  EXPECT_GT(held, 15);
  EXPECT_GT(sum / held, 4.8);
  EXPECT_LT(sum / held, 7.5) << "of 6";
}

// The same draws with what keeps the outline out, and without.
TEST_F(FaceTest, AnOutlineThatManyRaysDisputeHoldsNothing) {
  VERIFIES("LASSO-REG-022~3 LASSO-REG-021~1");
  for (int i = 0; i < 20; ++i) {
    scan_.outliers = 0.1;
    const Registration r = estimate_slid(0.05, 0.03);
    EXPECT_EQ(r.labels, 0);
    EXPECT_GE(r.weak, 3);
  }
  scan_.outliers = 0;
  EXPECT_GE(count_held(20), 5);
}

// Some settle, and move, and then no longer settle: such a pose is that of the hits again.
TEST_F(FaceTest, AnOutlineThatSomeRaysDisputeHoldsRightOrNothing) {
  VERIFIES("LASSO-REG-022~3");
  int held = 0;
  scan_.side = 44;
  parameters().agreement_min = 0;  // drop-outs that are not stated contradict any pose
  for (int i = 0; i < 50; ++i) {
    scan_.dropouts = random_.uniform(0.03, 0.09);
    const Registration r = estimate_slid(0.04, 0.03);
    EXPECT_TRUE(r.valid()) << to_string(r.reason);
    EXPECT_TRUE(r.labels > 0 || r.weak >= 3);
    if (r.labels == 0) continue;
    EXPECT_LT(error(r).tail<3>().norm(), 0.03) << i;
    ++held;
  }
  EXPECT_GT(held, 4);
}

TEST_F(FaceTest, DropOutsThatTheMissionExpectsAreNoDispute) {
  VERIFIES("LASSO-REG-022~3");
  scan_.side = 44;
  scan_.dropouts = 0.15;
  int held[2] = {};
  for (int i = 0; i < 40; ++i) {
    parameters().dropout_probability = i % 2 == 0 ? 0 : 0.15;
    const Registration r = estimate_slid(0.02, 0.012);
    if (r.labels == 0) continue;
    EXPECT_LT(error(r).tail<3>().norm(), 0.02);
    ++held[i % 2];
  }
  EXPECT_GT(held[1], held[0] + 4);
}

TEST_F(FaceTest, WithoutMissesOrTheWholeTargetThereIsNoOutline) {
  VERIFIES("LASSO-REG-022~3 LASSO-REG-021~1");
  for (int i = 0; i < 20; ++i) {
    misses_known_ = true;
    const Registration part = estimate_slid(0.05, 0.03, true);
    EXPECT_EQ(part.labels, 0);
    EXPECT_GE(part.weak, 3);
    misses_known_ = false;
    const Registration cloud = estimate_slid(0.05, 0.03);
    EXPECT_EQ(cloud.labels, 0);
    EXPECT_GE(cloud.weak, 3);
  }
  misses_known_ = true;
  EXPECT_GE(count_held(20), 5);
}

// As of a body whose surface is known to a centimetre, by a sensor that says so of its ranges or by a model.
TEST_F(FaceTest, ASurfaceThatIsHardlyKnownIsNoDispute) {
  VERIFIES("LASSO-REG-022~3");
  scan_.side = 44;
  scan_.sigma_m = 8e-3;
  parameters().surface_sigma_m = 8e-3;
  EXPECT_GE(count_held(12), 2);
  parameters().surface_sigma_m = 1e-5;
  parameters().sigma0_m = 8e-3;
  EXPECT_GE(count_held(12), 2);
}

}  // namespace
}  // namespace lasso
