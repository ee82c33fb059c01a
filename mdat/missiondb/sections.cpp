#include "mdat/missiondb/sections.hpp"

#include <iterator>

#include "cfg/capacities.hpp"
#include "fsw/geometry/portable_math.hpp"
#include "hal_sim/scanner_model.hpp"
#include "mdat/missiondb/detector_reader.hpp"
#include "mdat/missiondb/flash_rows.hpp"
#include "mdat/missiondb/laser_safety.hpp"
#include "mdat/missiondb/stereo_presets.hpp"

namespace lasso::mdat {
namespace {

using S = Scenario;
constexpr ValueKind kReal = ValueKind::kReal;
constexpr ValueKind kInteger = ValueKind::kInteger;
constexpr double kDeg = kRadPerDeg;

ValueRow calibration_row() {
  ValueRow row =
      text_row("sensor.calibration", "[^\\x00-\\x1f]+\\.toml",
               "laser_camera: what mdat calibrate found, from the mission's folder or the one above; of several the first holds until "
               "the command select_calibration; none: the sensor has its own");
  row.count_max = kMaxCalibrations;
  return row;
}

ScenarioField field(double S::*member, ValueRow row) { return {std::move(row), member, nullptr}; }

ScenarioField field(double S::*member, ValueRow row, const char* preset_from) {
  row.preset_from = preset_from;
  row.preset.clear();
  return {std::move(row), member, nullptr};
}

ScenarioField field(std::vector<double> S::*member, ValueRow row, std::size_t count_min, std::size_t count_max,
                    std::vector<double> preset) {
  row.kind = ValueKind::kReals;
  row.count_min = count_min;
  row.count_max = count_max;
  row.preset = std::move(preset);
  row.required = row.preset.empty();
  return {std::move(row), nullptr, member};
}

// Whether it has to be written depends on others.
ScenarioField without_need(ScenarioField field) {
  field.row.required = false;
  return field;
}

ValueRow sensor_row() {
  ValueRow row = number_row(
      "sensor.kind", "1", ValueKind::kChoice, 1, 0, 3, 0,
      "laser_camera triangulates; time_of_flight is a LIDAR that scans; flash_lidar measures all its pixels at once; stereo is two "
      "cameras ([stereo], docs/stereo.md). Of these three the presets of sensor.sigma0_m, sensor.sigma_k_per_m, "
      "sensor.sigma_angle_rad (flash_lidar), sensor.range_min_m, sensor.range_max_m and beam_divergence_rad differ from those "
      "shown, and of stereo others, too");
  row.choices = {std::begin(kSensorKindNames), std::end(kSensorKindNames)};
  return row;
}

// Of the flash LIDAR whose values are the presets: 128 x 128 pixels over 30 degrees, the sigma across a ray that of a place within a pixel.
double preset_of_flash(const std::string& key, double preset) {
  const sim::FlashModel flash;
  if (key == "sensor.sigma0_m") return flash.stated_sigma0_m;
  if (key == "sensor.sigma_k_per_m") return flash.stated_sigma_k_per_m;
  if (key == "sensor.sigma_angle_rad") return 1.2e-3;
  if (key == "sensor.range_min_m") return 1;
  if (key == "sensor.range_max_m") return 60;
  return preset;
}

using Q = PartSource;

std::vector<PartField> make_part_fields() {
  // clang-format off
  return {
    {list_row(number_row("box_m", "m", kReal, 1, -1000, 1000, 0, "the part is what of the target lies between x, y, z and x, y, z; this, model or mesh"), 6, {}), nullptr, &Q::box_m},
    {text_row("model", "[^\\x00-\\x1f]+\\.toml", "parametric model (.toml) with its presets, from the mission's folder or the one above"), nullptr, nullptr},
    {text_row("mesh", "[^\\x00-\\x1f]+", "mesh (STL, OBJ, PLY, glTF), from the mission's folder or the one above"), nullptr, nullptr},
    {number_row("scale", "1", kReal, 1, 1e-9, 1e9, 1, "the file's lengths times this are metres"), &Q::scale, nullptr},
    {number_row("cell_size_m", "m", kReal, 1, 0, 10, 0, "cell of the part's look-up field; 0: about 1/110 of the part"), &Q::cell_size_m, nullptr},
    {list_row(number_row("origin_m", "m", kReal, 1, -1000, 1000, 0, "origin of the part's frame in the target's"), 3, {0, 0, 0}), nullptr, &Q::origin_m},
    {list_row(number_row("quaternion", "1", kReal, 1, -1, 1, 0, "x, y, z, w: takes part axes to target axes"), 4, {0, 0, 0, 1}), nullptr, &Q::quaternion},
    {required(list_row(number_row("range_m", "m", kReal, 1, 0, 10000, 0, "nearest and farthest distance of its centre from the sensor at which it serves"), 2, {})), nullptr, &Q::range_m},
    {required(list_row(number_row("view", "1", kReal, 1, -1e6, 1e6, 0, "direction in part axes towards the sensors that see it, of any length"), 3, {})), nullptr, &Q::view},
    {number_row("cone_deg", "deg", kReal, kDeg, 0, 180, 60, "largest angle between it and the direction to the sensor"), &Q::cone_rad, nullptr},
    {number_row("priority", "1", kReal, 1, 0.001, 1000, 1, "weighs what a scan of the part would tell; the part of lower priority goes where two disagree"), &Q::priority, nullptr},
  };
  // clang-format on
}

std::vector<ScenarioField> make_scenario_fields() {
  // clang-format off
  return {
    without_need(field(&S::ranges_m, number_row("ranges_m", "m", kReal, 1, 0.01, 10000, 0, "ranges of the target's center_m along the boresight, one run each, or with times_s one run; none: the target is where the mission's nodes move it"), 1, 100, {})),
    field(&S::frames, number_row("frames", "1", kInteger, 1, 1, 1000000, 360, "frames of a run")),
    field(&S::step_rad, number_row("step_deg", "deg", kReal, kDeg, -180, 180, 0, "turn about the target's x axis from frame to frame; it stands still in each scan")),
    field(&S::tilt_rad, number_row("tilt_deg", "deg", kReal, kDeg, -180, 180, 15, "tilt of the target's -x end towards the sensor; 0 is side-on")),
    field(&S::boresight_rad, number_row("boresight_deg", "deg", kReal, kDeg, -180, 180, 5, "turn of the target about the boresight")),
    field(&S::roll_rad, number_row("roll_deg", "deg", kReal, kDeg, -180, 180, 0, "turn of the target about its own x axis, before tilt and boresight")),
    field(&S::drawn, number_row("drawn", "1", ValueKind::kBoolean, 1, 0, 1, 0, "attitude of frame 0, and axes of spin and drift, are drawn at random for each run; rates as large as given")),
    field(&S::variants, number_row("variants", "1", ValueKind::kBoolean, 1, 0, 1, 0, "flown also without noise, from hits alone, with aimed rays, and side-on, and compared with a bound, as the paper does; of a target that stands still in each scan")),
    field(&S::paper_table, number_row("paper_table", "1", ValueKind::kBoolean, 1, 0, 1, 0, "with variants: results stand beside the paper's table 1, which is of a tenth-scale Hubble")),
    field(&S::offset_m, number_row("offset_m", "m", kReal, 1, -10000, 10000, 0, "target's center_m off the boresight: right, down"), 2, 2, {0.02, -0.01}),
    field(&S::center_m, number_row("center_m", "m", kReal, 1, -1000, 1000, 0, "point of the target, in its own frame, that ranges_m and offset_m are of, and about which it turns"), 3, 3, {0, 0, 0}),
    field(&S::spin_radps, number_row("spin_degps", "deg/s", kReal, kDeg, -360, 360, 0, "angular rate about the target's x, y, z"), 3, 3, {0, 0, 0}),
    field(&S::drift_mps, number_row("drift_mps", "m/s", kReal, 1, -100, 100, 0, "velocity along the sensor's x, y, z"), 3, 3, {0, 0, 0}),
    without_need(field(&S::times_s, number_row("times_s", "s", kReal, 1, 0, 1e6, 0, "when the target is at each of ranges_m, at rest; none: it stays at each"), 1, 100, {})),
    field(&S::eclipse_s, number_row("eclipse_s", "s", kReal, 1, 0, 1e6, 0, "nothing returns from the first of these times to the second"), 2, 2, {0, 0}),
    field(&S::autonomous, number_row("autonomous", "1", ValueKind::kBoolean, 1, 0, 1, 0, "the component is told once to seek the bearing, and does all else by itself; navigation_* says which help it has")),
    field(&S::navigation_from_s, number_row("navigation_from_s", "s", kReal, 1, 0, 1e6, 0, "autonomous: from then on a navigation system offers poses to start from")),
    field(&S::navigation_period_s, number_row("navigation_period_s", "s", kReal, 1, 0.001, 1e6, 1, "autonomous: how often")),
    field(&S::navigation_sigma_m, number_row("navigation_sigma_m", "m", kReal, 1, 1e-6, 100, 0.1, "autonomous: their error, each axis (1 sigma)")),
    field(&S::navigation_sigma_rad, number_row("navigation_sigma_deg", "deg", kReal, kDeg, 1e-4, 180, 2, "autonomous: error of their attitude, each axis (1 sigma)")),
    field(&S::prior, number_row("prior", "1", ValueKind::kBoolean, 1, 0, 1, 1, "false: no pose to start from is given; the component seeks the bearing first")),
    field(&S::prior_turn_rad, number_row("prior_turn_deg", "deg", kReal, kDeg, -180, 180, 0, "the pose to start from is turned by this rotation vector about the target's x, y, z: a wrong start"), 3, 3, {0, 0, 0}),
    field(&S::prior_shift_m, number_row("prior_shift_m", "m", kReal, 1, -1000, 1000, 0, "the pose to start from is off by this, along the sensor's x, y, z"), 3, 3, {0, 0, 0}),
    field(&S::model_scale, number_row("model_scale", "1", kReal, 1, 0.1, 10, 1, "the simulated target is larger than the model that the component has, about the target's origin")),
    field(&S::model_vertex_sigma_m, number_row("model_vertex_sigma_m", "m", kReal, 1, 0, 10, 0, "its vertices are off at random (1 sigma, each axis)")),
    field(&S::model_turned_box_m, number_row("model_turned_box_m", "m", kReal, 1, -1000, 1000, 0, "a part is turned by model_turn_deg: triangles with their centres between x, y, z and x, y, z; zeros: none"), 6, 6, {0, 0, 0, 0, 0, 0}),
    field(&S::model_turn_rad, number_row("model_turn_deg", "deg", kReal, kDeg, -180, 180, 0, "rotation vector of that part about the middle of its box, in the target's axes"), 3, 3, {0, 0, 0}),
    field(&S::model_gone_box_m, number_row("model_gone_box_m", "m", kReal, 1, -1000, 1000, 0, "a part is not there: triangles with their centres between x, y, z and x, y, z; zeros: none"), 6, 6, {0, 0, 0, 0, 0, 0}),
    field(&S::noise, number_row("noise", "1", ValueKind::kBoolean, 1, 0, 1, 1, "false: the simulated sensor measures ranges and angles without noise")),
    field(&S::noise_factor, number_row("noise_factor", "1", kReal, 1, 0, 100, 1, "simulated range noise over what the next two say")),
    field(&S::sigma0_m, number_row("sigma0_m", "m", kReal, 1, 0, 1, 0, "simulated range noise, constant part (1 sigma)"), "sensor.sigma0_m"),
    field(&S::sigma_k_per_m, number_row("sigma_k_per_m", "1/m", kReal, 1, 0, 0.01, 0, "simulated range noise that grows with the square of the range"), "sensor.sigma_k_per_m"),
    field(&S::angle_noise_rad, number_row("angle_noise_rad", "rad", kReal, 1, 0, 0.01, 0, "simulated pointing noise of a ray (1 sigma, each axis)"), "sensor.sigma_angle_rad"),
    field(&S::dropout_probability, number_row("dropout_probability", "1", kReal, 1, 0, 0.9, 0, "share of the simulated rays on the target that do not return"), "sensor.dropout_probability"),
    field(&S::common_sigma_m, number_row("common_sigma_m", "m", kReal, 1, 0, 1, 0, "simulated range error that all rays of a scan have in common (1 sigma)"), "sensor.common_sigma_m"),
    field(&S::common_sigma_k_per_m, number_row("common_sigma_k_per_m", "1/m", kReal, 1, 0, 0.01, 0, "added to it, times the square of the range"), "sensor.common_sigma_k_per_m"),
    field(&S::common_sigma_rad, number_row("common_sigma_deg", "deg", kReal, kDeg, 0, 10, 0, "simulated turn that all rays of a scan have in common (1 sigma, each axis)"), "sensor.common_sigma_deg"),
    field(&S::common_memory_s, number_row("common_memory_s", "s", kReal, 1, 0, 1e6, 0, "time in which the correlation of simulated common errors falls to 1/e; 0: new in each scan"), "sensor.common_memory_s"),
    field(&S::dropout_incidence_rad, number_row("dropout_incidence_deg", "deg", kReal, kDeg, 0, 90, 90, "simulated rays that graze the surface more than this do not return")),
    field(&S::outlier_probability, number_row("outlier_probability", "1", kReal, 1, 0, 0.9, 0, "share of the simulated returns with a wrong range")),
    field(&S::edge_mixing_m, number_row("edge_mixing_m", "m", kReal, 1, 0, 1, 0, "simulated rays this near an edge return a range between both sides")),
    field(&S::beam_divergence_rad, number_row("beam_divergence_rad", "rad", kReal, 1, 0, 0.1, 0, "growth of that distance with the range")),
    field(&S::seed, number_row("seed", "1", kInteger, 1, 0, 4294967295.0, 1, "start of the random numbers")),
  };
  // clang-format on
}

std::vector<ValueRow> make_mission_rows() {
  // clang-format off
  std::vector<ValueRow> rows = {
    required(number_row("mission.id", "1", kInteger, 1, 1, 2147483648.0, 0, "number of the mission in telemetry")),
    required(number_row("mission.version", "1", kInteger, 1, 1, 2147483648.0, 0, "counts up with every change that flies")),
    required(text_row("mission.name", "[^\\x00-\\x1f]{1,80}", "name in reports, at most 80 characters")),
    text_row("target.model", "[^\\x00-\\x1f]+\\.toml", "parametric model (.toml), from the mission's folder or the one above; this or target.mesh"),
    text_row("target.mesh", "[^\\x00-\\x1f]+", "mesh (STL, OBJ, PLY, glTF), from the mission's folder or the one above; this or target.model"),
    text_row("target.sha256", "[0-9a-fA-F]{64}", "SHA-256 of that file, 64 hexadecimal digits"),
    number_row("target.scale", "1", kReal, 1, 1e-9, 1e9, 1, "the file's lengths times this are metres"),
    list_row(number_row("target.origin_m", "m", kReal, 1, -1e7, 1e7, 0, "the target's origin in the file's axes, after scale: poses are of this point"), 3, {0, 0, 0}),
    number_row("target.crease_angle_deg", "deg", kReal, kDeg, 0, 90, 30, "facets that meet at a smaller angle are one smooth surface"),
    number_row("target.cell_size_m", "m", kReal, 1, 1e-5, 10, 0.012, "cell of the look-up field: about 1/110 of the target is fastest; larger takes less memory"),
    sensor_row(),
    calibration_row(),
  };
  // clang-format on
  rows.insert(rows.end(), flash_rows().begin(), flash_rows().end());
  rows.insert(rows.end(), laser_safety_rows().begin(), laser_safety_rows().end());
  for (const DetectorField& field : detector_fields()) {
    rows.push_back(field.row);
    rows.back().key = "sensor." + field.row.key;
  }
  return rows;
}

}  // namespace

const std::vector<ValueRow>& mission_rows() {
  static const std::vector<ValueRow> rows = make_mission_rows();
  return rows;
}

double preset_of(SensorKind sensor, const std::string& key, double preset) {
  if (sensor == SensorKind::kFlashLidar) return preset_of_flash(key, preset);
  if (sensor == SensorKind::kStereo) return stereo_preset(key, preset);
  if (sensor != SensorKind::kTimeOfFlight) return preset;
  const sim::ScannerModel lidar = sim::time_of_flight_lidar();
  if (key == "sensor.sigma0_m") return lidar.sigma0_m;
  if (key == "sensor.sigma_k_per_m") return lidar.sigma_k_per_m;
  if (key == "sensor.range_min_m") return lidar.range_min_m;
  if (key == "sensor.range_max_m") return lidar.range_max_m;
  if (key == "beam_divergence_rad") return lidar.beam_divergence_rad;
  return preset;
}

const std::vector<PartField>& part_fields() {
  static const std::vector<PartField> fields = make_part_fields();
  return fields;
}

const std::vector<ValueRow>& part_rows() {
  static const std::vector<ValueRow> rows = [] {
    std::vector<ValueRow> result;
    for (const PartField& entry : part_fields()) result.push_back(entry.row);
    return result;
  }();
  return rows;
}

const std::vector<ScenarioField>& scenario_fields() {
  static const std::vector<ScenarioField> fields = make_scenario_fields();
  return fields;
}

const std::vector<ValueRow>& scenario_rows() {
  static const std::vector<ValueRow> rows = [] {
    std::vector<ValueRow> result;
    for (const ScenarioField& entry : scenario_fields()) result.push_back(entry.row);
    return result;
  }();
  return rows;
}

}  // namespace lasso::mdat
