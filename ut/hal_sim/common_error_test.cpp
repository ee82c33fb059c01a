#include "hal_sim/common_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hal_sim/scanner.hpp"
#include "ut/hal_sim/shapes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

constexpr int kSeeds = 3000;

TimeUs us(double s) { return static_cast<TimeUs>(s * 1e6); }

// Correlation of the range error of two scans, over seeds.
double correlation(double memory_s, double apart_s) {
  double sum = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const CommonErrorProcess process(seed, memory_s);
    sum += process.at(7, us(100)).range * process.at(8, us(100 + apart_s)).range;
  }
  return sum / kSeeds;
}

TEST(CommonError, IsOfVarianceOneAndForgetsAsItsMemorySays) {
  VERIFIES("LASSO-SIM-044~1");
  const double bound = 4.5 / std::sqrt(kSeeds);
  for (const double apart_s : {0.0, 0.5, 2.0, 6.0}) EXPECT_NEAR(correlation(2, apart_s), std::exp(-apart_s / 2), 1.5 * bound) << apart_s;
  EXPECT_NEAR(correlation(0, 0.2), 0, bound) << "without memory each scan has its own";
}

TEST(CommonError, IsNormalAndItsPartsAreIndependent) {
  VERIFIES("LASSO-SIM-044~1");
  for (const double memory_s : {0.0, 5.0}) {
    Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
    int beyond = 0;  // two sigmas: 4.55 % of what is normal
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
      const CommonErrors e = CommonErrorProcess(seed, memory_s).at(3, us(11));
      const Eigen::Vector4d all(e.range, e.turn.x(), e.turn.y(), e.turn.z());
      covariance += all * all.transpose() / kSeeds;
      beyond += std::abs(e.range) > 2 ? 1 : 0;
    }
    EXPECT_LT((covariance - Eigen::Matrix4d::Identity()).cwiseAbs().maxCoeff(), 0.13) << covariance;
    EXPECT_NEAR(beyond, 0.0455 * kSeeds, 4.5 * std::sqrt(0.0455 * kSeeds));
  }
}

// A wall across the boresight, at 3 m.
class CommonErrorScan : public ::testing::Test {
 protected:
  CommonErrorScan() {
    test::ShapeMesh mesh;
    mesh.quad(Vec3(-50, -50, 0), Vec3(50, -50, 0), Vec3(50, 50, 0), Vec3(-50, 50, 0));
    target_ = make_ray_caster(mesh.vertices, mesh.triangles);
  }
  double range(const ScannerModel& model, std::uint32_t scan_id, std::uint32_t ray, const Vec3& direction) const {
    return static_cast<double>(RaySimulator(*target_, motion_, model, 5).measure(scan_id, ray, direction, us(scan_id)).range_m);
  }

  std::unique_ptr<RayCaster> target_;
  ConstantTwist motion_{{Pose{Quat::Identity(), Vec3(0, 0, 3)}, Twist{}}, 0};
};

TEST_F(CommonErrorScan, AllRaysOfAScanHaveTheSameRangeErrorForTheirRange) {
  VERIFIES("LASSO-SIM-044~1");
  ScannerModel model;
  model.common_sigma_m = 2e-3;
  model.common_sigma_k_per_m = 1e-3;
  const Vec3 oblique = Vec3(0.2, -0.1, 1).normalized();
  for (std::uint32_t scan_id = 0; scan_id < 5; ++scan_id) {
    const double sigmas = CommonErrorProcess(5, 0).at(scan_id, us(scan_id)).range;
    for (std::uint32_t ray = 0; ray < 3; ++ray) {
      EXPECT_NEAR(range(model, scan_id, ray, Vec3::UnitZ()) - 3, sigmas * 11e-3, 1e-6);
      const double far_m = 3 / oblique.z();
      EXPECT_NEAR(range(model, scan_id, ray, oblique) - far_m, sigmas * (2e-3 + 1e-3 * far_m * far_m), 1e-6);
    }
  }
}

// Reported rays are turned against the measured ones: where x is turned up, what is reported straight ahead was measured below.
TEST_F(CommonErrorScan, AllRaysOfAScanAreTurnedAlike) {
  VERIFIES("LASSO-SIM-044~1");
  ScannerModel model;
  model.common_sigma_rad = 0.02;
  for (std::uint32_t scan_id = 0; scan_id < 5; ++scan_id) {
    const Vec3 turn = CommonErrorProcess(5, 0).at(scan_id, us(scan_id)).turn * 0.02;
    for (const Vec3& reported : {Vec3(0, 0, 1), Vec3(0.3, 0.1, 1).normalized().eval()}) {
      const Vec3 measured = rotate(exp_so3(-turn), reported);
      EXPECT_NEAR(range(model, scan_id, 0, reported), 3 / measured.z(), 1e-6);
    }
  }
}

}  // namespace
}  // namespace lasso::sim
