#include "hal_sim/scanner_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

TEST(ScannerModel, PresetsAreValid) {
  VERIFIES("LASSO-SIM-007~1");
  EXPECT_NO_THROW(validate(ScannerModel{}));
}

TEST(ScannerModel, EachMemberOutsideItsRangeIsNamed) {
  VERIFIES("LASSO-SIM-007~1");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  struct Case {
    const char* name;
    double ScannerModel::*member;
    double bad;
  };
  const Case cases[] = {
      {"sigma0_m", &ScannerModel::sigma0_m, -1e-9},
      {"sigma_k_per_m", &ScannerModel::sigma_k_per_m, nan},
      {"sigma_angle_rad", &ScannerModel::sigma_angle_rad, 0.11},
      {"fov_half_x_rad", &ScannerModel::fov_half_x_rad, 0},
      {"fov_half_y_rad", &ScannerModel::fov_half_y_rad, 1.6},
      {"range_min_m", &ScannerModel::range_min_m, -0.1},
      {"range_max_m", &ScannerModel::range_max_m, infinite},
      {"dropout_probability", &ScannerModel::dropout_probability, 1.01},
      {"dropout_incidence_rad", &ScannerModel::dropout_incidence_rad, 0},
      {"outlier_probability", &ScannerModel::outlier_probability, -0.01},
      {"edge_mixing_m", &ScannerModel::edge_mixing_m, nan},
      {"beam_divergence_rad", &ScannerModel::beam_divergence_rad, 0.11},
      {"edge_mixing_probability", &ScannerModel::edge_mixing_probability, 2},
      {"range_step_m", &ScannerModel::range_step_m, -1},
      {"common_sigma_m", &ScannerModel::common_sigma_m, -1},
      {"common_sigma_k_per_m", &ScannerModel::common_sigma_k_per_m, nan},
      {"common_sigma_rad", &ScannerModel::common_sigma_rad, 0.3},
      {"common_memory_s", &ScannerModel::common_memory_s, -1},
      {"range_min_m", &ScannerModel::range_min_m, 1000},  // not below range_max_m
  };
  for (const Case& c : cases) {
    ScannerModel model;
    model.*c.member = c.bad;
    try {
      validate(model);
      ADD_FAILURE() << c.name << " was accepted";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(std::string(c.name) + " is "), std::string::npos) << error.what();
    }
  }
}

TEST(ScannerModel, NoiseAlongTheRayFollowsTheTriangulationModel) {
  VERIFIES("LASSO-SIM-013~1");
  ScannerModel model;
  model.sigma0_m = 3e-4;
  model.sigma_k_per_m = 1e-4;
  EXPECT_NEAR(range_sigma_m(model, 2), 5e-4, 1e-18);
  EXPECT_EQ(range_sigma_m(ScannerModel{}, 7), 0);
}

TEST(ScannerModel, ALidarsNoiseHardlyKnowsTheRange) {
  VERIFIES("LASSO-SIM-033~1");
  const ScannerModel lidar = time_of_flight_lidar();
  EXPECT_NO_THROW(validate(lidar));
  for (const double z_m : {1.0, 10.0, 30.0, 60.0, 100.0}) EXPECT_NEAR(range_sigma_m(lidar, z_m), 0.020, 0.001) << z_m;
  EXPECT_EQ(lidar.range_min_m, 1);
  EXPECT_EQ(lidar.range_max_m, 100);
}

TEST(ScannerModel, ABeamWidensWithTheRange) {
  VERIFIES("LASSO-SIM-017~1");
  ScannerModel model;
  EXPECT_EQ(footprint_m(model, 50), 0);
  model.edge_mixing_m = 0.002;
  EXPECT_EQ(footprint_m(model, 50), 0.002);
  model.beam_divergence_rad = 1e-3;
  EXPECT_DOUBLE_EQ(footprint_m(model, 0), 0.002);
  EXPECT_DOUBLE_EQ(footprint_m(model, 50), 0.052);
}

// Two models with one seed share their noise: a study of one effect is not disturbed by another.
TEST(ScannerModel, DrawsDependOnSeedScanAndRayAlone) {
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
