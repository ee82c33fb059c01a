#include "mdat/missiondb/guesses.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "fsw/mission/image_format.hpp"
#include "fsw/pose/recognition/search_limits.hpp"
#include "mdat/missiondb/scenario_writer.hpp"

namespace lasso::mdat {
namespace {

constexpr double kLargeCraft_m = 110;  // the International Space Station is 109 m wide
constexpr double kSmallCraft_m = 0.1;  // a CubeSat's unit

std::string text(double value) { return number_text(rounded(value)); }

std::string length_text(const Eigen::Vector3d& v) { return text(v.x()) + " x " + text(v.y()) + " x " + text(v.z()) + " m"; }

double preset(const std::string& key) { return find_row(flight_rows(), key)->preset[0]; }

std::string size_line(const Known& known) {
  const double largest_m = known.mission.size.largest_m;
  const std::string scale = number_text(known.mission.scale);
  std::string line = "size: " + length_text(known.mission.size.sides) + ", by --scale " + scale;
  if (largest_m > kLargeCraft_m)
    return line + ": large for a spacecraft: in millimetres? --scale " + number_text(rounded(0.001 * known.mission.scale)) + " makes it " +
           text(0.001 * largest_m) + " m";
  if (largest_m < kSmallCraft_m)
    return line + ": small for a spacecraft: another --scale may be needed; the file's lengths times it are metres";
  return line;
}

std::string place_text(const Eigen::Vector3d& p) {
  const std::vector<double> list = list_of(p);
  return "(" + number_text(list[0]) + ", " + number_text(list[1]) + ", " + number_text(list[2]) + ") m";
}

std::string origin_line(const Known& known) {
  const NewMission& mission = known.mission;
  if (!mission.origin_m.isZero())
    return "origin: the mesh lies far from its file's origin, about " + place_text(mission.origin_m) +
           ": poses, of recorded scans too, are of that point (target.origin_m)";
  if (mission.size.center.isZero()) return "";
  return "origin: the file's; the mesh lies about " + place_text(mission.size.center) + ", where the scenarios turn it (center_m)";
}

std::string sensor_line(const Known& known) {
  const double range_m = initial_range_m(known.mission.size);
  const RangeNoise noise = guessed_noise(known.mission.size, known.mission.sensor);
  const double sigma_m = std::hypot(noise.sigma0_m, noise.sigma_k_per_m * range_m * range_m);
  return std::string("sensor: ") +
         (noise.kind == SensorKind::kLaserCamera  ? "a laser camera"
          : noise.kind == SensorKind::kFlashLidar ? "a flash LIDAR (flash_lidar)"
                                                  : "a LIDAR (time_of_flight)") +
         " with a field of " + number_text(2 * preset("sensor.fov_half_x_deg")) + " deg, the target at " + text(range_m) +
         " m; its noise there, " + text(1000 * sigma_m) + " mm, is a guess: write your sensor's into [sensor]";
}

std::string surface_line(const Known& known) {
  const std::string share = text(100 * known.surface.regular_share) + " % of its triangles are flat or alike";
  const std::string sigma = text(known.mission.surface_sigma_m) + " m";
  if (known.surface.measured())
    return "surface: measured (" + share + "); estimation.surface_sigma_m is its roughness, " + sigma + ": write how well you know it";
  return "surface: drawn (" + share + "); estimation.surface_sigma_m = " + sigma +
         " says that the target is built so: write how far it may differ (blankets: centimetres)";
}

std::string coarser_line(const Known& known) {
  if (!known.coarser) return "";
  return "mesh: " + std::to_string(known.coarser->mesh.triangles.size()) + " triangles of " +
         std::to_string(known.coarser->triangles_before) + "; their error, " + text(known.coarser->rms_m) + " m rms and " +
         text(known.coarser->worst_m) + " m at most, is in estimation.surface_sigma_m";
}

// The model's best near-symmetry in words, from the table's first record.
std::string turn_text(const ModelTables& tables) {
  const auto number = [&](std::size_t i) {
    return std::ldexp(static_cast<double>(static_cast<std::int32_t>(tables[TableId::kSymmetries].at(i))), -kUnitFractionBits);
  };
  const Eigen::AngleAxisd turn(Eigen::Quaterniond(number(3), number(0), number(1), number(2)).normalized());
  const auto tenth = [&](int i) { return number_text(std::round(10 * turn.axis()[i]) / 10 + 0.0); };
  std::string axis = "(" + tenth(0) + ", " + tenth(1) + ", " + tenth(2) + ")";
  constexpr double kNearAxis = 0.98;
  for (int i = 0; i < 3; ++i) {
    if (std::fabs(turn.axis()[i]) > kNearAxis) axis = std::string("the ") + "xyz"[i] + " axis";
  }
  return number_text(std::round(turn.angle() * 180 / std::numbers::pi)) + " deg about " + axis;
}

std::string symmetry_line(const Known& known) {
  constexpr double kSame = 0.1;
  const CompileReport& report = known.report;
  if (report.symmetries == 0) return "symmetry: no turn brings the target near itself: a search tells its attitude";
  const std::string turns = "at least " + std::to_string(report.symmetries) + (report.symmetries == 1 ? " turn brings" : " turns bring");
  if (report.symmetry_mismatch < kSame)
    return "symmetry: " + turns + " the target on itself, such as " + turn_text(known.tables) +
           ": a search cannot tell these poses apart and stays ambiguous: start from a pose that says which";
  return "symmetry: " + turns + " the target near itself, the best is " + turn_text(known.tables) +
         ": a search needs views that show the difference, and refuses others as ambiguous";
}

std::string parts_line(const Known& known) {
  const double spacing_m = known.mission.size.largest_m / std::sqrt(preset("scan.points"));
  const auto small = std::count_if(known.widths_m.begin(), known.widths_m.end(), [&](double width_m) { return width_m < spacing_m; });
  if (small == 0) return "";
  return "parts: " + std::to_string(small) + " of " + std::to_string(known.widths_m.size()) + " are narrower than " + text(spacing_m) +
         " m, the distance between rays where the target fills the field: few rays meet them";
}

// The mean area that a convex body shows is a quarter of its surface (Cauchy).
std::string rays_line(const Known& known) {
  const double around_m2 = 4 * known.mission.size.radius_m * known.mission.size.radius_m;
  const double returns = preset("scan.points") * std::min(1.0, known.surface.area_m2 / 4 / around_m2);
  const SearchLimits limits;
  if (returns * limits.scans_max >= limits.hits_min) return "";
  return "rays: of a scan of all around it some " + text(returns) + " of " + number_text(preset("scan.points")) +
         " rays return, and a search of " + std::to_string(limits.scans_max) + " scans needs " + number_text(limits.hits_min) +
         ": start from a pose, or take more scan.points";
}

std::string image_line(const Known& known) {
  return "image: " + text(1e-6 * static_cast<double>(known.report.total_bytes)) + " MB with cells of " +
         number_text(known.mission.cell_size_m) + " m";
}

}  // namespace

double guessed_surface_sigma_m(const MeshSize& size, const SurfaceFacts& surface, const std::optional<Simplified>& coarser) {
  const double as_given_m = surface.measured() ? surface.roughness_m : sized_preset("estimation.surface_sigma_m", size.largest_m);
  return std::hypot(as_given_m, coarser ? coarser->rms_m : 0);
}

std::vector<std::string> guesses(const Known& known) {
  std::vector<std::string> lines = {size_line(known),     origin_line(known), coarser_line(known), surface_line(known), sensor_line(known),
                                    symmetry_line(known), parts_line(known),  rays_line(known),    image_line(known)};
  std::erase(lines, "");
  return lines;
}

}  // namespace lasso::mdat
