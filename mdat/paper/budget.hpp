// The budget of a laboratory test: what its stated assumptions make of the errors, before anything is flown.
//
// A weighted least-squares pose from ranges, linear about the truth: delta = (G^T W G)^-1 G^T W e, e the errors of the ranges, G how they
// change with the pose, W the weights of the estimator. Rows of it (Z; the turn about the target's x axis) times what each source of errors
// does to the ranges are their responses. No estimate is used. Hits alone are counted: contours can only lessen what noise does.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "fsw/geometry/se3.hpp"
#include "hal_sim/ray_caster.hpp"
#include "hal_sim/scanner_model.hpp"
#include "mdat/modelc/mesh.hpp"

namespace lasso::mdat {

struct BudgetAssumptions {
  sim::ScannerModel sensor;   // as it is simulated
  double vertex_sigma_m = 0;  // of the mock-up's vertices, each axis
  double scans = 1;           // of a stand, whose estimates are averaged
  // What the estimator takes for the errors of a range: its weights.
  double sigma0_m = 0, sigma_k_per_m = 0, sigma_angle_rad = 0, surface_sigma_m = 0, incidence_max_rad = 0;
};

enum class BudgetSource : std::uint8_t { kNoise, kPointing, kCalibration, kMockUp };
constexpr std::size_t kBudgetSources = 4;
constexpr const char* kBudgetSourceNames[kBudgetSources] = {"noise", "pointing", "calibration", "mock_up"};
using Variances = std::array<double, kBudgetSources>;  // m^2 or rad^2

// How one figure of a stand answers: the variance that noise and pointing of the rays leave in the mean of its scans; its change with a
// range error in common, and a common turn about each sensor axis, of 1 sigma each; its change with the place of each vertex (per metre).
struct Response {
  double noise = 0, pointing = 0, range = 0;
  Vec3 turn = Vec3::Zero();
  std::vector<Vec3> places;  // by number of the place (BudgetTarget)
};
struct StandResponse {
  bool defined = false;  // false: the scans leave a direction open
  Response z_m, turn_rad;
};

// The variances of a figure by source; and of the difference of two stands, which share the mock-up and nothing else.
Variances variances_of(const Response& response, double vertex_sigma_m);
Variances variances_between(const Response& before, const Response& after, double vertex_sigma_m);
double total(const Variances& variances);

// The model's surface, and which of its vertices move together: those of one place.
class BudgetTarget {
 public:
  explicit BudgetTarget(const Mesh& model);
  // One stand at T_sensor_target; `scans` are the ray directions (unit, sensor frame) of some of its scans, at least one.
  StandResponse stand(const BudgetAssumptions& assumptions, const Pose& T_sensor_target, std::span<const std::vector<Vec3>> scans) const;
  std::size_t places() const { return place_count_; }

 private:
  struct Hit;
  bool hit_of(const BudgetAssumptions& assumptions, const Pose& T_target_sensor, const Vec3& direction, Hit& hit) const;
  std::vector<Hit> hits_of(const BudgetAssumptions& assumptions, const Pose& T_sensor_target, const std::vector<Vec3>& scan) const;
  void add(const BudgetAssumptions& assumptions, const Hit& hit, double weight, double scans, Response& response) const;
  bool add_scan(const BudgetAssumptions& assumptions, const Pose& T_sensor_target, const std::vector<Vec3>& scan, double scans,
                StandResponse& stand) const;

  Mesh mesh_;
  std::unique_ptr<sim::RayCaster> caster_;
  std::vector<std::uint32_t> place_of_;
  std::size_t place_count_ = 0;
};

}  // namespace lasso::mdat
