// What stands between the sensor and the target: a cloud that scatters, as of a plume, or a piece of debris.
#include <gtest/gtest.h>

#include <algorithm>

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/symmetric6.hpp"
#include "ut/pose/estimator_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using test::EstimatorTest;

struct Cloud {
  double x = 0, y = 0, radius = 0;       // a disc of the tangent plane z = 1
  double nearest_m = 0, farthest_m = 0;  // of its returns, along the ray
  double share = 1;                      // of the rays through it that return from it
};

// Rays through the cloud return from within it. Returns how many do.
int fill(RangeImage& image, const Cloud& cloud, test::Generator& random) {
  int returns = 0;
  for (RangeSample& sample : image.samples) {
    const auto z = static_cast<double>(sample.direction[2]);
    const double x = static_cast<double>(sample.direction[0]) / z - cloud.x, y = static_cast<double>(sample.direction[1]) / z - cloud.y;
    if (x * x + y * y > cloud.radius * cloud.radius || random.uniform(0, 1) > cloud.share) continue;
    sample.state = RayState::kHit;
    sample.range_m = static_cast<float>(random.uniform(cloud.nearest_m, cloud.farthest_m));
    ++returns;
  }
  return returns;
}

class CloudTest : public EstimatorTest {
 protected:
  CloudTest() { scan_.sigma_m = 1e-3; }

  // Scans of the box at any attitude behind clouds that `draw` makes; none of their valid poses is wrong, as the requirements say wrong.
  template <class Draw>
  void fly(int scans, const Draw& draw) {
    for (int i = 0; i < scans; ++i) {
      scan_.T_sensor_target = test::disturb(test::generic_box_pose(), 0.3, 0.1, random_);
      const auto image = test::scan_box(scan_, random_);
      const Vec3& p = scan_.T_sensor_target.p;
      Cloud cloud = draw(p.z());
      cloud.x += p.x() / p.z() + scan_.half_angle * random_.uniform(-0.7, 0.7);
      cloud.y += p.y() / p.z() + scan_.half_angle * random_.uniform(-0.7, 0.7);
      most_ = std::max(most_, fill(*image, cloud, random_));
      parameters().agreement_min = random_.uniform(0.4, 1);  // missions whose sensors have outliers ask for less
      StartPoint start;
      start.T_sensor_target = test::disturb(scan_.T_sensor_target, 0.01, 0.005, random_);
      judge(estimate(*image, start), i);
    }
  }
  void judge(const Registration& r, int scan) {
    ++(r.valid() ? valid_ : refused_);
    if (!r.valid()) return;
    const Vec6 e = error(r);
    Vec6 x;
    ASSERT_EQ(solve6(r.covariance, e, x), Status::kOk);
    const bool far = e.head<3>().norm() > kRadPerDeg || e.tail<3>().norm() > 0.02;
    EXPECT_FALSE(far && e.dot(x) > 25) << "scan " << scan << ": " << e.transpose();
  }

  int valid_ = 0, refused_ = 0, most_ = 0;
};

TEST_F(CloudTest, APlumeBeforeTheTargetMakesNoWrongPoseValid) {
  VERIFIES("LASSO-SAF-001~1");
  fly(60, [this](double range_m) {
    const double nearest_m = range_m * random_.uniform(0.4, 0.9);
    return Cloud{0,
                 0,
                 scan_.half_angle * random_.uniform(0.2, 1),
                 nearest_m,
                 nearest_m + range_m * random_.uniform(0.02, 0.2),
                 random_.uniform(0.02, 0.8)};
  });
  EXPECT_GE(valid_, 10) << "thin clouds leave a pose";
  EXPECT_GE(refused_, 10) << "thick ones do not";
  EXPECT_GE(most_, scan_.side * scan_.side / 4);
}

TEST_F(CloudTest, DebrisBesideOrBeforeTheTargetMakesNoWrongPoseValid) {
  VERIFIES("LASSO-SAF-001~1");
  fly(60, [this](double range_m) {
    const double nearest_m = range_m * random_.uniform(0.5, 1.1);
    return Cloud{0, 0, scan_.half_angle * random_.uniform(0.05, 0.35), nearest_m, nearest_m + 0.01, 1};
  });
  EXPECT_GE(valid_, 10);
  EXPECT_GE(refused_, 5);
}

}  // namespace
}  // namespace lasso
