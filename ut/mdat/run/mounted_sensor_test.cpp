#include "mdat/run/mounted_sensor.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "fsw/geometry/portable_math.hpp"
#include "fsw/sense/pattern.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

const Vec3 kMiddle_m(0.1, -0.2, 4.0);  // of a ball, in the sensor frame
constexpr double kBall_m = 0.6;

SensorMounting mounting_at(const Vec3& place_m, const Vec3& axis, double turn_deg) {
  SensorMounting mounting;
  mounting.T_sensor_own = {Quat(Eigen::AngleAxisd(turn_deg * kRadPerDeg, axis.normalized())), place_m};
  mounting.fov_half_x_rad = mounting.fov_half_y_rad = 30 * kRadPerDeg;
  return mounting;
}

Eigen::Isometry3d matrix_of(const Pose& pose) { return Eigen::Translation3d(pose.p) * Eigen::Isometry3d(pose.q.toRotationMatrix()); }

// Its own rays meet the ball by the quadratic equation of a sphere.
class BallSensor final : public Sensor {
 public:
  explicit BallSensor(const Pose& T_sensor_own) : middle_m_(matrix_of(T_sensor_own).inverse() * kMiddle_m) {}
  Status start(const ScanPlan& plan, TimeUs t_start_us) override {
    plan_ = plan;
    aimed.assign(plan.aimed.begin(), plan.aimed.end());
    t_start_us_ = t_start_us;
    next_ = 0;
    return Status::kOk;
  }
  SensorPoll poll(TimeUs, Span<RangeSample> out) override {
    SensorPoll result;
    for (; result.count < out.size() && next_ < plan_.points; ++next_) out[result.count++] = sample_of(pattern_direction(plan_, next_));
    result.complete = next_ == plan_.points;
    return result;
  }
  void abort() override {}
  void permit_laser(bool) override {}

  std::vector<AimedRay> aimed;

 private:
  RangeSample sample_of(const Vec3& direction) const {
    RangeSample sample;
    for (int axis = 0; axis < 3; ++axis) sample.direction[axis] = static_cast<float>(direction[axis]);
    const double along = direction.dot(middle_m_), miss2 = middle_m_.squaredNorm() - along * along;
    sample.t_us = t_start_us_ + next_;
    sample.state = miss2 < kBall_m * kBall_m ? RayState::kHit : RayState::kMiss;
    if (sample.state == RayState::kHit) sample.range_m = static_cast<float>(along - std::sqrt(kBall_m * kBall_m - miss2));
    return sample;
  }

  Vec3 middle_m_;
  ScanPlan plan_;
  TimeUs t_start_us_ = 0;
  std::uint16_t next_ = 0;
};

ScanPlan plan_around_ball() {
  ScanPlan plan;
  plan.points = 256;
  plan.center_x = kMiddle_m.x() / kMiddle_m.z();
  plan.center_y = kMiddle_m.y() / kMiddle_m.z();
  plan.half_x = plan.half_y = 0.18;
  return plan;
}

std::vector<RangeSample> scan_of(Sensor& sensor, const ScanPlan& plan) {
  EXPECT_EQ(sensor.start(plan, 1000), Status::kOk);
  std::vector<RangeSample> all, some(64);
  for (bool complete = false; !complete;) {
    const SensorPoll poll = sensor.poll(1000000, Span<RangeSample>(some.data(), some.size()));
    all.insert(all.end(), some.begin(), some.begin() + static_cast<std::ptrdiff_t>(poll.count));
    complete = poll.complete;
  }
  return all;
}

std::size_t count_of(const std::vector<RangeSample>& scan, RayState state) {
  return static_cast<std::size_t>(std::count_if(scan.begin(), scan.end(), [&](const RangeSample& s) { return s.state == state; }));
}

Vec3 direction_of(const RangeSample& sample) {
  return {static_cast<double>(sample.direction[0]), static_cast<double>(sample.direction[1]), static_cast<double>(sample.direction[2])};
}

