#include "mdat/missiondb/stereo_reader.hpp"

#include "fsw/geometry/portable_math.hpp"

namespace lasso::mdat {
namespace {

using enum ValueKind;

ValueRow direction_row(const char* key, const std::vector<double>& preset, const char* meaning) {
  return list_row(number_row(key, "1", kReal, 1, -1e6, 1e6, 0, meaning), 3, preset);
}

ValueRow model_row() {
  ValueRow row =
      number_row("model", "1", kChoice, 1, 0, 1, 0,
                 "of sensors of the kind stereo: rendered pairs, which are matched (seconds a frame, OpenCV), or ranges by errors "
                 "that were fitted to such pairs (milliseconds)");
  row.choices = {std::begin(kStereoModelNames), std::end(kStereoModelNames)};
  return row;
}

std::vector<ValueRow> make_stereo_rows() {
  const StereoSource s;
  // clang-format off
  return {
    model_row(),
    number_row("baseline_m", "m", kReal, 1, 0.001, 100, s.baseline_m, "the right camera stands this far to the right of the left one, whose frame is the sensor's"),
    number_row("pixels", "1", kInteger, 1, 64, 4096, s.pixels, "along the longer side of the field of view"),
    number_row("f_number", "1", kReal, 1, 0.5, 64, s.f_number, "focal length by aperture"),
    number_row("pixel_um", "um", kReal, 1e-6, 0.5, 50, 1e6 * s.pixel_m, "pitch of the detector"),
    number_row("full_well_e", "1", kReal, 1, 100, 1e7, s.full_well_e, "electrons that a pixel holds"),
    number_row("read_noise_e", "1", kReal, 1, 0, 1000, s.read_noise_e, "electrons, 1 sigma"),
    number_row("exposure_s", "s", kReal, 1, 0, 10, s.exposure_s, "0: by the light, 90 % of the lit pixels below 0.6 of the full well, 0.02 to 100 ms"),
    number_row("samples", "1", kInteger, 1, 1, 8, s.samples, "rays of a pixel are this number squared; below 3 what is too fine for a pixel looks like noise"),
    number_row("plain", "1", kBoolean, 1, 0, 1, s.plain, "true: surfaces without relief and shades, the worst case of matching"),
    number_row("lamp_Wpsr", "W/sr", kReal, 1, 0, 1e6, s.lamp_Wpsr, "of a lamp at the left camera, between 400 and 900 nm; 0: none"),
    number_row("earthshine", "1", kBoolean, 1, 0, 1, s.earthshine, "false: Earth's light is left out"),
    direction_row("sun", s.sun, "direction to the sun in the sensor frame where the mission has no orbit; zeros: it is dark"),
    direction_row("earth", s.earth, "the same of the middle of Earth's disc; zeros: none"),
    list_row(number_row("turn_error_deg", "deg", kReal, kRadPerDeg, -10, 10, 0, "the right camera is turned by this rotation vector against its calibration, in its axes"), 3, {0, 0, 0}),
    number_row("baseline_error", "1", kReal, 1, -0.5, 0.5, s.baseline_error, "the baseline is longer than its calibration says, relative"),
  };
  // clang-format on
}

}  // namespace

const std::vector<ValueRow>& stereo_rows() {
  static const std::vector<ValueRow> rows = make_stereo_rows();
  return rows;
}

void read_stereo(const toml::table& root, MissionSource& source, ProblemList& problems) {
  const toml::node* node = root.get("stereo");
  if (node == nullptr) return;
  if (!node->is_table()) return problems.add(*node, "stereo", "wrong type: expected a table [stereo]");
  const SceneValues values(*node->as_table(), "stereo", stereo_rows(), {}, source, problems);
  StereoSource& stereo = source.stereo;
  stereo.model = values.number("model");
  stereo.baseline_m = values.number("baseline_m");
  stereo.pixels = values.number("pixels");
  stereo.f_number = values.number("f_number");
  stereo.pixel_m = values.number("pixel_um");
  stereo.full_well_e = values.number("full_well_e");
  stereo.read_noise_e = values.number("read_noise_e");
  stereo.exposure_s = values.number("exposure_s");
  stereo.samples = values.number("samples");
  stereo.plain = values.number("plain");
  stereo.lamp_Wpsr = values.number("lamp_Wpsr");
  stereo.earthshine = values.number("earthshine");
  stereo.sun = values.list("sun");
  stereo.earth = values.list("earth");
  stereo.turn_error_rad = values.list("turn_error_deg");
  stereo.baseline_error = values.number("baseline_error");
}

}  // namespace lasso::mdat
