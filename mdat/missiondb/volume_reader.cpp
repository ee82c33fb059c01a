#include "mdat/missiondb/volume_reader.hpp"

#include "fsw/geometry/portable_math.hpp"

namespace lasso::mdat {
namespace {

ValueRow cloud_row(const char* key, const char* unit, double to_si, double minimum, double maximum, double preset, const char* meaning) {
  return number_row(key, unit, ValueKind::kReal, to_si, minimum, maximum, preset, meaning);
}

ValueRow shape_row() {
  ValueRow row = number_row("scatter.shape", "1", ValueKind::kChoice, 1, 0, 1, 0,
                            "a cloud that scatters lasers' light: a sphere about the node, or a cone from there along its z axis");
  row.choices = {"sphere", "cone"};
  return row;
}

}  // namespace

std::vector<ValueRow> with_volume_rows(std::vector<ValueRow> rows) {
  rows.push_back(shape_row());
  rows.push_back(cloud_row("scatter.extinction_per_m", "1/m", 1, 0, 1e6, 0, "share of the light that it takes away a metre, in its core"));
  rows.push_back(cloud_row("scatter.radius_m", "m", 1, 0, 1e6, 0, "of the sphere"));
  rows.push_back(cloud_row("scatter.half_angle_deg", "deg", kRadPerDeg, 0, 89, 0, "of the cone"));
  rows.push_back(cloud_row("scatter.length_m", "m", 1, 0, 1e6, 0, "of the cone"));
  rows.push_back(cloud_row("scatter.core_m", "m", 1, 0, 1e6, 0,
                           "distance from the node up to which it is even; from there on it thins with the square; 0: even"));
  rows.push_back(cloud_row("scatter.lidar_ratio_sr", "sr", 1, 0.1, 1e4, 40, "extinction over backscatter: what it sends back"));
  return rows;
}

void read_volume(SceneValues& values, const std::string& node, MissionSource& source) {
  sim::ScatterVolume volume;
  volume.shape = static_cast<sim::ScatterShape>(static_cast<int>(values.number("scatter.shape")));
  const bool cone = volume.shape == sim::ScatterShape::kCone;
  volume.extinction_per_m = values.number("scatter.extinction_per_m");
  volume.radius_m = values.number("scatter.radius_m");
  volume.half_angle_rad = values.number("scatter.half_angle_deg");
  volume.length_m = values.number("scatter.length_m");
  volume.core_m = values.number("scatter.core_m");
  if (volume.core_m == 0) volume.core_m = cone ? volume.length_m : volume.radius_m;
  volume.lidar_ratio_sr = values.number("scatter.lidar_ratio_sr");
  const auto need = [&](bool is_needed, const char* key) {
    const double value = values.number(key);
    if (is_needed == (value > 0)) return true;
    values.complain(key, number_text(value),
                    is_needed ? "expected more than 0" : std::string("has no effect on a ") + (cone ? "cone" : "sphere"));
    return false;
  };
  bool right = need(true, "scatter.extinction_per_m");
  right = need(!cone, "scatter.radius_m") && right;
  right = need(cone, "scatter.half_angle_deg") && right;
  right = need(cone, "scatter.length_m") && right;
  if (right) source.scene.volumes.push_back({node, std::make_shared<const sim::ScatterVolume>(volume)});
}

}  // namespace lasso::mdat
