// What a search makes of anything but the target: nothing, whatever its attitude.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "fsw/pose/recognition/acceptance.hpp"
#include "ut/pose/whole_search.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

// Where a ray from `origin` along `u`, in the thing's own frame, first meets it; or a negative number.
using Caster = std::function<double(const Vec3& origin, const Vec3& u)>;

double nearest(double a, double b) { return a > 0 && (b <= 0 || a < b) ? a : b; }

// The nearer root of a t^2 + 2 b t + c = 0, or -1.
double nearer_root(double a, double b, double c) {
  const double d = b * b - a * c;
  return a > 0 && d >= 0 ? (-b - std::sqrt(d)) / a : -1;
}

double cast_sphere(double radius, const Vec3& origin, const Vec3& u) {
  return nearer_root(u.dot(u), origin.dot(u), origin.dot(origin) - radius * radius);
}

// Closed, along x.
double cast_cylinder(double half_length, double radius, const Vec3& origin, const Vec3& u) {
  const auto across = [](const Vec3& v) { return v.tail<2>(); };
  const double wall = nearer_root(across(u).squaredNorm(), across(origin).dot(across(u)), across(origin).squaredNorm() - radius * radius);
  double range = std::abs(origin.x() + wall * u.x()) < half_length ? wall : -1;
  for (const double end : {-half_length, half_length}) {
    const double t = (end - origin.x()) / u.x();
    if (across(Vec3(origin + t * u)).norm() < radius) range = nearest(t, range);
  }
  return range;
}

class StrangersTest : public test::WholeSearch {
 protected:
  // A scan like the fixture's own, of anything; `clutter` is the share of rays that return from anywhere.
  std::unique_ptr<RangeImage> scan_of(const Caster& cast, double clutter, double t_s) {
    auto image = scan_at(t_s);
    const Pose T_thing_sensor = inverse(scan_.T_sensor_target);
    for (RangeSample& sample : image->samples) {
      const Vec3 u(static_cast<double>(sample.direction[0]), static_cast<double>(sample.direction[1]),
                   static_cast<double>(sample.direction[2]));
      double range = cast(T_thing_sensor.p, rotate(T_thing_sensor.q, u));
      if (range > 0) range += scan_.sigma_m * random_.normal();
      if (random_.uniform(0, 1) < clutter) range = random_.uniform(1.5, 3.5);
      sample.state = range > 0 ? RayState::kHit : RayState::kMiss;
      sample.range_m = range > 0 ? static_cast<float>(range) : 0;
    }
    return image;
  }

  // Accepted poses of three attitudes, each seen by two scans.
  int accepted(const Caster& cast, double clutter = 0) {
    int count = 0;
    for (int i = 0; i < 3; ++i) {
      scan_.T_sensor_target = test::random_box_pose(random_);
      search_->begin(limits_);
      for (int k = 0; k < 2; ++k) count += accepts(*scan_of(cast, clutter, 2.0 * k)) ? 1 : 0;
    }
    return count;
  }
  bool accepts(const RangeImage& image) {
    if (!search_->joins()) search_->begin(limits_);
    EXPECT_EQ(search_->add_scan(mission_, image, *workspace_), Status::kOk);
    work();
    EXPECT_NE(result().outcome, SearchOutcome::kNone);
    return result().outcome == SearchOutcome::kAccepted;
  }
};

// The same way of looking finds the target itself.
TEST_F(StrangersTest, TheTargetIsAccepted) {
  VERIFIES("LASSO-MOD-119~2");
  EXPECT_GE(accepted([](const Vec3& origin, const Vec3& u) { return test::cast_boxes(test::uneven_boxes(), origin, u); }), 4);
}

TEST_F(StrangersTest, WhereNothingIsNothingIsAccepted) {
  VERIFIES("LASSO-MOD-119~2");
  EXPECT_EQ(accepted([](const Vec3&, const Vec3&) { return -1.0; }, 0.3), 0);
}

TEST_F(StrangersTest, AnotherSpacecraftIsNotAccepted) {
  VERIFIES("LASSO-MOD-119~2");
  // A body of about the same size with two panels and a mast.
  const test::Boxes other{{{0, 0, 0}, {0.16, 0.15, 0.20}, 0.02, 0.2},
                          {{0, 0.36, 0.05}, {0.10, 0.18, 0.01}, 0.02, 0.2},
                          {{0, -0.36, 0.05}, {0.10, 0.18, 0.01}, 0.02, 0.2},
                          {{0.05, 0, 0.32}, {0.02, 0.02, 0.10}, 0.02, 0.2}};
  EXPECT_EQ(accepted([&](const Vec3& origin, const Vec3& u) { return test::cast_boxes(other, origin, u); }), 0);
}

TEST_F(StrangersTest, APlainCylinderIsNotAccepted) {
  VERIFIES("LASSO-MOD-119~2");
  EXPECT_EQ(accepted([](const Vec3& origin, const Vec3& u) { return cast_cylinder(0.32, 0.17, origin, u); }), 0);
}

TEST_F(StrangersTest, ASphereIsNotAccepted) {
  VERIFIES("LASSO-MOD-119~2");
  EXPECT_EQ(accepted([](const Vec3& origin, const Vec3& u) { return cast_sphere(0.25, origin, u); }), 0);
}

}  // namespace
}  // namespace lasso
