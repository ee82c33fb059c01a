#include "hal_sim/scan_columns.hpp"

#include <algorithm>

namespace lasso::sim {
namespace {

constexpr std::size_t kMany = 3;   // values: a column of so many does not tell returns from misses
constexpr std::size_t kNamed = 5;  // columns in a warning

// What scanners and programs write beside coordinates. None of it says whether a row is a return.
constexpr std::string_view kCommon =
    "intensity i reflectivity reflectance remission amplitude signal snr ambient near_ir ring channel laser laser_id beam line row col "
    "column u v id index point_id scan frame r g b a red green blue alpha rgb rgba x y z nx ny nz normal_x normal_y normal_z curvature "
    "range range_m distance distance_m azimuth azimuth_deg elevation elevation_deg sigma sigma_m residual residual_m";
constexpr std::string_view kTimeNames =
    "t t_s t_ms t_us t_ns time time_s time_ms time_us time_ns timestamp time_stamp time_offset offset_time";

constexpr char kKnown[] = "t_s, t_ms, t_us, t_ns or t; x_m or x; y_m or y; z_m or z; valid; of others none is read";
constexpr char kValid[] = "valid (1 a return; 0 a ray that missed, with x, y and z its unit direction)";

bool is_among(std::string_view list, std::string_view name) {
  const std::vector<std::string_view> names = words(list);
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

OtherColumns::OtherColumns(const CsvTable& table, const ReadColumns& read) : table_(table), read_(read) {
  for (std::size_t i = 0; i < table.size(); ++i) {
    const std::string& name = table.name(i);
    const bool is_read = std::find(read.columns.begin(), read.columns.end(), i) != read.columns.end();
    if (is_read || is_among(kCommon, name)) continue;
    if (is_among(kTimeNames, name)) {
      times_.push_back(i);
    } else {
      unknown_.push_back({i, {}, 0});
    }
  }
}

void OtherColumns::look_at_row() {
  if (read_.returns) return;
  for (Unknown& unknown : unknown_) {
    if (unknown.kinds < kMany) count(unknown, table_.field(unknown.column));
  }
}

void OtherColumns::count(Unknown& unknown, std::string_view value) {
  const auto end = unknown.values.begin() + static_cast<std::ptrdiff_t>(unknown.kinds);
  if (std::find(unknown.values.begin(), end, value) != end) return;
  if (unknown.kinds < unknown.values.size()) unknown.values[unknown.kinds] = value;
  ++unknown.kinds;
}

void OtherColumns::check() const {
  if (read_.returns) return;
  for (const Unknown& unknown : unknown_) {
    if (unknown.kinds != 2) continue;
    fail(table_.header_place(unknown.column), "column " + shown(table_.name(unknown.column)) +
                                                  " is not known, and tells rows in two kinds, " + shown(unknown.values[0]) + " and " +
                                                  shown(unknown.values[1]) + ": where it says which rays are returns, name it " + kValid +
                                                  "; where all rows are returns, remove it; known are " + kKnown);
  }
}

std::vector<std::string> OtherColumns::warnings() const {
  std::vector<std::string> lines;
  std::string names;
  for (std::size_t i = 0; i < unknown_.size() && i < kNamed; ++i) names += (i > 0 ? ", " : "") + shown(table_.name(unknown_[i].column));
  if (unknown_.size() > kNamed) names += " and " + std::to_string(unknown_.size() - kNamed) + " more";
  if (!unknown_.empty())
    lines.push_back(table_.header_place(unknown_.front().column) + ": not known, and not read: column " + names +
                    "; rename what is one of those that are known: " + kKnown);
  if (!read_.times && !times_.empty())
    lines.push_back(
        table_.header_place(times_.front()) + ": column " + shown(table_.name(times_.front())) +
        " is not read, and all rays are taken at one time; where it has the time of each ray, name it t_s, t_ms, t_us or t_ns, by "
        "its unit");
  return lines;
}

}  // namespace lasso::sim
