// The table of cases, cases.csv: `case,seed,` and the columns that the campaign draws, a line a case. A number is the shortest text that
// reads back to the same double, so that a case is the same wherever the table is read.
#pragma once

#include <filesystem>
#include <fstream>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "mdat/campaign/draw.hpp"

namespace lasso::mdat {

// Writes the table of cases 0 to `cases` - 1, line by line.
void write_cases(const CaseDraws& draws, std::uint32_t cases, std::ostream& out);

// One line of it, without its end.
std::string case_line(std::uint32_t case_number, const CaseValues& values);

// Reads a table line by line: memory does not grow with it.
class CaseTable {
 public:
  // Reads the header. Throws InputError: no such file, or it does not begin with `case,seed`.
  explicit CaseTable(std::filesystem::path file);

  const std::vector<std::string>& columns() const { return columns_; }

  // The next case; none after the last. Throws InputError that names the line: not as many cells as columns, no number, a case that is not
  // in order, a last line without its end.
  std::optional<CaseValues> next();

  // The number of the case that `next` reads.
  std::uint32_t case_number() const { return case_; }

  // Case k, which has not been read yet; those before it are passed by. Throws InputError, as next(), and where the table ends before it.
  CaseValues at(std::uint32_t case_number);

 private:
  bool read_line();
  CaseValues parsed() const;
  [[noreturn]] void refuse(const std::string& why) const;

  std::filesystem::path file_;
  std::ifstream in_;
  std::string line_;
  std::vector<std::string> columns_;
  std::uint32_t case_ = 0;
};

// Compares the table with what is drawn. Throws InputError that names the first line that differs, with the column.
void check_cases(const std::filesystem::path& file, const CaseDraws& draws, std::uint32_t cases);

}  // namespace lasso::mdat
