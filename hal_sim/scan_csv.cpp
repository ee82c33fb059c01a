#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>

#include "hal_sim/csv_table.hpp"
#include "hal_sim/scan_columns.hpp"

namespace lasso::sim {
namespace {

constexpr std::string_view kHeader = "t_s,x_m,y_m,z_m,valid";
constexpr double kUnitTolerance = 1e-3;

// Where a row of the table has what a ray needs. Without times all rays are of one time; without `valid` all are returns, as in a cloud.
class Rows {
 public:
  explicit Rows(const CsvTable& table)
      : table_(table), xyz_{table.need({"x_m", "x"}), table.need({"y_m", "y"}), table.need({"z_m", "z"})}, valid_(table.find({"valid"})) {
    constexpr std::pair<const char*, double> kTimes[] = {{"t_s", 0}, {"t_ms", 1e-3}, {"t_us", 1e-6}, {"t_ns", 1e-9}, {"t", 0}};
    for (const auto& [name, unit_s] : kTimes) {
      if (time_) break;
      time_ = table.find({name});
      if (!time_) continue;
      unit_s_ = unit_s;
      seconds_named_ = std::string_view(name) == "t_s";
    }
  }

  void describe(RawScan& scan) const {
    scan.rows_are_lines = true;
    scan.has_times = time_.has_value();
    scan.misses_known = valid_.has_value();
    scan.unit_s = unit_s_;
    scan.seconds_named = seconds_named_;
  }

  ReadColumns columns() const {
    ReadColumns read{{xyz_.begin(), xyz_.end()}, valid_.has_value(), time_.has_value()};
    if (valid_) read.columns.push_back(*valid_);
    if (time_) read.columns.push_back(*time_);
    return read;
  }

  void take(RawScan& scan) const {
    const double time = time_ ? read_time(*time_, scan) : 0;
    const bool hit = !valid_ || table_.yes_or_no(*valid_);
    if (table_.says_nothing(xyz_[0]) && table_.says_nothing(xyz_[1]) && table_.says_nothing(xyz_[2])) {
      scan.add_point(Vec3::Zero(), time, table_.line());
      return;
    }
    const Vec3 place(coordinate(xyz_[0]), coordinate(xyz_[1]), coordinate(xyz_[2]));
    if (hit || place.isZero(0) || !place.allFinite()) return scan.add_point(place, time, table_.line());
    take_miss(place, time, scan);
  }

 private:
  double read_time(std::size_t column, const RawScan& scan) const {
    const double time = table_.number(column);
    if (scan.rays.empty() || time >= scan.rays.back().time) return time;
    fail(table_.place(column),
         table_.name(column) + " is " + shown(table_.field(column)) + ", earlier than the row before; sort the rows by time");
  }

  // NaN where words say that nothing was measured. A field that is empty beside others is a fault of the row.
  double coordinate(std::size_t column) const {
    const bool nothing = table_.says_nothing(column) && !table_.field(column).empty();
    return nothing ? std::numeric_limits<double>::quiet_NaN() : table_.number(column);
  }

  void take_miss(const Vec3& direction, double time, RawScan& scan) const {
    const double length = direction.stableNorm();
    if (std::abs(length - 1) <= kUnitTolerance) return scan.add_miss(direction / length, time, table_.line());
    fail(table_.place(), "the direction of a ray that missed (valid 0) has length " + text_of(length) +
                             ", expected 1; divide x_m, y_m, z_m by it, or leave out a measurement that is bad");
  }

