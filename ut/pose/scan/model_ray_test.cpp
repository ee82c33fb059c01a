#include "fsw/pose/scan/model_ray.hpp"

#include "ut/pose/pose_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using ModelRayTest = test::PoseFixture;

TEST_F(ModelRayTest, ARayMeetsTheModelWhereTheClosedFormHasIt) {
  VERIFIES("LASSO-REG-022~3");
  for (int i = 0; i < 5; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan();
    const PathPose<FlightNumber> pose = to_path<FlightNumber>(truth());
    int differing = 0;
    for (const ScanRay<FlightNumber>& ray : workspace_->rays) {
      const FieldHit<FlightNumber> met = meet_model(mission_, pose, ray);
      EXPECT_EQ(meets_model(mission_, pose, ray), met.found);
      differing += met.found != (ray.state == RayState::kHit) ? 1 : 0;
      if (met.found && ray.state == RayState::kHit) {
        EXPECT_NEAR(FlightNumber::to_double(met.t), FlightNumber::to_double(ray.range), 1e-3);
      }
    }
    EXPECT_LE(differing, 2) << "a ray along an edge may be rounded to either side";
  }
}

}  // namespace
}  // namespace lasso
