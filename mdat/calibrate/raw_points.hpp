// What a laser camera measured of a plane at known places: the raw samples that a calibration is fitted to.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "fsw/geometry/types.hpp"
#include "hal_lcs/triangulation.hpp"

namespace lasso::mdat {

// A return from the plane n.p = d, sensor frame, as the camera measured it.
struct RawPoint {
  Vec3 normal = Vec3::UnitZ();  // of unit length
  double distance_m = 0;
  double temperature_degC = 0;
  double angle_x_rad = 0, angle_y_rad = 0, peak = 0;
};

// CSV with the header plane_nx,plane_ny,plane_nz,plane_d_m,temperature_degC,angle_x_rad,angle_y_rad,peak. Throws InputError or
// sim::ScanFileError that names file and line.
std::vector<RawPoint> read_raw_points(const std::filesystem::path& file);
std::string raw_points_text(const std::vector<RawPoint>& points);

// A plane moved through a simulated camera's volume: `planes` places at each of three temperatures, each tilted otherwise, `rays` rays
// each, with noise sigma_k_per_m z^2 along the ray, rounded as on the wire.
struct PlaneRun {
  double depth_min_m = 1, depth_max_m = 8, angle_max_rad = 0.26;
  double temperature_min_degC = 0, temperature_max_degC = 40;
  double sigma_k_per_m = 0;
  int planes = 16, rays = 300;
  std::uint64_t seed = 1;
};
std::vector<RawPoint> simulate_planes(const lcs::Calibration& truth, const PlaneRun& run);

}  // namespace lasso::mdat
