#include "mdat/paper/budget.hpp"

#include <cmath>

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/so3.hpp"
#include "ut/support/dense.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using test::Dense;
using test::DenseVector;

// A closed box about the target's origin; each corner is three vertices, as in files that repeat them.
Mesh box_mesh(const Vec3& half_m) {
  Mesh mesh;
  const std::array<std::uint32_t, 3> faces[] = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                                                {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  for (const auto& face : faces) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const std::uint32_t corner : face)
      mesh.vertices.emplace_back((corner & 1 ? 1 : -1) * half_m.x(), (corner & 2 ? 1 : -1) * half_m.y(),
                                 (corner & 4 ? 1 : -1) * half_m.z());
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

Mesh box() { return box_mesh({0.2, 0.3, 0.4}); }
Pose generic_pose() { return {exp_so3(Vec3(0.5, -0.4, 0.3)), Vec3(0.05, -0.03, 3)}; }

std::vector<Vec3> random_rays(std::uint64_t seed, int count) {
  test::Generator random(seed);
  std::vector<Vec3> rays;
  for (int i = 0; i < count; ++i) {
    const double x = random.uniform(-0.12, 0.12);
    rays.push_back(Vec3(x, random.uniform(-0.12, 0.12), 1).normalized());
  }
  return rays;
}

BudgetAssumptions assumptions() {
  BudgetAssumptions a;
  a.sensor.sigma0_m = 0.001;
  a.sensor.sigma_k_per_m = 2e-4;
  a.sensor.sigma_angle_rad = 3e-4;
  a.sensor.common_sigma_m = 0.002;
  a.sensor.common_sigma_k_per_m = 1e-4;
  a.sensor.common_sigma_rad = 2e-4;
  a.vertex_sigma_m = 0.002;
  a.sigma0_m = 0.0015;
  a.sigma_k_per_m = 1e-4;
  a.sigma_angle_rad = 2e-4;
  a.surface_sigma_m = 0.001;
  a.incidence_max_rad = 80 * kRadPerDeg;
  return a;
}

double range_of(const sim::RayCaster& surface, const Pose& T_sensor_target, const Vec3& direction) {
  const Pose T_target_sensor = inverse(T_sensor_target);
  const sim::RayHit hit = surface.cast(T_target_sensor.p, rotate(T_target_sensor.q, direction));
  return hit.hit ? hit.range_m : 0;
}

Pose moved(const Pose& pose, const DenseVector& d) {
  const Vec3 turn(d[0], d[1], d[2]), shift(d[3], d[4], d[5]);
  return pose * Pose{exp_so3(turn), shift};
}

// An estimator of its own: rays whose ranges are smooth about the truth, weights by the incidence that three rays show, and the pose by
// least squares over finite differences.
class Peer {
 public:
  Peer(const Mesh& mesh, const BudgetAssumptions& a, const std::vector<Vec3>& rays)
      : surface_(sim::make_ray_caster(mesh.vertices, mesh.triangles)) {
    for (const Vec3& ray : rays) take(a, ray);
    Dense information = Dense::Zero(6, 6);
    for (std::size_t i = 0; i < rays_.size(); ++i) information += gradients_[i] * gradients_[i].transpose() / variances_[i];
    covariance_ = test::inverse_of(information);
  }

  // The Z error in metres and the turn about the target's x axis of the pose that these range errors give.
  std::pair<double, double> errors(const std::vector<double>& range_errors_m) const {
    DenseVector right = DenseVector::Zero(6);
    for (std::size_t i = 0; i < rays_.size(); ++i) right += gradients_[i] * range_errors_m[i] / variances_[i];
    const DenseVector d = covariance_ * right;
    return {(moved(generic_pose(), d).p - generic_pose().p).z(), d[0]};
  }

  const std::vector<Vec3>& rays() const { return rays_; }
  const std::vector<double>& ranges_m() const { return ranges_m_; }

 private:
  static constexpr double kStep = 1e-6;

  void take(const BudgetAssumptions& a, const Vec3& ray) {
    const double range_m = range_of(*surface_, generic_pose(), ray);
    const Pose T = inverse(generic_pose());
    const sim::RayHit hit = surface_->cast(T.p, rotate(T.q, ray));
    const double cosine = hit.hit ? std::fabs(hit.normal.dot(rotate(T.q, ray))) : 0;
    if (cosine < std::cos(a.incidence_max_rad)) return;
    DenseVector gradient = DenseVector::Zero(6);
    for (int i = 0; i < 6; ++i) {
      DenseVector d = DenseVector::Zero(6);
      d[i] = kStep;
      gradient[i] =
          (range_of(*surface_, moved(generic_pose(), d), ray) - range_of(*surface_, moved(generic_pose(), -d), ray)) / (2 * kStep);
    }
    if (gradient.norm() > 100) return;  // over an edge
    rays_.push_back(ray);
    ranges_m_.push_back(range_m);
    gradients_.push_back(gradient);
    const double z_m = range_m * ray.z(), far_m = a.sigma_k_per_m * z_m * z_m, tilt2 = cosine * cosine,
                 across_m = range_m * a.sigma_angle_rad;
    variances_.push_back(a.sigma0_m * a.sigma0_m + far_m * far_m +
                         ((1 - tilt2) * across_m * across_m + a.surface_sigma_m * a.surface_sigma_m) / tilt2);
  }

  std::unique_ptr<sim::RayCaster> surface_;
  std::vector<Vec3> rays_;
  std::vector<double> ranges_m_, variances_;
  std::vector<DenseVector> gradients_;
  Dense covariance_;
};

struct Fixture {
  BudgetAssumptions a = assumptions();
  Mesh mesh = box();
  Peer peer{mesh, a, random_rays(3, 400)};
  BudgetTarget target{mesh};
  StandResponse stand = target.stand(a, generic_pose(), std::vector<std::vector<Vec3>>{peer.rays()});
};

TEST(Budget, CommonErrorsGiveWhatAnEstimatorOfItsOwnMakesOfThem) {
  VERIFIES("LASSO-MDT-122~1");
  const Fixture f;
  ASSERT_TRUE(f.stand.defined);
  std::vector<double> common;
  for (const double r : f.peer.ranges_m()) common.push_back(f.a.sensor.common_sigma_m + f.a.sensor.common_sigma_k_per_m * r * r);
  const auto [z_m, turn_rad] = f.peer.errors(common);
  EXPECT_NEAR(f.stand.z_m.range, z_m, 1e-4 * std::fabs(z_m));
  EXPECT_NEAR(f.stand.turn_rad.range, turn_rad, 1e-4 * std::fabs(z_m));
  const auto surface = sim::make_ray_caster(f.mesh.vertices, f.mesh.triangles);
  for (int axis = 0; axis < 3; ++axis) {  // the simulated scanner measures along the ray turned back, and reports it as it should be
    const Quat back = exp_so3(-1e-6 * Vec3::Unit(axis));
    std::vector<double> turned;
    for (std::size_t i = 0; i < f.peer.rays().size(); ++i)
      turned.push_back((range_of(*surface, generic_pose(), rotate(back, f.peer.rays()[i])) - f.peer.ranges_m()[i]) * 1e6 *
                       f.a.sensor.common_sigma_rad);
    const auto [z_turned_m, turn_turned_rad] = f.peer.errors(turned);
    EXPECT_NEAR(f.stand.z_m.turn[axis], z_turned_m, 1e-3 * f.stand.z_m.turn.norm());
    EXPECT_NEAR(f.stand.turn_rad.turn[axis], turn_turned_rad, 1e-3 * f.stand.turn_rad.turn.norm());
  }
}

TEST(Budget, AVertexThatIsOffGivesWhatItsMeshDoes) {
  VERIFIES("LASSO-MDT-122~1");
  const Fixture f;
  EXPECT_EQ(f.target.places(), 8U) << "vertices of one place move together";
  constexpr double kOff = 1e-6;
  Dense seen = Dense::Zero(2, 3);
  for (int axis = 0; axis < 3; ++axis) {
    Mesh off = f.mesh;
    const Vec3 corner = f.mesh.vertices.front();
    for (Vec3& vertex : off.vertices) {
      if ((vertex - corner).norm() < 1e-9) vertex[axis] += kOff;
    }
    const auto surface = sim::make_ray_caster(off.vertices, off.triangles);
    std::vector<double> errors;
    for (std::size_t i = 0; i < f.peer.rays().size(); ++i)
      errors.push_back((range_of(*surface, generic_pose(), f.peer.rays()[i]) - f.peer.ranges_m()[i]) / kOff);
    const auto [z, turn] = f.peer.errors(errors);
    seen(0, axis) = z;
    seen(1, axis) = turn;
    EXPECT_NEAR(f.stand.z_m.places.front()[axis], z, 2e-3);
    EXPECT_NEAR(f.stand.turn_rad.places.front()[axis], turn, 2e-3);
  }
  EXPECT_GT(seen.norm(), 0.05) << "the corner is seen";
}

TEST(Budget, WhatRaysDoEachForThemselvesIsWhatDrawsShow) {
  VERIFIES("LASSO-MDT-122~1");
  const Fixture f;
  const auto surface = sim::make_ray_caster(f.mesh.vertices, f.mesh.triangles);
  test::Generator random(11);
  constexpr int kDraws = 1500;
  double noise_z = 0, noise_turn = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<double> errors;
    for (std::size_t i = 0; i < f.peer.rays().size(); ++i)
      errors.push_back(random.normal() * sim::range_sigma_m(f.a.sensor, f.peer.ranges_m()[i] * f.peer.rays()[i].z()));
    const auto [z, turn] = f.peer.errors(errors);
    noise_z += z * z / kDraws;
    noise_turn += turn * turn / kDraws;
  }
  constexpr double kWithin = 0.15;  // four sigma of a variance from so many draws
  EXPECT_NEAR(noise_z / f.stand.z_m.noise, 1, kWithin);
  EXPECT_NEAR(noise_turn / f.stand.turn_rad.noise, 1, kWithin);
}