  const CsvTable& table_;
  std::array<std::size_t, 3> xyz_;
  std::optional<std::size_t> time_, valid_;
  double unit_s_ = 0;
  bool seconds_named_ = false;
};

// A point of unit length is a direction, to four decimals, where many are: no scene has a tenth of its returns so close to a sphere.
// Without a column of returns they may be the rays that missed.
void check_directions(const RawScan& scan) {
  if (scan.misses_known || !has_directions(scan)) return;
  const auto first = std::find_if(scan.rays.begin(), scan.rays.end(), [](const RawRay& ray) { return is_direction(ray); });
  fail(scan.place(*first), std::to_string(count_directions(scan)) + " of " + std::to_string(scan.rays.size()) +
                               " points, this one first, have the length 1, as directions have; add a column valid: 0 for a ray that "
                               "missed, 1 for a return, where the target truly is 1 away");
}

// What is wrong with the rows, on one line: the first fault in words, and on which lines others are.
class RowFaults {
 public:
  void add(const ScanFileError& fault, std::size_t line) {
    if (count_ == 0) first_ = fault.what();
    if (count_ > 0 && count_ < kTold) lines_ += (count_ > 1 ? ", " : "") + std::to_string(line);
    ++count_;
  }
  void tell() const {
    if (count_ == 0) return;
    if (count_ == 1) throw ScanFileError(first_);
    const std::string rest = count_ > kTold ? " and " + std::to_string(count_ - kTold) + " more" : "";
    throw ScanFileError(first_ + "; further bad lines: " + lines_ + rest);
  }

 private:
  static constexpr std::size_t kTold = 5;
  std::string first_, lines_;
  std::size_t count_ = 0;
};

void put(std::string& text, double value, char after) {
  char buffer[40];
  const auto end = std::to_chars(std::begin(buffer), std::end(buffer), value).ptr;
  text.append(std::begin(buffer), end).push_back(after);
}

// Microseconds as seconds with six decimals, exactly.
void put_time(std::string& text, TimeUs t_us) {
  constexpr std::uint64_t kUsPerSecond = 1000000;
  const std::uint64_t magnitude = t_us < 0 ? 0 - static_cast<std::uint64_t>(t_us) : static_cast<std::uint64_t>(t_us);
  std::string decimals = std::to_string(magnitude % kUsPerSecond);
  decimals.insert(0, 6 - decimals.size(), '0');
  text += (t_us < 0 ? "-" : "") + std::to_string(magnitude / kUsPerSecond) + "." + decimals + ",";
}

void put_row(std::string& text, const RangeSample& sample) {
  const bool hit = sample.state == RayState::kHit;
  const Vec3 direction = Eigen::Map<const Eigen::Vector3f>(sample.direction).cast<double>();
  const Vec3 written = hit ? Vec3(direction.normalized() * static_cast<double>(sample.range_m)) : direction;
  put_time(text, sample.t_us);
  for (int axis = 0; axis < 3; ++axis) put(text, written[axis], ',');
  text += hit ? "1\n" : "0\n";
}

void write_whole(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::path partial = file;
  partial += ".partial";
  std::ofstream out(partial, std::ios::binary);
  out << text;
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(partial, file, error);
  if (out && !error) return;
  std::error_code ignored;
  std::filesystem::remove(partial, ignored);
  fail(file.string(), "cannot be written; check that its folder exists and has space, and your rights to it");
}

}  // namespace

RawScan read_csv(const std::string& file, std::string_view text) {
  CsvTable table(file, text, std::string(kHeader));
  const Rows rows(table);
  RawScan scan;
  scan.file = file;
  rows.describe(scan);
  OtherColumns others(table, rows.columns());
  RowFaults faults;
  for (bool more = true; more;) {
    try {
      more = table.next();
      const std::size_t rays = scan.rays.size();
      if (more) rows.take(scan);
      if (scan.rays.size() > rays) others.look_at_row(scan.rays.back().place.stableNorm());
    } catch (const ScanFileError& fault) {
      faults.add(fault, table.line());
    }
  }
  faults.tell();
  others.check();
  check_directions(scan);
  scan.warnings = others.warnings();
  if (scan.rays.empty() && scan.unmeasured == 0) fail(table.place(), "no row follows the header; a scan needs at least one");
  return scan;
}

std::string scan_csv(const RangeImage& image) {
  std::string text(kHeader);
  text += '\n';
  for (const RangeSample& sample : image.samples) {
    if (sample.state != RayState::kInvalid) put_row(text, sample);
  }
  return text;
}

void write_scan_csv(const std::filesystem::path& file, const RangeImage& image) {
  const std::string text = scan_csv(image);
  if (text.size() == kHeader.size() + 1) fail(file.string(), "the scan has no valid sample to write");
  write_whole(file, text);
}

}  // namespace lasso::sim
