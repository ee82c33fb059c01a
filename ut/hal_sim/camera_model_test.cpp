#include "hal_sim/camera_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

TEST(CameraModel, PresetsAreValid) {
  VERIFIES("LASSO-SIM-007~1");
  EXPECT_NO_THROW(validate(CameraModel{}));
}

TEST(CameraModel, EachMemberOutsideItsRangeIsNamed) {
  VERIFIES("LASSO-SIM-007~1");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  struct Case {
    const char* name;
    double CameraModel::*member;
    double bad;
  };
  const Case cases[] = {
      {"sigma0_m", &CameraModel::sigma0_m, -1e-9},
      {"sigma_k_per_m", &CameraModel::sigma_k_per_m, nan},
      {"sigma_angle_rad", &CameraModel::sigma_angle_rad, 0.11},
      {"fov_half_x_rad", &CameraModel::fov_half_x_rad, 0},
      {"fov_half_y_rad", &CameraModel::fov_half_y_rad, 1.6},
      {"range_min_m", &CameraModel::range_min_m, -0.1},
      {"range_max_m", &CameraModel::range_max_m, infinite},
      {"dropout_probability", &CameraModel::dropout_probability, 1.01},
      {"dropout_incidence_rad", &CameraModel::dropout_incidence_rad, 0},
      {"outlier_probability", &CameraModel::outlier_probability, -0.01},
      {"edge_mixing_m", &CameraModel::edge_mixing_m, nan},
      {"edge_mixing_probability", &CameraModel::edge_mixing_probability, 2},
      {"range_step_m", &CameraModel::range_step_m, -1},
      {"range_min_m", &CameraModel::range_min_m, 1000},  // not below range_max_m
  };
  for (const Case& c : cases) {
    CameraModel model;
    model.*c.member = c.bad;
    try {
      validate(model);
      ADD_FAILURE() << c.name << " was accepted";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(std::string(c.name) + " is "), std::string::npos) << error.what();
    }
  }
}

TEST(CameraModel, NoiseAlongTheRayFollowsTheTriangulationModel) {
  VERIFIES("LASSO-SIM-013~1");
  CameraModel model;
  model.sigma0_m = 3e-4;
  model.sigma_k_per_m = 1e-4;
  EXPECT_NEAR(range_sigma_m(model, 2), 5e-4, 1e-18);
  EXPECT_EQ(range_sigma_m(CameraModel{}, 7), 0);
}

// Two models with one seed share their noise: a study of one effect is not disturbed by another.
TEST(CameraModel, DrawsDependOnSeedScanAndRayAlone) {
  VERIFIES("LASSO-SIM-002~1");
  const RayDraws a = draw(1, 2, 3);
  const RayDraws b = draw(1, 2, 3);
  EXPECT_EQ(a.range, b.range);
  EXPECT_EQ(a.mixing_weight, b.mixing_weight);
  EXPECT_NE(a.range, draw(1, 2, 4).range);
  EXPECT_NE(a.range, draw(1, 3, 3).range);
  EXPECT_NE(a.range, draw(2, 2, 3).range);
}

}  // namespace
}  // namespace lasso::sim
