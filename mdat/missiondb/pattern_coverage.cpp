#include "mdat/missiondb/pattern_coverage.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "cfg/capacities.hpp"
#include "fsw/geometry/portable_math.hpp"
#include "fsw/sense/pattern.hpp"

namespace lasso::mdat {
namespace {

constexpr std::uint32_t kScans = 6;  // the phase of a Lissajous figure decides how often it covers its own path
constexpr int kAcross = 41;          // points of the raster across the square

struct PointInSquare {
  double x, y;
};

std::vector<PointInSquare> rays_of(const ScanPlan& plan) {
  std::vector<PointInSquare> rays;
  for (PatternGenerator pattern(plan); !pattern.done();) {
    const Vec3 direction = pattern.next();
    rays.push_back({direction.x() / direction.z(), direction.y() / direction.z()});
  }
  return rays;
}

double nearest2(const std::vector<PointInSquare>& rays, double x, double y) {
  double least = 8;
  for (const PointInSquare& ray : rays) least = std::min(least, (ray.x - x) * (ray.x - x) + (ray.y - y) * (ray.y - y));
  return least;
}

// The middle of the raster's cell, -1 to 1.
double middle_of(int cell) { return (cell + 0.5) / kAcross * 2 - 1; }

double gap_of(const ScanPlan& plan) {
  const std::vector<PointInSquare> rays = rays_of(plan);
  double largest2 = 0;
  for (int row = 0; row < kAcross; ++row) {
    for (int column = 0; column < kAcross; ++column) {
      const double x = middle_of(column), y = middle_of(row);
      if (x * x + y * y <= 1) largest2 = std::max(largest2, nearest2(rays, x, y));
    }
  }
  return std::sqrt(largest2);
}

}  // namespace

double pattern_rays(const MissionParameters& parameters) {
  return parameters.points - std::min(std::floor(parameters.aimed_share * parameters.points), static_cast<double>(kMaxAimedRays));
}

ScanPlan pattern_of(const MissionParameters& parameters, std::uint32_t scan_id) {
  ScanPlan plan;
  plan.kind = static_cast<PatternKind>(static_cast<std::uint8_t>(parameters.pattern));
  plan.points = static_cast<std::uint16_t>(pattern_rays(parameters));
  plan.cycles_a = static_cast<std::uint16_t>(parameters.cycles_a);
  plan.cycles_b = static_cast<std::uint16_t>(parameters.cycles_b);
  plan.phase_turns = fractional_part(scan_id * parameters.phase_step_turns);
  plan.half_x = plan.half_y = 1;
  return plan;
}

double largest_gap(const MissionParameters& parameters) {
  double largest = 0;
  for (std::uint32_t scan = 0; scan < kScans; ++scan) {
    const ScanPlan plan = pattern_of(parameters, scan);
    if (validate(plan) == Status::kOk) largest = std::max(largest, gap_of(plan));
  }
  return largest;
}

double even_gap(double points) { return std::sqrt(2 / points); }

}  // namespace lasso::mdat
