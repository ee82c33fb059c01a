#include "fsw/mission/number_fit.hpp"

#include "fsw/mission/image_layout.hpp"
#include "fsw/mission/image_records.hpp"

namespace lasso {
namespace {

using N = FlightNumber;
using P = MissionParameters;

double length_m(const ImageTable& geometry, std::uint32_t word) {
  return geometry.signed_word(0, word) / static_cast<double>(1U << geometry.word(0, kLengthFractionBits));
}

bool reaches_too_far(const ImageTable& geometry, std::uint32_t axis, double cell_m) {
  const double low_m = length_m(geometry, kOriginX + axis);
  const double high_m = low_m + 8 * geometry.word(0, kBricksX + axis) * cell_m;
  return low_m < -N::kFarthest_m || high_m > N::kFarthest_m;
}

Misfit misfit(const char* what, double P::*parameter) {
  std::uint32_t row = 0;
  while (parameter_rows()[row].member != parameter) ++row;
  return {what, row};
}

// The length in the image's words that is the longest one of the number type.
std::int64_t longest_word(int length_bits) { return static_cast<std::int64_t>(N::kFarthest_m) * (std::int64_t{1} << length_bits); }

bool length_fits(char kind, std::int32_t word, std::int64_t longest) {
  if (kind == 'S' && word == kNoSide) return true;
  if (kind != 'S' && kind != 'L') return true;
  return word >= -longest && word <= longest;
}

}  // namespace

const char* misfit_of_grid(const ImageTable& geometry) {
  const double cell_m = length_m(geometry, kCellSize);
  if (!(cell_m > N::kSmallestCell_m))
    return "target.cell_size_m is less than the number type holds: enlarge it, or build with floating point";
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const double center_m = length_m(geometry, kCenterX + axis);
    if (center_m < -N::kFarthest_m || center_m > N::kFarthest_m)
      return "the target's centre is farther off than the number type holds: build with floating point";
    if (reaches_too_far(geometry, axis, cell_m)) return "grid is larger than the number type holds: build with floating point";
  }
  return nullptr;
}

Misfit misfit_of(const SensorParameters& s, double radius_m) {
  if (!(s.range_max_m + radius_m <= N::kFarthest_m))
    return misfit(
        "sensor.range_max_m and the model's radius reach farther than the number type holds: lower it, or build with floating point",
        &P::range_max_m);
  const double grown_m = s.sigma_k_per_m * s.range_max_m * s.range_max_m;
  if (s.sigma0_m * s.sigma0_m + grown_m * grown_m > N::kLargestSigma_m * N::kLargestSigma_m)
    return misfit(
        "sensor.sigma0_m and sensor.sigma_k_per_m are more at sensor.range_max_m than the number type holds: lower one, or build with "
        "floating point",
        &P::sigma0_m);
  if (s.sigma_angle_rad * s.range_max_m > N::kLargestSigma_m)
    return misfit(
        "sensor.sigma_angle_rad is more at sensor.range_max_m than the number type holds: lower one, or build with floating point",
        &P::sigma_angle_rad);
  return {};
}

Misfit misfit_of(const MissionParameters& p) {
  if (p.duration_s > to_seconds(N::kLongestScan_us - kLateStart_us))
    return misfit("scan.duration_s is longer than the number type holds: shorten it, or build with floating point", &P::duration_s);
  return {};
}

LoadFailure check_parameters_fit(const FlightImage& image) {
  const MissionParameters parameters = parameters_of(image[TableId::kParameters]);
  Misfit misfit = misfit_of(parameters);
  if (misfit.what == nullptr) misfit = misfit_of(parameters, length_m(image[TableId::kFieldGeometry], kModelRadius));
  return misfit.what == nullptr ? LoadFailure{} : failure(Status::kBadValue, misfit.what, TableId::kParameters, misfit.row);
}

LoadFailure check_sensor_fit(const FlightImage& image, std::uint32_t sensor) {
  const double radius_m = length_m(image[TableId::kFieldGeometry], kModelRadius);
  const Misfit misfit = misfit_of(sensor_of(image[TableId::kSensors], sensor), radius_m);
  return misfit.what == nullptr ? LoadFailure{} : failure(Status::kBadValue, misfit.what, TableId::kSensors, sensor);
}

LoadFailure check_lengths_fit(const FlightImage& image, TableId id, std::uint32_t record) {
  const char* layout = kLayouts[static_cast<std::uint32_t>(id) - 1];
  if (layout == nullptr || layout[0] == 'u') return {};
  const ImageTable& table = image[id];
  const std::int64_t longest = longest_word(image.length_bits);
  bool fit = true;
  for (std::uint32_t k = 0; k < table.words; ++k) fit = fit && length_fits(kind_of(layout, k), table.signed_word(record, k), longest);
  return fit ? LoadFailure{}
             : failure(Status::kBadValue, "a length is more than the number type holds: build with floating point", id, record);
}

}  // namespace lasso
