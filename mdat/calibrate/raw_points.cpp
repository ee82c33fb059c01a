#include "mdat/calibrate/raw_points.hpp"

#include <array>
#include <cmath>

#include "hal_sim/csv_table.hpp"
#include "hal_sim/lcs_device.hpp"
#include "hal_sim/random.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

constexpr char kHeader[] = "plane_nx,plane_ny,plane_nz,plane_d_m,temperature_degC,angle_x_rad,angle_y_rad,peak";
constexpr std::size_t kColumns = 8;
constexpr const char* kNames[kColumns] = {"plane_nx",         "plane_ny",    "plane_nz",    "plane_d_m",
                                          "temperature_degc", "angle_x_rad", "angle_y_rad", "peak"};  // in lower case
constexpr int kTemperatures = 3;
constexpr double kTilt_rad = 0.5;
constexpr double kUnitTolerance = 1e-6;

RawPoint point_of(const sim::CsvTable& table, const std::array<std::size_t, kColumns>& columns) {
  std::array<double, kColumns> v{};
  for (std::size_t i = 0; i < kColumns; ++i) v[i] = table.number(columns[i]);
  RawPoint point{Vec3(v[0], v[1], v[2]), v[3], v[4], v[5], v[6], v[7]};
  if (std::abs(point.normal.norm() - 1) > kUnitTolerance)
    throw InputError(table.place() + ": the plane's normal is not of unit length: normalise it");
  point.normal.normalize();
  return point;
}

// To the nearest step of the wire.
double on_wire(double value) { return std::round(std::ldexp(value, 23)) / std::ldexp(1.0, 23); }

}  // namespace

std::vector<RawPoint> read_raw_points(const std::filesystem::path& file) {
  const std::string text = file_content(file);
  sim::CsvTable table(file.string(), text, kHeader);
  std::array<std::size_t, kColumns> columns{};
  for (std::size_t i = 0; i < kColumns; ++i) columns[i] = table.need({kNames[i]});
  std::vector<RawPoint> points;
  while (table.next()) points.push_back(point_of(table, columns));
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
