#include "mdat/missiondb/flash_rows.hpp"

#include <type_traits>
#include <utility>

namespace lasso::mdat {
namespace {

constexpr std::size_t kSensorPrefix = sizeof("sensor.") - 1;

struct FlashField {
  ValueRow row;
  double (*get)(const sim::FlashModel&);
  void (*set)(sim::FlashModel&, double);
};

template <auto kMember>
FlashField flash_field(const char* key, const char* unit, double minimum, double maximum, const char* meaning) {
  using Value = std::remove_reference_t<decltype(std::declval<sim::FlashModel>().*kMember)>;
  const ValueKind kind = std::is_same_v<Value, bool>  ? ValueKind::kBoolean
                         : std::is_same_v<Value, int> ? ValueKind::kInteger
                                                      : ValueKind::kReal;
  return {number_row(key, unit, kind, 1, minimum, maximum, static_cast<double>(sim::FlashModel{}.*kMember), meaning),
          [](const sim::FlashModel& model) { return static_cast<double>(model.*kMember); },
          [](sim::FlashModel& model, double value) { model.*kMember = static_cast<Value>(value); }};
}

const std::vector<FlashField>& flash_fields() {
  using F = sim::FlashModel;
  // clang-format off
  static const std::vector<FlashField> fields = {
    flash_field<&F::columns>("sensor.flash_columns", "1", 8, sim::kMaxPixelsASide, "flash_lidar: pixels across the field of view"),
    flash_field<&F::rows>("sensor.flash_rows", "1", 8, sim::kMaxPixelsASide, "flash_lidar: pixels down the field of view"),
    flash_field<&F::photons_at_10m>("sensor.flash_photons_at_10m", "1", 1e-3, 1e12, "flash_lidar: counts of a pixel's return from 10 m, of a surface of reflectance 0.5 seen straight on"),
    flash_field<&F::background>("sensor.flash_background", "1", 0, 100, "flash_lidar: background counts of a pixel in one bin of time, which is 4 rms lengths of the pulse long"),
    flash_field<&F::threshold>("sensor.flash_threshold", "1", 1, 1000, "flash_lidar: counts that are taken for a return"),
    flash_field<&F::pulse_m>("sensor.flash_pulse_m", "m", 1e-4, 100, "flash_lidar: rms length of the pulse in range; 0.15 m are 1 ns"),
    flash_field<&F::jitter_m>("sensor.flash_jitter_m", "m", 0, 10, "flash_lidar: noise of a range that more photons do not lessen (1 sigma)"),
    flash_field<&F::dead_share>("sensor.flash_dead_share", "1", 0, 0.5, "flash_lidar: share of pixels that never measure"),
    flash_field<&F::materials>("sensor.flash_materials", "1", 0, 1, "flash_lidar: surfaces return what their materials do at 1550 nm; false: as of reflectance 0.5"),
  };
  // clang-format on
  return fields;
}

}  // namespace

const std::vector<ValueRow>& flash_rows() {
  static const std::vector<ValueRow> rows = [] {
    std::vector<ValueRow> result;
    for (const FlashField& field : flash_fields()) result.push_back(field.row);
    return result;
  }();
  return rows;
}

sim::FlashModel read_flash(const FoundValues& found, const std::string& found_prefix, SensorKind kind, const std::string& prefix,
                           ProblemList& problems) {
  sim::FlashModel model;
  for (const FlashField& field : flash_fields()) {
    const std::string name = field.row.key.substr(kSensorPrefix);
    const auto value = found.find(found_prefix + name);
    if (value == found.end()) continue;
    field.set(model, value->second.numbers.at(0));
    if (kind != SensorKind::kFlashLidar)
      problems.add(value->second.origin, prefix + name, number_text(value->second.numbers.at(0)),
                   std::string("has no effect in a ") + kind_name(kind) + ": leave it out, or write kind = \"flash_lidar\"");
  }
  return model;
}

double flash_value(const sim::FlashModel& model, const ValueRow& row) {
  for (const FlashField& field : flash_fields()) {
    if (field.row.key == row.key) return field.get(model);
  }
  return 0;
}

}  // namespace lasso::mdat