TEST(Budget, PointingOfRaysIsWhatDrawsShow) {
  VERIFIES("LASSO-MDT-122~1");
  Fixture f;
  const auto surface = sim::make_ray_caster(f.mesh.vertices, f.mesh.triangles);
  test::Generator random(12);
  constexpr int kDraws = 600;
  constexpr double kSmall = 1e-3;  // of the pointing noise, so that no ray leaves its face
  double z2 = 0, turn2 = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<double> errors;
    for (std::size_t i = 0; i < f.peer.rays().size(); ++i) {
      const Vec3& u = f.peer.rays()[i];
      const Vec3 right = Vec3::UnitY().cross(u).normalized();
      const double x = random.normal();
      const Vec3 off = f.a.sensor.sigma_angle_rad * (x * right + random.normal() * u.cross(right));
      errors.push_back((range_of(*surface, generic_pose(), (u + kSmall * off).normalized()) - f.peer.ranges_m()[i]) / kSmall);
    }
    const auto [z, turn] = f.peer.errors(errors);
    z2 += z * z / kDraws;
    turn2 += turn * turn / kDraws;
  }
  EXPECT_NEAR(z2 / f.stand.z_m.pointing, 1, 0.23);  // four sigma
  EXPECT_NEAR(turn2 / f.stand.turn_rad.pointing, 1, 0.23);
}

