#include "hal_sim/memory_head.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <vector>

#include "hal_sim/lcs_device.hpp"
#include "ut/hal_sim/shapes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

constexpr std::uint64_t kSeed = 5;
constexpr TimeUs kStartUs = 3'000'000;

LcsCamera camera_of(lcs::Device device) {
  LcsCamera camera;
  camera.device = device;
  camera.truth.serial = camera.clock.serial = 3;
  camera.truth.angle_x_offset_rad = camera.clock.angle_x_offset_rad = 0.001;
  camera.truth.residual[4] = 2e-3;
  camera.truth.focal_length_per_K = 3e-5;
  camera.temperature_degC = 31;
  camera.hand_over_m = 3.9;
  return camera;
}

ScannerModel noisy() {
  ScannerModel model;
  model.sigma0_m = 1e-4;
  model.sigma_angle_rad = 1e-4;
  model.dropout_probability = 0.1;
  return model;
}

// In front of a box that turns and moves.
struct Scene {
  test::ShapeMesh mesh = test::box_mesh(Vec3(0.66, 0.21, 0.3));
  std::unique_ptr<RayCaster> caster = make_ray_caster(mesh.vertices, mesh.triangles);
  ConstantTwist motion{
      {{upright_attitude(0.26, 0.09) * exp_so3(Vec3(0.7, 0, 0)), Vec3(0.02, -0.01, 4)}, {Vec3(0.1, -0.2, 0.15), Vec3(0.02, 0.01, -0.05)}},
      kStartUs};
};

// Nothing of it lies on a grid.
ScanPlan plan_of(std::uint32_t scan_id, const AimedRays& aimed) {
  ScanPlan plan;
  plan.scan_id = scan_id;
  plan.phase_turns = 0.38196601125;
  plan.center_x = 0.0123456789;
  plan.half_x = 0.1512345;
  plan.half_y = 0.1987654;
  plan.aimed = aimed.span();
  return plan;
}

std::vector<RangeSample> scan(Sensor& sensor, const ScanPlan& plan, TimeUs t_start_us) {
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

class InMemory : public ::testing::TestWithParam<lcs::Device> {};

TEST_P(InMemory, GivesTheBitsThatTheLineBrings) {
  VERIFIES("LASSO-LCS-022~1");
  const Scene scene;
  const LcsCamera camera = camera_of(GetParam());
  LcsDevice device(*scene.caster, scene.motion, noisy(), kSeed, camera);
  LcsOverLine line(device, optics_of(camera), camera.bits_per_s);
  MemoryHead head(*scene.caster, scene.motion, noisy(), kSeed, camera);
  SensorInMemory memory(head, optics_of(camera));
  line.permit_laser(true);
  memory.permit_laser(true);
  AimedRays aimed;
  for (int i = 0; i < 100; ++i) static_cast<void>(aimed.push_back({0.0012F * static_cast<float>(i) - 0.06F, 0.02F}));
  for (std::uint32_t k = 0; k < 3; ++k) {
    const TimeUs t_us = kStartUs + k * 200'000;
    const std::vector<RangeSample> a = scan(memory, plan_of(k, aimed), t_us), b = scan(line, plan_of(k, aimed), t_us);
    ASSERT_EQ(a.size(), b.size());
    std::size_t hits = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      ASSERT_EQ(a[i].state, b[i].state) << i;
      ASSERT_EQ(a[i].range_m, b[i].range_m) << i;
      ASSERT_EQ(a[i].t_us, b[i].t_us) << i;
      for (int axis = 0; axis < 3; ++axis) ASSERT_EQ(a[i].direction[axis], b[i].direction[axis]) << i;
      hits += a[i].state == RayState::kHit;
    }
    EXPECT_GT(hits, a.size() / 8);
  }
}

INSTANTIATE_TEST_SUITE_P(All, InMemory, ::testing::Values(lcs::Device::kLaserCamera, lcs::Device::kLidar, lcs::Device::kTridar),
                         [](const auto& kind) { return "device_" + std::to_string(static_cast<int>(kind.param)); });

struct Rig {
  Scene scene;
  LcsCamera camera = camera_of(lcs::Device::kLaserCamera);
  MemoryHead head{*scene.caster, scene.motion, noisy(), kSeed, camera};
  lcs::HeadMemory memory;
  lcs::HeadDriver driver{memory, optics_of(camera)};
  std::vector<RangeSample> out = std::vector<RangeSample>(kMaxSamplesPerPoll);

  Status poll(TimeUs now_us) { return driver.poll(now_us, {out.data(), out.size()}).status; }
};

TEST(MemoryHead, IsDarkWithoutPermissionOrAProcessor) {
  VERIFIES("LASSO-LCS-018~1");
  Rig rig;
  rig.driver.permit_laser(true);
  ScanPlan slow = plan_of(1, {});
  slow.duration_us = 3'000'000;
  ASSERT_EQ(rig.driver.start(slow, kStartUs), Status::kOk);
  rig.head.run(kStartUs, rig.memory);
  rig.head.run(kStartUs + lcs::kUnheardUs, rig.memory);
  const std::uint32_t there = rig.memory.samples.load();
  EXPECT_GT(there, 500U);
  rig.head.run(kStartUs + lcs::kUnheardUs + 500'000, rig.memory);
  EXPECT_EQ(rig.memory.samples.load(), there) << "the processor hangs";
  EXPECT_EQ(rig.poll(kStartUs + lcs::kUnheardUs + 500'000), Status::kTruncated);

  rig.driver.permit_laser(false);
  rig.memory.commands.store(rig.memory.commands.load() + 1);  // a start that the driver would not have given
  const lcs::FrameBytes start = lcs::encode(0, lcs::StartCommand{});
  std::copy_n(start.bytes, start.size, rig.memory.command);
  rig.head.run(kStartUs + 4'000'000, rig.memory);
  EXPECT_EQ(rig.memory.result.load(), static_cast<std::uint32_t>(lcs::Result::kInhibited));
}

TEST(MemoryHead, RefusesWhatItCannotScan) {
  Rig rig;
  rig.driver.permit_laser(true);
  const auto result_of = [&](const lcs::FrameBytes& command) {
    std::copy_n(command.bytes, command.size, rig.memory.command);
    rig.memory.commands.store(rig.memory.commands.load() + 1);
    rig.head.run(kStartUs, rig.memory);
    return static_cast<lcs::Result>(rig.memory.result.load());
  };
  lcs::StartCommand wide, crowded;
  wide.plan.half_x = 1;
  crowded.aimed = kMaxAimedRays + 1;
  EXPECT_EQ(result_of(lcs::encode(0, wide)), lcs::Result::kBadPlan);
  EXPECT_EQ(result_of(lcs::encode(0, crowded)), lcs::Result::kBadPlan);
  EXPECT_EQ(result_of(lcs::encode(0, lcs::Type::kSelfTest)), lcs::Result::kUnknown);
  EXPECT_EQ(result_of(lcs::encode(0, lcs::StartCommand{})), lcs::Result::kDone);
  lcs::FrameBytes damaged = lcs::encode(0, lcs::StartCommand{});
  damaged.bytes[9] ^= 1;
  EXPECT_EQ(result_of(damaged), lcs::Result::kUnknown);
}

TEST(MemoryHead, RefusesOpticsThatAreNotValid) {
  const Scene scene;
  LcsCamera bad = camera_of(lcs::Device::kLaserCamera);
  bad.truth.baseline_m = 0;
  EXPECT_THROW(MemoryHead(*scene.caster, scene.motion, noisy(), kSeed, bad), std::invalid_argument);
}

}  // namespace
}  // namespace lasso::sim
