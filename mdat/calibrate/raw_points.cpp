#include "mdat/calibrate/raw_points.hpp"

#include <charconv>
#include <cmath>
#include <fstream>

#include "hal_sim/lcs_device.hpp"
#include "hal_sim/random.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

constexpr char kHeader[] = "plane_nx,plane_ny,plane_nz,plane_d_m,temperature_degC,angle_x_rad,angle_y_rad,peak";
constexpr int kColumns = 8;
constexpr int kTemperatures = 3;
constexpr double kTilt_rad = 0.5;
constexpr double kUnitTolerance = 1e-6;

RawPoint point_of(const std::string& line, const std::string& place) {
  double values[kColumns];
  const char* at = line.data();
  const char* const end = line.data() + line.size();
  for (int i = 0; i < kColumns; ++i) {
    const auto [next, error] = std::from_chars(at, end, values[i]);
    const bool last = i == kColumns - 1;
    if (error != std::errc() || !std::isfinite(values[i]) || (last ? next != end : next == end || *next != ',')) {
      throw InputError(place + ": expected " + std::to_string(kColumns) + " numbers: " + kHeader);
    }
    at = next + (last ? 0 : 1);
  }
  RawPoint point{Vec3(values[0], values[1], values[2]), values[3], values[4], values[5], values[6], values[7]};
  if (std::abs(point.normal.norm() - 1) > kUnitTolerance)
    throw InputError(place + ": the plane's normal is not of unit length: normalise it");
  point.normal.normalize();
  return point;
}

// To the nearest step of the wire.
double on_wire(double value) { return std::round(std::ldexp(value, 23)) / std::ldexp(1.0, 23); }

}  // namespace

std::vector<RawPoint> read_raw_points(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  if (!in || !std::getline(in, line)) throw InputError(file.string() + ": cannot be read, or is empty");
  if (line != kHeader) throw InputError(file.string() + ":1: expected the header " + kHeader);
  std::vector<RawPoint> points;
  for (int number = 2; std::getline(in, line); ++number) points.push_back(point_of(line, file.string() + ":" + std::to_string(number)));
  return points;
}

std::string raw_points_text(const std::vector<RawPoint>& points) {
  std::string text(kHeader);
  text += '\n';
  for (const RawPoint& p : points) {
    text += format("%.12g,%.12g,%.12g,%.12g,%.6g,%.9f,%.9f,%.9f\n", p.normal.x(), p.normal.y(), p.normal.z(), p.distance_m,
                   p.temperature_degC, p.angle_x_rad, p.angle_y_rad, p.peak);
  }
  return text;
}

std::vector<RawPoint> simulate_planes(const lcs::Calibration& truth, const PlaneRun& run) {
  std::vector<RawPoint> points;
  sim::Random random(run.seed);
  for (int i = 0; i < run.planes * kTemperatures; ++i) {
    RawPoint plane;
    const int place = i / kTemperatures;
    const double share = static_cast<double>(place) / (run.planes - 1);
    plane.temperature_degC =
        run.temperature_min_degC + (run.temperature_max_degC - run.temperature_min_degC) * (i % kTemperatures) / (kTemperatures - 1.0);
    plane.normal = Vec3(std::tan(random.uniform(-kTilt_rad, kTilt_rad)), std::tan(random.uniform(-kTilt_rad, kTilt_rad)), 1).normalized();
    plane.distance_m = plane.normal.z() * run.depth_min_m * std::pow(run.depth_max_m / run.depth_min_m, share);
    for (int ray = 0; ray < run.rays; ++ray) {
      const double x = random.uniform(-run.angle_max_rad, run.angle_max_rad), y = random.uniform(-run.angle_max_rad, run.angle_max_rad);
      const Vec3 direction = Vec3(std::tan(x), std::tan(y), 1).normalized();
      const double range_m = plane.distance_m / plane.normal.dot(direction);
      const double z_m = range_m * direction.z();
      const double measured_m = range_m + run.sigma_k_per_m * z_m * z_m * random.gaussian();
      const lcs::RawSample raw = sim::raw_sample(truth, plane.temperature_degC, direction, measured_m);
      if (std::abs(raw.peak) >= 1) continue;  // beside the detector
      plane.angle_x_rad = on_wire(raw.angle_x_rad);
      plane.angle_y_rad = on_wire(raw.angle_y_rad);
      plane.peak = on_wire(raw.peak);
      points.push_back(plane);
    }
  }
  return points;
}

}  // namespace lasso::mdat
