// What tests of a head have in common: a scene before it, an odd plan, noise, and its scan's samples, which are to be those of another
// sensor.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "hal_sim/lcs_head.hpp"
#include "hal_sim/ray_caster.hpp"
#include "hal_sim/scanner.hpp"
#include "ut/hal_sim/shapes.hpp"

namespace lasso::sim {

constexpr std::uint64_t kHeadSeed = 5;
constexpr TimeUs kHeadStartUs = 3'000'000;

inline LcsCamera head_of(lcs::Device device) {
  LcsCamera camera;
  camera.device = device;
  camera.truth.serial = camera.clock.serial = 3;
  camera.truth.angle_x_offset_rad = camera.clock.angle_x_offset_rad = 0.001;
  camera.truth.residual[4] = 2e-3;
  camera.truth.focal_length_per_K = 3e-5;
  camera.truth.depth_max_m = 4.1;  // some of the box is beside it
  camera.clock.delay_us = 0.01;
  camera.temperature_degC = 31;
  camera.hand_over_m = 3.9;
  return camera;
}

inline ScannerModel noisy_head() {
  ScannerModel model;
  model.sigma0_m = 1e-4;
  model.sigma_k_per_m = 1e-4;
  model.sigma_angle_rad = 1e-4;
  model.dropout_probability = 0.1;
  model.outlier_probability = 0.05;
  model.range_min_m = 3.8;  // some of it is too near
  return model;
}

// In front of a box that turns and moves.
struct HeadScene {
  test::ShapeMesh mesh = test::box_mesh(Vec3(0.66, 0.21, 0.3));
  std::unique_ptr<RayCaster> caster = make_ray_caster(mesh.vertices, mesh.triangles);
  ConstantTwist motion{
      {{upright_attitude(0.26, 0.09) * exp_so3(Vec3(0.7, 0, 0)), Vec3(0.02, -0.01, 4)}, {Vec3(0.1, -0.2, 0.15), Vec3(0.02, 0.01, -0.05)}},
      kHeadStartUs};
};

inline AimedRays aimed_row() {
  AimedRays rays;
  for (int i = 0; i < 100; ++i) static_cast<void>(rays.push_back({0.0012F * static_cast<float>(i) - 0.06F, 0.02F}));
  return rays;
}

// Nothing of it lies on a grid.
inline ScanPlan odd_plan(std::uint32_t scan_id, const AimedRays& aimed) {
  ScanPlan plan;
  plan.scan_id = scan_id;
  plan.phase_turns = 0.38196601125;
  plan.center_x = 0.0123456789;
  plan.half_x = 0.1512345;
  plan.half_y = 0.1987654;
  plan.aimed = aimed.span();
  return plan;
}

inline std::vector<RangeSample> whole_scan(Sensor& sensor, const ScanPlan& plan, TimeUs t_start_us) {
  std::vector<RangeSample> samples, buffer(kMaxSamplesPerPoll);
  EXPECT_EQ(sensor.start(plan, t_start_us), Status::kOk);
  bool complete = false;
  for (TimeUs now_us = t_start_us; !complete && now_us < t_start_us + 195'000; now_us += 5'000) {
    const SensorPoll poll = sensor.poll(now_us, {buffer.data(), buffer.size()});
    EXPECT_EQ(poll.status, Status::kOk);
    samples.insert(samples.end(), buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(poll.count));
    complete = poll.complete;
  }
  EXPECT_TRUE(complete);
  return samples;
}

inline void expect_same_samples(const std::vector<RangeSample>& a, const std::vector<RangeSample>& b) {
  ASSERT_EQ(a.size(), b.size());
  std::size_t hits = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].state, b[i].state) << i;
    ASSERT_EQ(a[i].range_m, b[i].range_m) << i;
    ASSERT_EQ(a[i].t_us, b[i].t_us) << i;
    ASSERT_EQ(a[i].sigma_factor, b[i].sigma_factor) << i;
    for (int k = 0; k < 3; ++k) ASSERT_EQ(a[i].direction[k], b[i].direction[k]) << i;
    hits += a[i].state == RayState::kHit;
  }
  EXPECT_GT(hits, a.size() / 8);
}

inline std::string device_name(const ::testing::TestParamInfo<lcs::Device>& info) {
  if (info.param == lcs::Device::kLidar) return "lidar";
  return info.param == lcs::Device::kTridar ? "tridar" : "laser_camera";
}

}  // namespace lasso::sim
