#include "mdat/missiondb/calibration_file.hpp"

#include <algorithm>

#include "mdat/missiondb/toml_reader.hpp"

namespace lasso::mdat {
namespace {

using C = TriangulationCalibration;

// In the order of kCalibrationReals.
struct Word {
  const char* key;
  const char* meaning;
};
constexpr Word kWords[kCalibrationRealCount] = {{"focal_length_m", "at the reference temperature"},
                                                {"baseline_m", "at the reference temperature"},
                                                {"half_width_m", "of the detector"},
                                                {"angle_x_offset_rad", "added to what the mirror says"},
                                                {"angle_y_offset_rad", "added to what the mirror says"},
                                                {"focal_length_per_K", "relative growth"},
                                                {"baseline_per_K", "relative growth"},
                                                {"peak_per_K", "half widths"},
                                                {"reference_degC", ""},
                                                {"angle_max_rad", "the calibrated volume: either mirror"},
                                                {"depth_min_m", ""},
                                                {"depth_max_m", ""},
                                                {"temperature_min_degC", ""},
                                                {"temperature_max_degC", ""},
                                                {"outside_sigma_factor", "of a point a little outside of that volume"}};
constexpr double kMaxSerial = 4294967295.0;

ValueRow row_of(const char* key, ValueKind kind, double minimum, double maximum, std::size_t count) {
  ValueRow row;
  row.key = key;
  row.kind = kind;
  row.minimum = minimum;
  row.maximum = maximum;
  row.count_min = row.count_max = count;
  row.required = true;
  return row;
}

const std::vector<ValueRow>& rows() {
  static const std::vector<ValueRow> all = [] {
    std::vector<ValueRow> rows{row_of("serial", ValueKind::kInteger, 1, kMaxSerial, 1)};
    for (std::size_t i = 0; i < kCalibrationRealCount; ++i) {
      const CalibrationReal& real = kCalibrationReals[i];
      rows.push_back(row_of(kWords[i].key, ValueKind::kReal, real.minimum, real.maximum, 1));
      rows.back().required = real.member != &C::outside_sigma_factor;  // which not every table has to say
    }
    rows.push_back(row_of("residual", ValueKind::kReals, -kMaxResidual, kMaxResidual, kResidualTerms));
    return rows;
  }();
  return all;
}

const char* remedy(Status status) {
  return status == Status::kSingular
             ? "a calibration that triangulates: lengths above 0 at every calibrated temperature, a spot that grows with the peak"
             : "a calibrated volume with content, and angles within 1 rad";
}

}  // namespace

TriangulationCalibration load_calibration(const std::filesystem::path& file) {
  ProblemList problems(file);
  const FoundValues found = read_table(parse_toml(file), "", rows(), {}, problems);
  problems.throw_if_any();
  TriangulationCalibration calibration;
  calibration.serial = static_cast<std::uint32_t>(found.at("serial").numbers.at(0));
  for (std::size_t i = 0; i < kCalibrationRealCount; ++i) {
    const auto value = found.find(kWords[i].key);
    if (value != found.end()) calibration.*kCalibrationReals[i].member = value->second.numbers.at(0);
  }
  const std::vector<double>& residual = found.at("residual").numbers;
  std::copy(residual.begin(), residual.end(), std::begin(calibration.residual));
  const Status status = validate(calibration);
  if (status != Status::kOk) problems.add(Origin{}, "", std::string(to_string(status)), remedy(status));
  problems.throw_if_any();
  return calibration;
}

std::string calibration_text(const TriangulationCalibration& calibration) {
  std::string text =
      "# Calibration of a laser camera: docs/icd/lcs.md, fsw/mission/calibration.hpp.\nserial = " + std::to_string(calibration.serial) +
      "\n";
  for (std::size_t i = 0; i < kCalibrationRealCount; ++i) {
    text += std::string(kWords[i].key) + " = " + number_text(calibration.*kCalibrationReals[i].member);
    text += *kWords[i].meaning != 0 ? std::string("  # ") + kWords[i].meaning + "\n" : "\n";
  }
  text += "# of 1, x, y, q, x^2, x y, y^2, x q, y q, q^2: x, y the angles, q the peak\nresidual = [";
  for (std::size_t k = 0; k < kResidualTerms; ++k) text += (k > 0 ? ", " : "") + number_text(calibration.residual[k]);
  return text + "]\n";
}

}  // namespace lasso::mdat
