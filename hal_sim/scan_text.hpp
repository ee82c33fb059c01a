// Shared by the readers of scan files: lines with their numbers, numbers with their errors, checked points.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "fsw/geometry/types.hpp"
#include "hal_sim/scan_file.hpp"

namespace lasso::sim {

// Where something stands: "scan.csv:17" or "scan.ply: point 17".
std::string at_line(const std::string& file, std::size_t line);
std::string at_point(const std::string& file, std::size_t point);

[[noreturn]] void fail(const std::string& place, const std::string& what);
std::string shown(std::string_view value);  // printable and at most 40 characters

// The lines of a text, without their ends (LF or CR LF).
class Lines {
 public:
  Lines(std::string file, std::string_view text) : file_(std::move(file)), text_(text) {}
  bool next(std::string_view& line);  // false past the end
  std::string place() const { return at_line(file_, number_); }
  const std::string& file() const { return file_; }
  std::size_t number() const { return number_; }
  std::string_view rest() const { return text_.substr(position_); }  // after the line last read

 private:
  std::string file_;
  std::string_view text_;
  std::size_t position_ = 0;
  std::size_t number_ = 0;
};

std::vector<std::string_view> split(std::string_view line, char separator);  // fields trimmed of blanks; empty fields are kept
std::vector<std::string_view> words(std::string_view line);                  // separated by blanks or tabs; none is empty

// A finite decimal number that fills the field, or a count.
double number(std::string_view field, std::string_view name, const std::string& place);
std::uint64_t count(std::string_view field, std::string_view name, const std::string& place);

// A point that was hit, or the direction of a ray that missed, checked and appended.
void append_hit(RangeImage& image, const Vec3& point_m, TimeUs t_us, const std::string& place);
void append_miss(RangeImage& image, const Vec3& direction, TimeUs t_us, const std::string& place);

// Refuses a declared number of points that is zero or over capacity.
void check_point_count(std::uint64_t points, const std::string& place);

// Plain scalars in a binary block.
double scalar_at(const char* bytes, std::size_t size, bool big_endian);  // IEEE binary32 or binary64, size 4 or 8

RangeImage read_csv(const std::string& file, std::string_view text);
RangeImage read_ply(const std::string& file, std::string_view text);
RangeImage read_pcd(const std::string& file, std::string_view text);

}  // namespace lasso::sim
