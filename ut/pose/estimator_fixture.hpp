// An estimator, a mission of the box and scans of it.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "fsw/pose/estimator/estimator.hpp"
#include "ut/support/box_scan.hpp"

namespace lasso::test {

class EstimatorTest : public ::testing::Test {
 protected:
  EstimatorTest() {
    EXPECT_EQ(load_image(Bytes(image_.data(), image_.size), *mission_).status, Status::kOk);
    scan_.T_sensor_target = generic_box_pose();
    parameters().sigma0_m = 1e-3;
    parameters().sigma_k_per_m = 0;
  }
  MissionParameters& parameters() { return mission_->parameters; }
  Registration estimate(const RangeImage& image, const StartPoint& start) { return estimator_->estimate(*mission_, image, start); }
  Registration estimate_from(double rotation_rad, double shift_m) {
    StartPoint start;
    start.T_sensor_target = disturb(scan_.T_sensor_target, rotation_rad, shift_m, random_);
    start.rates = scan_.rates;
    return estimate(*scan_box(scan_, random_), start);
  }
  Vec6 error(const Registration& r) const { return pose_difference(r.T_sensor_target, scan_.T_sensor_target); }

  TestImage image_ = make_box_image(preset_parameters());
  std::unique_ptr<Mission> mission_ = std::make_unique<Mission>();
  std::unique_ptr<Estimator> estimator_ = std::make_unique<Estimator>();
  Generator random_{71};
  BoxScan scan_;
};

}  // namespace lasso::test
