#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "hal_sim/scan_text.hpp"

namespace lasso::sim {
namespace {

constexpr std::string_view kHeader = "t_s,x_m,y_m,z_m,valid";
constexpr double kLatest_s = 1e11;                // over 3000 years: what is beyond is another unit, and would not fit in microseconds
constexpr std::size_t kMostLines = kMaxRays + 2;  // the header, the rows that fit, and the one that is refused

void read_csv_header(Lines& lines) {
  std::string_view line;
  if (!lines.next(line)) fail(at_line(lines.file(), 1), "the file is empty, expected the header " + shown(kHeader));
  if (line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);  // spreadsheets put a byte order mark first
  if (split(line, ',') == split(kHeader, ',')) return;
  fail(lines.place(), "the header is " + shown(line) + ", expected " + shown(kHeader));
}

TimeUs read_time(std::string_view field, const RangeImage& image, const std::string& place) {
  const double t_s = number(field, "t_s", place);
  if (std::abs(t_s) > kLatest_s) fail(place, "t_s is " + shown(field) + ", expected at most 1e11; check that its unit is seconds");
  const TimeUs t_us = std::llround(t_s * 1e6);
  if (image.samples.empty() || t_us >= image.samples[image.samples.size() - 1].t_us) return t_us;
  fail(place, "t_s is " + shown(field) + ", earlier than the row before; sort the rows by time");
}

void read_row(std::string_view line, RangeImage& image, const std::string& place) {
  const auto fields = split(line, ',');
  if (fields.size() != 5) {
    fail(place,
         "the row has " + std::to_string(fields.size()) + " fields, expected 5: " + std::string(kHeader) + "; the row is " + shown(line));
  }
  const TimeUs t_us = read_time(fields[0], image, place);
  const double x = number(fields[1], "x_m", place);
  const double y = number(fields[2], "y_m", place);
  const double z = number(fields[3], "z_m", place);
  if (fields[4] == "1") return append_hit(image, Vec3(x, y, z), t_us, place);
  if (fields[4] == "0") return append_miss(image, Vec3(x, y, z), t_us, place);
  fail(place, "valid is " + shown(fields[4]) + ", expected 1 (hit) or 0 (miss)");
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

RangeImage read_csv(const std::string& file, std::string_view text) {
  Lines lines(file, text);
  read_csv_header(lines);
  RangeImage image;
  RowFaults faults;
  std::string_view line;
  while (lines.number() < kMostLines && lines.next(line)) {
    if (line.empty() && lines.rest().empty()) break;  // a last empty line
    try {
      read_row(line, image, lines.place());
    } catch (const ScanFileError& fault) {
      faults.add(fault, lines.number());
    }
  }
  faults.tell();
  if (image.samples.empty()) fail(lines.place(), "no row follows the header; a scan needs at least one");
  return image;
}

void write_scan_csv(const std::filesystem::path& file, const RangeImage& image) {
  std::string text(kHeader);
  text += '\n';
  const std::size_t header_size = text.size();
  for (const RangeSample& sample : image.samples) {
    if (sample.state != RayState::kInvalid) put_row(text, sample);
  }
  if (text.size() == header_size) fail(file.string(), "the scan has no valid sample to write");
  write_whole(file, text);
}

}  // namespace lasso::sim
