#include "mdat/missiondb/optics_reader.hpp"

#include "fsw/geometry/portable_math.hpp"

namespace lasso::mdat {
namespace {

constexpr double kSensorHousing_m = 0.01;  // about the origin of a sensor's frame: its optics

ValueRow optics_row(const char* key, const char* unit, double to_si, double minimum, double maximum, double preset, const char* meaning) {
  return number_row(key, unit, ValueKind::kReal, to_si, minimum, maximum, preset, meaning);
}

// A sensor or a camera, and its node.
struct Eye {
  std::string what, node;
};

std::vector<Eye> eyes_of(const MissionSource& source) {
  std::vector<Eye> eyes;
  if (!source.scene.sensor.empty()) eyes.push_back({"the sensors' frame", source.scene.sensor});
  for (const FurtherSensor& sensor : source.further_sensors) {
    if (!sensor.node.empty()) eyes.push_back({"sensor " + sensor.name, sensor.node});
  }
  for (const CameraSource& camera : source.scene.cameras) eyes.push_back({"the camera", camera.node});
  return eyes;
}

}  // namespace

std::vector<ValueRow> with_optics_rows(std::vector<ValueRow> rows) {
  rows.push_back(
      optics_row("lamp.intensity_Wpsr", "W/sr", 1, 0, 1e6, 0,
                 "a lamp that shines along the node's z axis, for pictures and stereo: its light between 400 and 900 nm; 0: off"));
  rows.push_back(optics_row("lamp.half_angle_deg", "deg", kRadPerDeg, 0.1, 180, 180, "of its cone, evenly lit; 180: to all sides"));
  rows.push_back(optics_row("camera.fov_half_x_deg", "deg", kRadPerDeg, 0.1, 80, 20,
                            "a camera for pictures (z ahead, x right, y down): half of its field of view, sideways"));
  rows.push_back(optics_row("camera.fov_half_y_deg", "deg", kRadPerDeg, 0.1, 80, 20, "and up and down"));
  return rows;
}

void read_optics(SceneValues& values, const std::string& node, MissionSource& source) {
  if (values.is_any_written("camera."))
    source.scene.cameras.push_back({node, values.number("camera.fov_half_x_deg"), values.number("camera.fov_half_y_deg")});
  if (!values.is_any_written("lamp.")) return;
  if (!values.is_written("lamp.intensity_Wpsr"))
    return values.complain("lamp.half_angle_deg", "", "is of a lamp: give it lamp.intensity_Wpsr as well");
  source.scene.lamps.push_back({node, values.number("lamp.intensity_Wpsr"), values.number("lamp.half_angle_deg")});
}

void refuse_lamps_in_sensors(const scene::Tree& tree, const MissionSource& source, ProblemList& problems) {
  for (const LampSource& lamp : source.scene.lamps) {
    const std::string key = "node." + lamp.node + ".lamp.intensity_Wpsr";
    if (!(lamp.intensity_Wpsr > 0)) continue;
    for (const Eye& eye : eyes_of(source)) {
      const auto own = tree.find(lamp.node), seeing = tree.find(eye.node);
      if (!own || !seeing || !tree.are_rigid(*own, *seeing)) continue;
      if (tree.state(*own, *seeing, 0).T_a_b.p.norm() >= kSensorHousing_m) continue;
      problems.add(source.origins.at(key), key, "",
                   "a lamp inside of " + eye.what + ", node " + eye.node + ": put it at least " + number_text(kSensorHousing_m) +
                       " m aside; a lamp at the stereo cameras themselves is stereo.lamp_Wpsr");
    }
  }
}

}  // namespace lasso::mdat
