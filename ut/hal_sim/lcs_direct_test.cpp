#include "hal_sim/lcs_direct.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <vector>

#include "hal_sim/lcs_device.hpp"
#include "ut/hal_sim/head_scene.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

class Direct : public ::testing::TestWithParam<lcs::Device> {};
class Calibrated : public Direct {};  // heads that have a calibration: the LIDAR has none

TEST_P(Direct, GivesTheBitsThatTheLineBrings) {
  VERIFIES("LASSO-LCS-010~4");
  const HeadScene scene;
  const LcsCamera camera = head_of(GetParam());
  LcsDevice device(*scene.caster, scene.motion, noisy_head(), kHeadSeed, camera);
  LcsOverLine line(device, optics_of(camera), camera.bits_per_s);
  line.permit_laser(true);
  LcsDirect direct(*scene.caster, scene.motion, noisy_head(), kHeadSeed, camera);
  const AimedRays aimed = aimed_row();
  for (std::uint32_t k = 0; k < 3; ++k) {  // of which the first has to light the laser
    const TimeUs t_us = kHeadStartUs + k * 200'000;
    expect_same_samples(whole_scan(direct, odd_plan(k, aimed), t_us), whole_scan(line, odd_plan(k, aimed), t_us));
  }
}

TEST_P(Calibrated, GoesByTheCalibrationThatItIsGiven) {
  VERIFIES("LASSO-LCS-010~4 LASSO-LCS-007~2");
  const HeadScene scene;
  const LcsCamera camera = head_of(GetParam());
  TriangulationCalibration other = camera.truth;
  other.baseline_m *= 1.001;
  LcsDevice device(*scene.caster, scene.motion, noisy_head(), kHeadSeed, camera);
  LcsOverLine line(device, optics_of(camera), camera.bits_per_s);
  LcsDirect direct(*scene.caster, scene.motion, noisy_head(), kHeadSeed, camera);
  line.permit_laser(true);
  line.use_calibration(&other);
  direct.use_calibration(&other);
  const AimedRays none;
  const std::vector<RangeSample> calibrated = whole_scan(direct, odd_plan(0, none), kHeadStartUs);
  expect_same_samples(calibrated, whole_scan(line, odd_plan(0, none), kHeadStartUs));
  direct.use_calibration(nullptr);
  const std::vector<RangeSample> made = whole_scan(direct, odd_plan(0, none), kHeadStartUs);
  std::size_t moved = 0;
  for (std::size_t i = 0; i < made.size(); ++i) moved += made[i].range_m != calibrated[i].range_m;
  EXPECT_GT(moved, 100U);
}

INSTANTIATE_TEST_SUITE_P(All, Direct, ::testing::Values(lcs::Device::kLaserCamera, lcs::Device::kLidar, lcs::Device::kTridar), device_name);
INSTANTIATE_TEST_SUITE_P(All, Calibrated, ::testing::Values(lcs::Device::kLaserCamera, lcs::Device::kTridar), device_name);

TEST(LcsDirect, RefusesOpticsThatAreNotValid) {
  const HeadScene scene;
  LcsCamera bad = head_of(lcs::Device::kLaserCamera);
  bad.truth.baseline_m = 0;
  EXPECT_THROW(LcsDirect(*scene.caster, scene.motion, noisy_head(), kHeadSeed, bad), std::invalid_argument);
}

}  // namespace
}  // namespace lasso::sim
