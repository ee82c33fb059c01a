#include "mdat/missiondb/calibration_file.hpp"

#include <algorithm>

#include "mdat/missiondb/toml_reader.hpp"

namespace lasso::mdat {
namespace {

using C = TriangulationCalibration;

struct RealRow {
  const char* key;
  double C::*member;
  double minimum, maximum;
  const char* meaning;
};
constexpr RealRow kReals[] = {
    {"focal_length_m", &C::focal_length_m, 0, 10, "at the reference temperature"},
    {"baseline_m", &C::baseline_m, 0, 10, "at the reference temperature"},
    {"half_width_m", &C::half_width_m, 0, 10, "of the detector"},
    {"angle_x_offset_rad", &C::angle_x_offset_rad, -0.5, 0.5, "added to what the mirror says"},
    {"angle_y_offset_rad", &C::angle_y_offset_rad, -0.5, 0.5, "added to what the mirror says"},
    {"focal_length_per_K", &C::focal_length_per_K, -0.01, 0.01, "relative growth"},
    {"baseline_per_K", &C::baseline_per_K, -0.01, 0.01, "relative growth"},
    {"peak_per_K", &C::peak_per_K, -0.01, 0.01, "half widths"},
    {"reference_degC", &C::reference_degC, -100, 100, ""},
    {"angle_max_rad", &C::angle_max_rad, 0, 1, "the calibrated volume: either mirror"},
    {"depth_min_m", &C::depth_min_m, 0, 1000, ""},
    {"depth_max_m", &C::depth_max_m, 0, 1000, ""},
    {"temperature_min_degC", &C::temperature_min_degC, -100, 100, ""},
    {"temperature_max_degC", &C::temperature_max_degC, -100, 100, ""},
    {"outside_sigma_factor", &C::outside_sigma_factor, 1, 1000, "of a point a little outside of that volume"},
};
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
    for (const RealRow& real : kReals) {
      rows.push_back(row_of(real.key, ValueKind::kReal, real.minimum, real.maximum, 1));
      rows.back().required = real.member != &C::outside_sigma_factor;  // which not every table has to say
    }
    rows.push_back(row_of("residual", ValueKind::kReals, -10, 10, kResidualTerms));
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
  for (const RealRow& real : kReals) {
    const auto value = found.find(real.key);
    if (value != found.end()) calibration.*real.member = value->second.numbers.at(0);
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
  for (const RealRow& real : kReals) {
    text += std::string(real.key) + " = " + number_text(calibration.*real.member);
    text += *real.meaning != 0 ? std::string("  # ") + real.meaning + "\n" : "\n";
  }
  text += "# of 1, x, y, q, x^2, x y, y^2, x q, y q, q^2: x, y the angles, q the peak\nresidual = [";
  for (std::size_t k = 0; k < kResidualTerms; ++k) text += (k > 0 ? ", " : "") + number_text(calibration.residual[k]);
  return text + "]\n";
}

}  // namespace lasso::mdat