void expect_on_ball(const std::vector<RangeSample>& scan) {
  for (const RangeSample& sample : scan) {
    if (sample.state != RayState::kHit) continue;
    EXPECT_NEAR((static_cast<double>(sample.range_m) * direction_of(sample) - kMiddle_m).norm(), kBall_m, 2e-6);
    EXPECT_NEAR(direction_of(sample).norm(), 1, 2e-7);
  }
}

// 0.5 m beside the sensor frame a ball of 0.6 m at 4 m stands 7 deg elsewhere.
TEST(MountedSensorTest, ItsPointsAreThoseOfTheSensorFrame) {
  VERIFIES("LASSO-SCN-034~1");
  for (const Vec3& place_m : {Vec3(0.5, 0, 0), Vec3(-0.3, 0.4, 0.2), Vec3(0, 0, 0)}) {
    const SensorMounting mounting = mounting_at(place_m, Vec3(0.3, -1, 0.5), 9);
    BallSensor ball(mounting.T_sensor_own);
    MeasuredDepth depth;
    MountedSensor sensor(ball, mounting, depth);
    for (int i = 0; i < 2; ++i) expect_on_ball(scan_of(sensor, plan_around_ball()));
  }
}

TEST(MountedSensorTest, ARayThatMetNothingSaysNothingFromAside) {
  VERIFIES("LASSO-SCN-034~1");
  MeasuredDepth depth;
  for (const bool aside : {true, false}) {
    const SensorMounting mounting = mounting_at(aside ? Vec3(0.5, 0, 0) : Vec3::Zero(), Vec3(0.3, -1, 0.5), 9);
    BallSensor ball(mounting.T_sensor_own);
    MountedSensor sensor(ball, mounting, depth);
    const std::vector<RangeSample> scan = scan_of(sensor, plan_around_ball());
    EXPECT_EQ(count_of(scan, RayState::kMiss) == 0, aside);
    EXPECT_EQ(count_of(scan, RayState::kInvalid) == 0, !aside);
    EXPECT_EQ(sensor.can_aim(), !aside);
  }
}

// The share of the pattern that the ball fills is that of a sensor in the frame itself, once its distance is known.
TEST(MountedSensorTest, ItLooksAtWhatThePlanLooksAt) {
  VERIFIES("LASSO-SCN-034~1");
  BallSensor plain{Pose{}};
  MeasuredDepth unused;
  MountedSensor frame(plain, std::nullopt, unused);
  const auto hits = static_cast<double>(count_of(scan_of(frame, plan_around_ball()), RayState::kHit));
  const SensorMounting mounting = mounting_at(Vec3(0.6, -0.4, 0), Vec3::UnitZ(), 20);
  BallSensor ball(mounting.T_sensor_own);
  MeasuredDepth depth;
  MountedSensor sensor(ball, mounting, depth);
  EXPECT_LT(static_cast<double>(count_of(scan_of(sensor, plan_around_ball()), RayState::kHit)), 0.6 * hits);
  EXPECT_GT(static_cast<double>(count_of(scan_of(sensor, plan_around_ball()), RayState::kHit)), 0.6 * hits);
  depth.m.reset();
  static_cast<void>(scan_of(frame, plan_around_ball()));
  EXPECT_NEAR(unused.m.value(), kMiddle_m.z() - 0.8 * kBall_m, 0.2 * kBall_m);
}

