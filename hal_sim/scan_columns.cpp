#include "hal_sim/scan_columns.hpp"

#include <algorithm>

namespace lasso::sim {
namespace {

constexpr std::size_t kNamed = 5;      // columns in a warning
constexpr double kTwoDecimals = 1e-2;  // directions in two decimals are so long

// What scanners and programs write beside coordinates, as plain_name has it: LAS and PDAL, RIEGL, VeloView, Livox, Ouster, CloudCompare.
// None of it says whether a row is a return.
constexpr std::string_view kCommon =
    "intensity i reflectivity reflectance remission amplitude deviation pulsewidth signal snr ambient nearir ring channel scanchannel "
    "laser laserid beam line row col column u v id index pointid scan frame frameid measurementid encoder r g b a red green blue alpha "
    "rgb rgba infrared rf gf bf x y z nx ny nz normalx normaly normalz curvature range rangem distance distancem azimuth azimuthdeg "
    "elevation elevationdeg verticalangle sigma sigmam residual residualm returnnumber numberofreturns targetindex targetcount "
    "dualdistance dualintensity scandirectionflag edgeofflightline classification classid scananglerank scanangle userdata "
    "pointsourceid slotid lidarindex rsvd timestamptype datatype tag orix oriy oriz oriradius oritheta oriphi originalcloudindex "
    "scalarfield pointsmxyz:0 pointsmxyz:1 pointsmxyz:2";
constexpr std::string_view kTimeNames =
    "t ts tms tus tns time times timems timeus timens timestamp timestamps timestampms timestampus timestampns timeoffset offsettime "
    "adjustedtime gpstime hosttimestamp stamp epoch sec secs seconds nsec nsecs nanosec nanosecs nanoseconds";

// With two values these tell returns from misses, wherever their points are.
constexpr std::string_view kReturnNames = "valid isvalid validity ok good bad hit ishit miss ismiss missed detected mask status state";

constexpr char kKnown[] = "t_s, t_ms, t_us, t_ns or t; x_m or x; y_m or y; z_m or z; valid; of others none is read";
constexpr char kValid[] = "valid (1 a return; 0 a ray that missed, with x, y and z its unit direction)";

bool is_among(std::string_view list, std::string_view name) {
  const std::vector<std::string_view> names = words(list);
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Without what programs write differently: blanks, underscores and hyphens, and a unit in brackets.
std::string plain_name(std::string_view name) {
  std::string plain;
  for (const char c : name.substr(0, name.find_first_of("(["))) {
    if (c != ' ' && c != '_' && c != '-') plain += c;
  }
  return plain;
}

}  // namespace

OtherColumns::OtherColumns(const CsvTable& table, const ReadColumns& read) : table_(table), read_(read) {
  for (std::size_t i = 0; i < table.size(); ++i) {
    const std::string plain = plain_name(table.name(i));
    if (is_read(i) || is_among(kCommon, plain)) continue;
    if (is_among(kTimeNames, plain)) {
      times_.push_back(i);
    } else {
      unknown_.push_back({i, is_among(kReturnNames, plain), {}, 0});
    }
  }
}

// Of two columns of one name nothing says which one is meant.
bool OtherColumns::is_read(std::size_t column) const {
  if (std::find(read_.columns.begin(), read_.columns.end(), column) != read_.columns.end()) return true;
  for (const std::size_t other : read_.columns) {
    if (table_.name(other) != table_.name(column)) continue;
    fail(table_.header_place(column), "a second column " + shown(table_.name(column)) + "; remove one of them, or name it otherwise");
  }
  return false;
}

void OtherColumns::look_at_row(double length) {
  if (read_.returns) return;
  for (Unknown& unknown : unknown_) take(unknown, table_.field(unknown.column), length);
}

void OtherColumns::take(Unknown& unknown, std::string_view value, double length) {
  if (unknown.values > unknown.kinds.size()) return;
  const auto end = unknown.kinds.begin() + static_cast<std::ptrdiff_t>(unknown.values);
  auto kind = std::find_if(unknown.kinds.begin(), end, [&](const Kind& known) { return known.value == value; });
  if (kind == end && ++unknown.values > unknown.kinds.size()) return;
  if (kind->value != value) kind->value = value;
  kind->nearest = std::min(kind->nearest, length);
  kind->farthest = std::max(kind->farthest, length);
}

bool OtherColumns::may_tell_misses(const Unknown& unknown) {
  if (unknown.values != unknown.kinds.size()) return false;
  const auto is_unit = [](const Kind& kind) { return kind.nearest >= 1 - kTwoDecimals && kind.farthest <= 1 + kTwoDecimals; };
  const auto& [one, other] = unknown.kinds;
  const bool apart = one.farthest < other.nearest || other.farthest < one.nearest;
  return unknown.named_so || apart || is_unit(one) || is_unit(other);
}

void OtherColumns::check() const {
  if (read_.returns) return;
  for (const Unknown& unknown : unknown_) {
    if (!may_tell_misses(unknown)) continue;
    fail(table_.header_place(unknown.column), "column " + shown(table_.name(unknown.column)) +
                                                  " is not known, and tells rows in two kinds, " + shown(unknown.kinds[0].value) + " and " +
                                                  shown(unknown.kinds[1].value) + ": where it says which rays are returns, name it " +
                                                  kValid + "; where all rows are returns, remove it; known are " + kKnown);
  }
}

std::vector<ScanWarning> OtherColumns::warnings() const {
  std::vector<ScanWarning> warnings;
  std::string names;
  for (std::size_t i = 0; i < unknown_.size() && i < kNamed; ++i) names += (i > 0 ? ", " : "") + shown(table_.name(unknown_[i].column));
  if (unknown_.size() > kNamed) names += " and " + std::to_string(unknown_.size() - kNamed) + " more";
  if (!unknown_.empty())
    warnings.push_back({table_.header_place(unknown_.front().column),
                        "not known, and not read: column " + names + "; rename what is one of those that are known: " + kKnown});
  if (!read_.times && !times_.empty())
    warnings.push_back({table_.header_place(times_.front()),
                        "column " + shown(table_.name(times_.front())) +
                            " is not read, and all rays are taken at one time; where it has the time of each ray, name it t_s, t_ms, t_us "
                            "or t_ns, by its unit"});
  return warnings;
}

}  // namespace lasso::sim
