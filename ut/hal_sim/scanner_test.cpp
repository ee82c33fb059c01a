#include "hal_sim/scanner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "fsw/sense/pattern.hpp"
#include "ut/hal_sim/shapes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

using test::box_mesh;
using test::box_range;
using test::kNoHit;
using test::ShapeMesh;

const Vec3 kHalf(0.66, 0.21, 0.3);

// A box at a generic attitude, turning and drifting.
struct Scene {
  std::unique_ptr<RayCaster> target;
  ConstantTwist motion;

  explicit Scene(double rate_radps = 0, const ShapeMesh& mesh = box_mesh(kHalf), double range_m = 4)
      : target(make_ray_caster(mesh.vertices, mesh.triangles)), motion(truth(rate_radps, range_m), 0) {}

  static TruthState truth(double rate_radps, double range_m) {
    TruthState state;
    state.T_sensor_target = Pose{upright_attitude(0.26, 0.09) * exp_so3(Vec3(0.7, 0, 0)), Vec3(0.02, -0.01, range_m)};
    state.rates.omega_radps = rate_radps * Vec3(0.6, -0.48, 0.64);
    state.rates.v_mps = rate_radps * Vec3(-0.2, 0.3, 0.5);
    return state;
  }
};

ScanPlan plan_of(std::uint16_t points = 1024) {
  ScanPlan plan;
  plan.scan_id = 41;
  plan.points = points;
  plan.phase_turns = 0.381966;
  plan.center_x = 0.01;
  plan.half_x = 0.15;
  plan.half_y = 0.2;
  return plan;
}

std::vector<RangeSample> scan(Sensor& sensor, const ScanPlan& plan, TimeUs t_start_us = 0, std::size_t chunk = kMaxSamplesPerPoll) {
  EXPECT_EQ(sensor.start(plan, t_start_us), Status::kOk);
  std::vector<RangeSample> samples;
  std::vector<RangeSample> buffer(chunk);
  for (bool complete = false; !complete;) {
    const SensorPoll poll = sensor.poll(t_start_us + plan.duration_us, {buffer.data(), buffer.size()});
    EXPECT_EQ(poll.status, Status::kOk);
    samples.insert(samples.end(), buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(poll.count));
    complete = poll.complete || poll.status != Status::kOk;
  }
  return samples;
}

Vec3 direction_of(const RangeSample& sample) {
  return Vec3(static_cast<double>(sample.direction[0]), static_cast<double>(sample.direction[1]), static_cast<double>(sample.direction[2]))
      .normalized();
}

double true_box_range(const Pose& T_sensor_target, const Vec3& direction, const Vec3& half = kHalf) {
  const Pose T_target_sensor = inverse(T_sensor_target);
  return box_range(half, T_target_sensor.p, rotate(T_target_sensor.q, direction));
}

bool at_silhouette(const Pose& pose, const Vec3& direction) {
  return (true_box_range(pose, direction, kHalf * (1 - 1e-5)) == kNoHit) != (true_box_range(pose, direction, kHalf * (1 + 1e-5)) == kNoHit);
}

TEST(SimulatedScanner, FollowsThePlanPointByPoint) {
  VERIFIES("LASSO-SIM-008~1");
  Scene scene;
  SimulatedScanner scanner(*scene.target, scene.motion, ScannerModel{}, 1);
  for (const PatternKind kind : {PatternKind::kRosette, PatternKind::kLissajous, PatternKind::kRaster}) {
    ScanPlan plan = plan_of(257);
    plan.kind = kind;
    const auto samples = scan(scanner, plan, 77000);
    ASSERT_EQ(samples.size(), 257u);
    for (std::uint16_t i = 0; i < 257; ++i) {
      const Vec3 expected = pattern_direction(plan, i);
      for (int axis = 0; axis < 3; ++axis) ASSERT_EQ(samples[i].direction[axis], static_cast<float>(expected[axis]));
      ASSERT_EQ(samples[i].t_us, 77000 + pattern_time_us(plan, i));
    }
  }
}