// The rectangle holds each point of the plan's at that depth, and no smaller one does.
TEST(MountedSensorTest, ThePlanIsTheSmallestRectangleAroundThePoints) {
  VERIFIES("LASSO-SCN-034~1");
  test::Generator random(7);
  for (int i = 0; i < 50; ++i) {
    const SensorMounting mounting = mounting_at(Vec3(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3)),
                                                Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)), 5);
    const double depth_m = random.uniform(3, 20);
    ScanPlan plan = plan_around_ball(), own;
    ASSERT_EQ(plan_from(mounting, depth_m, plan, own), Status::kOk);
    double most = 0;
    for (int k = 0; k < 400; ++k) {
      const double x = std::clamp(random.uniform(-1.5, 1.5), -1.0, 1.0), y = std::clamp(random.uniform(-1.5, 1.5), -1.0, 1.0);
      const Vec3 point_m = depth_m * Vec3(plan.center_x + x * plan.half_x, plan.center_y + y * plan.half_y, 1);
      const Vec3 seen = matrix_of(mounting.T_sensor_own).inverse() * point_m;
      const double off_x = std::abs(seen.x() / seen.z() - own.center_x) / own.half_x;
      const double off_y = std::abs(seen.y() / seen.z() - own.center_y) / own.half_y;
      most = std::max({most, off_x, off_y});
    }
    EXPECT_LE(most, 1 + 1e-12);
    EXPECT_GT(most, 0.999);
  }
}

TEST(MountedSensorTest, ThePlanEndsWhereTheFieldDoes) {
  VERIFIES("LASSO-SCN-034~1");
  const SensorMounting mounting = mounting_at(Vec3::Zero(), Vec3::UnitY(), 25);
  ScanPlan plan = plan_around_ball(), own;
  ASSERT_EQ(plan_from(mounting, std::nullopt, plan, own), Status::kOk);
  EXPECT_NEAR(own.center_x - own.half_x, -std::tan(30 * kRadPerDeg), 1e-12);
  const AimedRay end = ray_from(mounting, AimedRay{-0.3F, 0});
  EXPECT_NEAR(static_cast<double>(end.x), -std::tan(30 * kRadPerDeg), 1e-6);
  plan.center_x = -0.5;
  const double before = own.center_x;
  EXPECT_EQ(plan_from(mounting, std::nullopt, plan, own), Status::kBadValue);
  EXPECT_EQ(own.center_x, before);
  BallSensor ball(mounting.T_sensor_own);
  MeasuredDepth depth;
  EXPECT_EQ(MountedSensor(ball, mounting, depth).start(plan, 0), Status::kBadValue);
}

// A turn alone: rays that leave the pattern go where the plan says.
TEST(MountedSensorTest, AimedRaysAreTurned) {
  VERIFIES("LASSO-SCN-034~1");
  const SensorMounting mounting = mounting_at(Vec3::Zero(), Vec3(1, 2, 3), 8);
  BallSensor ball(mounting.T_sensor_own);
  MeasuredDepth depth;
  MountedSensor sensor(ball, mounting, depth);
  const AimedRay rays[] = {{0.05F, -0.1F}, {-0.02F, 0.03F}};
  ScanPlan plan = plan_around_ball();
  plan.aimed = Span<const AimedRay>(rays);
  ASSERT_EQ(sensor.start(plan, 0), Status::kOk);
  ASSERT_EQ(ball.aimed.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec3 own(static_cast<double>(ball.aimed[i].x), static_cast<double>(ball.aimed[i].y), 1);
    const Vec3 asked(static_cast<double>(rays[i].x), static_cast<double>(rays[i].y), 1);
    EXPECT_LT((matrix_of(mounting.T_sensor_own).linear() * own.normalized() - asked.normalized()).norm(), 1e-6);
  }
}

// In the sensor frame itself nothing changes, to the bit.
TEST(MountedSensorTest, WithoutAMountingItHandsOverWhatThereIs) {
  VERIFIES("LASSO-SCN-034~1");
  BallSensor ball{Pose{}}, same{Pose{}};
  MeasuredDepth depth;
  MountedSensor sensor(ball, std::nullopt, depth);
  const std::vector<RangeSample> moved = scan_of(sensor, plan_around_ball()), plain = scan_of(same, plan_around_ball());
  ASSERT_EQ(moved.size(), plain.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_EQ(moved[i].range_m, plain[i].range_m);
    EXPECT_TRUE(std::equal(moved[i].direction, moved[i].direction + 3, plain[i].direction));
    EXPECT_EQ(moved[i].t_us, plain[i].t_us);
  }
}

}  // namespace
}  // namespace lasso::mdat