TEST(Budget, TheMeanOfScansHasLessNoiseAndLostRaysMore) {
  VERIFIES("LASSO-MDT-122~1");
  Fixture f;
  const std::vector<std::vector<Vec3>> twice = {f.peer.rays(), f.peer.rays()};
  f.a.scans = 50;
  f.a.sensor.dropout_probability = 0.2;
  const StandResponse mean = f.target.stand(f.a, generic_pose(), twice);
  EXPECT_NEAR(mean.z_m.noise, f.stand.z_m.noise / 50 / 0.8, 1e-12 * f.stand.z_m.noise);
  EXPECT_NEAR(mean.turn_rad.pointing, f.stand.turn_rad.pointing / 50 / 0.8, 1e-12 * f.stand.turn_rad.pointing);
  EXPECT_NEAR(mean.z_m.range, f.stand.z_m.range, 1e-12);
  EXPECT_LT((mean.z_m.turn - f.stand.z_m.turn).norm(), 1e-12);
}

TEST(Budget, StandsShareTheMockUpAndNothingElse) {
  VERIFIES("LASSO-MDT-122~1");
  const Fixture f;
  const Variances alone = variances_of(f.stand.z_m, f.a.vertex_sigma_m),
                  same = variances_between(f.stand.z_m, f.stand.z_m, f.a.vertex_sigma_m);
  EXPECT_EQ(same[static_cast<std::size_t>(BudgetSource::kMockUp)], 0) << "the same stand sees the same mock-up";
  for (const BudgetSource source : {BudgetSource::kNoise, BudgetSource::kPointing, BudgetSource::kCalibration})
    EXPECT_NEAR(same[static_cast<std::size_t>(source)], 2 * alone[static_cast<std::size_t>(source)], 1e-18);
  double places = 0;
  for (const Vec3& place : f.stand.z_m.places) places += place.squaredNorm();
  EXPECT_NEAR(alone[static_cast<std::size_t>(BudgetSource::kMockUp)], 4e-6 * places, 1e-15);
  EXPECT_NEAR(total(alone), alone[0] + alone[1] + alone[2] + alone[3], 1e-18);
}

TEST(Budget, AScanOfOneFaceLeavesItOpen) {
  VERIFIES("LASSO-MDT-122~1");
  const BudgetTarget target(box());
  const Pose ahead{Quat(1, 0, 0, 0), Vec3(0, 0, 3)};
  std::vector<Vec3> rays;
  for (int i = 0; i < 20; ++i) rays.push_back(Vec3(0.002 * i, 0.01 - 0.001 * i * i / 10, 1).normalized());
  EXPECT_FALSE(target.stand(assumptions(), ahead, std::vector<std::vector<Vec3>>{rays}).defined);
}

}  // namespace
}  // namespace lasso::mdat