// Deskew truth: every sample is the closed-form range to the target where it is at that sample's own time. Misses are reported as misses.
TEST(SimulatedScanner, EachRaySeesTheMovingTargetAtItsOwnTime) {
  VERIFIES("LASSO-SIM-009~1 LASSO-SIM-010~1");
  for (const double rate : {0.0, 0.0873, 1.0}) {
    Scene scene(rate);
    SimulatedScanner scanner(*scene.target, scene.motion, ScannerModel{}, 1);
    std::size_t hits = 0, misses = 0, moved = 0;
    const Pose first = scene.motion.at(0).T_sensor_target;
    for (const RangeSample& sample : scan(scanner, plan_of())) {
      const Vec3 direction = direction_of(sample);
      const Pose pose = scene.motion.at(sample.t_us).T_sensor_target;
      if (at_silhouette(pose, direction)) continue;
      const double expected = true_box_range(pose, direction);
      ASSERT_EQ(sample.state, expected == kNoHit ? RayState::kMiss : RayState::kHit);
      const double reported = expected == kNoHit ? 0 : expected;
      ASSERT_NEAR(static_cast<double>(sample.range_m), reported, 3e-7 * reported);  // half a unit in the last place of a float
      hits += sample.state == RayState::kHit ? 1u : 0u;
      misses += sample.state == RayState::kMiss ? 1u : 0u;
      const double at_start = true_box_range(first, direction);
      moved += at_start != kNoHit && std::abs(at_start - expected) > 1e-3 ? 1u : 0u;
    }
    EXPECT_GT(hits, 300u);
    EXPECT_GT(misses, 100u);
    EXPECT_EQ(moved > 200, rate > 0.05) << moved;  // the test can tell a scan that ignores the motion
  }
}

