#include "mdat/missiondb/detector_reader.hpp"

namespace lasso::mdat {
namespace {

using D = sim::DetectorModel;

constexpr double kLeastThreshold = 3;  // of the electronics' noise: every few rays have a false return there

DetectorField detector_field(double D::*member, const char* key, const char* unit, double to_si, double minimum, double maximum,
                             const char* meaning) {
  const double preset = D{}.*member / to_si;
  return {number_row(key, unit, ValueKind::kReal, to_si, minimum, maximum, preset, meaning), member};
}

ValueRow returns_row() {
  ValueRow row = number_row("detector.returns", "1", ValueKind::kChoice, 1, 0, 3, 0,
                            "which surface in the beam's footprint a range is of; mixed: between them, by the light that each returns");
  row.choices = {"mixed", "first", "last", "strongest"};
  return row;
}

std::vector<DetectorField> make_detector_fields() {
  // clang-format off
  return {
    detector_field(&D::reference_electrons, "detector.reference_electrons", "1", 1, 0, 1e12, "photo-electrons that one sample of the reference surface returns; 0: no detector is simulated, and all surfaces return alike"),
    detector_field(&D::reference_range_m, "detector.reference_range_m", "m", 1, 0.01, 1e5, "range of that surface, which fills the beam at right angles"),
    detector_field(&D::reference_reflectance, "detector.reference_reflectance", "1", 1, 0.001, 1, "what it scatters, alike to all sides"),
    detector_field(&D::noise_electrons, "detector.noise_electrons", "1", 1, 0, 1e9, "noise of the electronics (1 sigma)"),
    detector_field(&D::threshold_electrons, "detector.threshold_electrons", "1", 1, 0, 1e12, "a count below this is no return"),
    detector_field(&D::saturation_electrons, "detector.saturation_electrons", "1", 1, 0, 1e15, "a count above this tells no range; 0: never"),
    detector_field(&D::width_m, "detector.width_m", "m", 1, 0, 100, "width of the pulse as a range (root mean square): the range noise is this over signal-to-noise"),
    detector_field(&D::width_k_per_m, "detector.width_k_per_m", "1/m", 1, 0, 1, "the same of a spot on a triangulating detector: grows with the square of the range"),
    detector_field(&D::bandpass_m, "detector.bandpass_nm", "nm", 1e-9, 0, 1000, "wavelengths that pass the filter; 0: no sunlight"),
    detector_field(&D::energy_J, "detector.energy_uJ", "uJ", 1e-6, 0, 1e6, "laser energy of one sample"),
    detector_field(&D::field_rad, "detector.field_mrad", "mrad", 1e-3, 0, 500, "half angle of the cone from which the receiver takes light"),
    detector_field(&D::gate_s, "detector.gate_us", "us", 1e-6, 0, 1e6, "time for which it gathers the light of one sample"),
    detector_field(&D::glare_per_sr, "detector.glare_per_sr", "1/sr", 1, 0, 1, "scatter in the optics of a Sun at angle a off the ray: radiance over irradiance, times sin^2(a)"),
    {returns_row(), nullptr},
  };
  // clang-format on
}

// A value that was written, or the preset.
Origin place_in(const FoundValues& found, const std::string& key) {
  const auto value = found.find(key);
  return value == found.end() ? Origin{} : value->second.origin;
}

void check_detector(const FoundValues& found, const std::string& prefix, const std::string& owner, const D& model, ProblemList& problems) {
  const auto complain = [&](const std::string& key, double value, const std::string& expected) {
    problems.add(place_in(found, prefix + key), owner + key, number_text(value), expected);
  };
  if (model.bandpass_m > 0 && (model.energy_J == 0 || model.field_rad == 0 || model.gate_s == 0))
    complain("detector.bandpass_nm", 1e9 * model.bandpass_m,
             "sunlight is in the detector, but how much is not said: expected energy_uJ, field_mrad and gate_us as well");
  if (model.saturation_electrons > 0 && model.saturation_electrons <= model.threshold_electrons)
    complain("detector.saturation_electrons", model.saturation_electrons,
             "nothing between the threshold and this tells a range: expected more than " + number_text(model.threshold_electrons));
  if (model.threshold_electrons < kLeastThreshold * model.noise_electrons)
    complain("detector.threshold_electrons", model.threshold_electrons,
             "noise alone would be told as returns: expected at least " + number_text(kLeastThreshold) + " times detector.noise_electrons");
  for (const DetectorField& field : detector_fields()) {
    const auto value = found.find(prefix + field.row.key);
    if (sim::is_simulated(model) || field.member == nullptr || value == found.end() || field.member == &D::reference_electrons) continue;
    return complain(field.row.key, value->second.numbers.at(0), "has no effect without detector.reference_electrons: add it");
  }
}

}  // namespace

const std::vector<DetectorField>& detector_fields() {
  static const std::vector<DetectorField> fields = make_detector_fields();
  return fields;
}

double detector_value(const D& model, const DetectorField& field) {
  return field.member == nullptr ? static_cast<double>(model.returns) : model.*field.member;
}

D read_detector(const FoundValues& found, const std::string& prefix, const std::string& owner, ProblemList& problems) {
  D model;
  for (const DetectorField& field : detector_fields()) {
    const auto value = found.find(prefix + field.row.key);
    if (value == found.end()) continue;
    const double number = value->second.numbers.at(0);
    if (field.member == nullptr) {
      model.returns = static_cast<sim::Returns>(static_cast<int>(number));
    } else {
      model.*field.member = number * field.row.to_si;
    }
  }
  check_detector(found, prefix, owner, model, problems);
  return model;
}

void warn_of_no_sun(MissionSource& source) {
  const auto warn = [&](const D& model, const std::string& prefix) {
    if (model.bandpass_m == 0 || source.scene.orbit) return;
    source.warnings.push_back(to_string(problem_at(source, prefix + "detector.bandpass_nm", number_text(1e9 * model.bandpass_m),
                                                   "changes nothing: the mission has no [orbit], and so no Sun")));
  };
  warn(source.detector, "sensor.");
  for (const FurtherSensor& sensor : source.further_sensors) warn(sensor.detector, "further_sensor." + sensor.name + ".");
}

}  // namespace lasso::mdat
