// Shared by the readers of scan files: lines with their numbers, numbers with their errors, scalars in binary blocks.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "hal_sim/raw_scan.hpp"
#include "hal_sim/scan_file.hpp"

namespace lasso::sim {

// Where something stands: "scan.csv:17" or "scan.ply: point 17".
std::string at_line(const std::string& file, std::size_t line);
std::string at_point(const std::string& file, std::size_t point);

[[noreturn]] void fail(const std::string& place, const std::string& what);
std::string shown(std::string_view value);             // printable and at most 40 characters
std::string text_of(double value);                     // the shortest that reads back the same
std::string_view trimmed(std::string_view field);      // without blanks and tabs around it
std::string_view without_mark(std::string_view text);  // without the byte order mark of UTF-8 before it

constexpr double kLatest_s = 1e11;  // over 3000 years: what is beyond is another unit, and would not fit in microseconds

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

// A finite decimal number that fills the field; any number, NaN and infinity too; or a count.
double number(std::string_view field, std::string_view name, const std::string& place);
double any_number(std::string_view field, std::string_view name, const std::string& place);
std::uint64_t count(std::string_view field, std::string_view name, const std::string& place);

// Refuses a declared number of points that is zero, or that no file has.
void check_point_count(std::uint64_t points, const std::string& place);

// Refuses what follows the last of the declared points, but blank lines.
void check_end(Lines& lines, std::uint64_t points);

// A plain scalar in a binary block: IEEE binary32 or binary64, or an integer of 1, 2, 4 or 8 bytes.
struct ScalarType {
  enum class Kind { kReal, kSigned, kUnsigned };
  Kind kind = Kind::kReal;
  std::size_t bytes = 0;  // 0: none
};
double scalar_at(const char* bytes, ScalarType type, bool big_endian);

RawScan read_csv(const std::string& file, std::string_view text);
RawScan read_ply(const std::string& file, std::string_view text);
RawScan read_pcd(const std::string& file, std::string_view text);
RawScan read_xyz(const std::string& file, std::string_view text);

}  // namespace lasso::sim