// A second box passes before the target: each ray meets the nearer of both, where they are at its own time.
TEST(SimulatedScanner, EachRayMeetsTheNearestOfAllBodiesAtItsOwnTime) {
  VERIFIES("LASSO-SCN-021~1");
  const Vec3 half(0.12, 0.3, 0.05);
  const Scene scene(0.4);
  const ShapeMesh mesh = box_mesh(half);
  TruthState state = Scene::truth(1, 2.5);
  state.rates.v_mps = Vec3(2, -0.5, 0.7);
  const auto passing = std::make_shared<ConstantTwist>(state, 90'000);
  SimulatedScanner scanner(*scene.target, scene.motion, ScannerModel{}, 1,
                           {{std::shared_ptr<const RayCaster>(make_ray_caster(mesh.vertices, mesh.triangles)), passing}});
  int of_target = 0, of_other = 0;
  for (const RangeSample& sample : scan(scanner, plan_of())) {
    const Pose target = scene.motion.at(sample.t_us).T_sensor_target, other = passing->at(sample.t_us).T_sensor_target;
    const Vec3 direction = direction_of(sample);
    const double target_m = true_box_range(target, direction), other_m = true_box_range(other, direction, half);
    const double expected_m = std::min(target_m, other_m);
    if (at_silhouette(target, direction) || true_box_range(other, direction, half * (1 - 1e-5)) == kNoHit) {
      if (other_m != kNoHit || at_silhouette(target, direction)) continue;
    }
    EXPECT_EQ(sample.state == RayState::kHit, expected_m != kNoHit);
    if (sample.state != RayState::kHit) continue;
    EXPECT_NEAR(static_cast<double>(sample.range_m), expected_m, 1e-6 * expected_m);
    (other_m < target_m ? of_other : of_target) += 1;
  }
  EXPECT_GT(of_target, 100);
  EXPECT_GT(of_other, 50);
}

TEST(SimulatedScanner, RangesToASphereAndAPlaneAreClosedForm) {
  VERIFIES("LASSO-SIM-009~1");
  const double radius = 0.5;
  Scene scene(0.3, test::sphere_mesh(radius, 200));
  SimulatedScanner scanner(*scene.target, scene.motion, ScannerModel{}, 1);
  const double inner = radius * std::pow(std::cos(M_PI / 400), 2);  // largest sphere within the facets
  std::size_t hits = 0;
  for (const RangeSample& sample : scan(scanner, plan_of())) {
    const Vec3 direction = direction_of(sample);
    const Vec3 origin = -scene.motion.at(sample.t_us).T_sensor_target.p;
    const double near_m = test::sphere_range(radius, origin, direction);
    const double far_m = test::sphere_range(inner, origin, direction);
    if (far_m == kNoHit) continue;
    ASSERT_EQ(sample.state, RayState::kHit);
    ASSERT_GE(static_cast<double>(sample.range_m), near_m - 5e-7);
    ASSERT_LE(static_cast<double>(sample.range_m), far_m + 5e-7);
    ++hits;
  }
  EXPECT_GT(hits, 300u);

  ShapeMesh wall;
  wall.quad(Vec3(-9, -9, 0), Vec3(9, -9, 0), Vec3(9, 9, 0), Vec3(-9, 9, 0));
  Scene plane(0.2, wall);
  SimulatedScanner plane_scanner(*plane.target, plane.motion, ScannerModel{}, 1);
  for (const RangeSample& sample : scan(plane_scanner, plan_of())) {
    const Pose pose = plane.motion.at(sample.t_us).T_sensor_target;
    const Vec3 normal = pose.q.toRotationMatrix().col(2);
    ASSERT_EQ(sample.state, RayState::kHit);
    ASSERT_NEAR(static_cast<double>(sample.range_m), normal.dot(pose.p) / normal.dot(direction_of(sample)), 5e-7);
  }
}

// ---- The contract of the Sensor interface.

TEST(SimulatedScanner, SamplesAppearWhenTheirTimeHasCome) {
  VERIFIES("LASSO-SIM-011~1");
  Scene scene;
  SimulatedScanner scanner(*scene.target, scene.motion, ScannerModel{}, 1);
  const ScanPlan plan = plan_of(100);
  std::vector<RangeSample> out(128);
  const Span<RangeSample> buffer(out.data(), out.size());
  EXPECT_EQ(scanner.poll(0, buffer).status, Status::kNoData);
  ASSERT_EQ(scanner.start(plan, 5000), Status::kOk);
  const SensorPoll early = scanner.poll(4999, buffer);
  EXPECT_EQ(early.status, Status::kOk);
  EXPECT_EQ(early.count, 0u);
  EXPECT_EQ(scanner.poll(5000, buffer).count, 1u);
  EXPECT_EQ(scanner.poll(5000, buffer).count, 0u);  // none twice
  const TimeUs half_us = 5000 + plan.duration_us / 2;
  std::size_t expected = 0;
  for (std::uint16_t i = 1; i < 100; ++i) expected += 5000 + pattern_time_us(plan, i) <= half_us ? 1u : 0u;
  const SensorPoll middle = scanner.poll(half_us, buffer);
  EXPECT_EQ(middle.count, expected);
  EXPECT_FALSE(middle.complete);
  EXPECT_LE(out[middle.count - 1].t_us, half_us);
  const SensorPoll last = scanner.poll(5000 + plan.duration_us, buffer);
  EXPECT_EQ(last.count, 99 - expected);
  EXPECT_TRUE(last.complete);
  EXPECT_EQ(scanner.poll(9000000, buffer).status, Status::kNoData);
}

TEST(SimulatedScanner, KeepsToTheRoomThatItIsGiven) {
  VERIFIES("LASSO-SIM-011~1");
  Scene scene;
  SimulatedScanner scanner(*scene.target, scene.motion, ScannerModel{}, 1);
  ASSERT_EQ(scanner.start(plan_of(64), 0), Status::kOk);
  std::vector<RangeSample> out(10);
  EXPECT_EQ(scanner.poll(1000000, {out.data(), 0}).count, 0u);
  for (int k = 0; k < 6; ++k) {
    const SensorPoll poll = scanner.poll(1000000, {out.data(), 10});
    EXPECT_EQ(poll.count, 10u);
    EXPECT_FALSE(poll.complete);
  }
  const SensorPoll last = scanner.poll(1000000, {out.data(), 10});
  EXPECT_EQ(last.count, 4u);
  EXPECT_TRUE(last.complete);
}

TEST(SimulatedScanner, ABusyScannerRefusesAndAnAbortFreesIt) {
  VERIFIES("LASSO-SIM-011~1");
  Scene scene;
  SimulatedScanner scanner(*scene.target, scene.motion, ScannerModel{}, 1);
  scanner.abort();  // idle: no effect
  std::vector<RangeSample> out(4);
  ASSERT_EQ(scanner.start(plan_of(64), 0), Status::kOk);
  scanner.poll(1000000, {out.data(), 4});
  EXPECT_EQ(scanner.start(plan_of(48), 0), Status::kBusy);
  EXPECT_EQ(scanner.poll(1000000, {out.data(), 4}).count, 4u);  // the first scan goes on
  scanner.abort();
  EXPECT_EQ(scanner.poll(1000000, {out.data(), 4}).status, Status::kNoData);
  EXPECT_EQ(scan(scanner, plan_of(48)).size(), 48u);
}

TEST(SimulatedScanner, RefusesPlansOutsideItsLimits) {
  VERIFIES("LASSO-SIM-012~1");
  Scene scene;
  ScannerModel model;
  model.fov_half_x_rad = 0.2;
  model.fov_half_y_rad = 0.3;
  SimulatedScanner scanner(*scene.target, scene.motion, model, 1);
  const auto answer = [&](auto change) {
    ScanPlan plan = plan_of();
    change(plan);
    const Status status = scanner.start(plan, 0);
    if (status != Status::kOk) {
      std::vector<RangeSample> out(1);
      EXPECT_EQ(scanner.poll(1000000, {out.data(), 1}).status, Status::kNoData);  // as it was
    }
    scanner.abort();
    return status;
  };
  EXPECT_EQ(answer([](ScanPlan& p) { p.half_x = std::tan(0.2) - p.center_x; }), Status::kOk);
  EXPECT_EQ(answer([](ScanPlan& p) { p.half_y = std::tan(0.3); }), Status::kOk);
  EXPECT_EQ(answer([](ScanPlan& p) { p.half_x = std::tan(0.2); }), Status::kBadValue);
  EXPECT_EQ(answer([](ScanPlan& p) { p.center_y = -std::tan(0.3); }), Status::kBadValue);
  EXPECT_EQ(answer([](ScanPlan& p) { p.half_y = std::nan(""); }), Status::kBadValue);
  EXPECT_EQ(answer([](ScanPlan& p) { p.points = 15; }), Status::kBadValue);
  EXPECT_EQ(answer([](ScanPlan& p) { p.points = kMaxRays + 1; }), Status::kBadValue);
}

TEST(SimulatedScanner, RefusesAimedRaysOutsideTheFieldOfView) {
  VERIFIES("LASSO-SIM-012~1");
  Scene scene;
  ScannerModel model;
  model.fov_half_x_rad = 0.2;
  model.fov_half_y_rad = 0.3;
  SimulatedScanner scanner(*scene.target, scene.motion, model, 1);
  const auto answer = [&](float x, float y) {
    const AimedRay rays[] = {{0, 0}, {x, y}};
    ScanPlan plan = plan_of();
    plan.aimed = Span<const AimedRay>(rays);
    const Status status = scanner.start(plan, 0);
    scanner.abort();
    return status;
  };
  EXPECT_EQ(answer(0.2F, -0.3F), Status::kOk);
  EXPECT_EQ(answer(0.21F, 0), Status::kBadValue);
  EXPECT_EQ(answer(0, -0.32F), Status::kBadValue);
}

TEST(SimulatedScanner, TheSameSeedGivesTheSameScanHoweverItIsPolled) {
  VERIFIES("LASSO-SIM-002~1");
  Scene scene(0.1);
  ScannerModel model;
  model.sigma0_m = 1e-3;
  model.sigma_angle_rad = 1e-4;
  model.dropout_probability = 0.1;
  model.outlier_probability = 0.1;
  model.edge_mixing_m = 0.002;
  const auto equal = [](const RangeSample& a, const RangeSample& b) {
    return a.range_m == b.range_m && a.t_us == b.t_us && a.state == b.state && std::equal(a.direction, a.direction + 3, b.direction);
  };
  const auto same = [&](const auto& a, const auto& b) { return std::equal(a.begin(), a.end(), b.begin(), b.end(), equal); };
  SimulatedScanner first(*scene.target, scene.motion, model, 9);
  SimulatedScanner second(*scene.target, scene.motion, model, 9);
  SimulatedScanner other(*scene.target, scene.motion, model, 10);
  ScanPlan plan = plan_of();
  const auto samples = scan(first, plan);
  EXPECT_TRUE(same(samples, scan(first, plan, 0, 7)));
  plan.scan_id = 3;
  const auto another = scan(second, plan);
  EXPECT_FALSE(same(samples, another));
  plan.scan_id = 41;
  EXPECT_TRUE(same(samples, scan(second, plan)));
  EXPECT_FALSE(same(samples, scan(other, plan)));
}

}  // namespace
}  // namespace lasso::sim
