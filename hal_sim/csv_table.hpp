// The reader of tables in text files, for scans, poses and all others: a header that names the columns, then a row a line.
//
// As spreadsheets and scripts write them: a byte order mark, blanks around fields, quotes, blank lines, `#` before the header or a remark,
// columns in any order and more than are asked for; separated by commas, or by semicolons or tabs, then with decimal commas, too.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal_sim/scan_text.hpp"

namespace lasso::sim {

class CsvTable {
 public:
  // Reads the header. `expected` is how errors show it. Throws ScanFileError, as all below: of UTF-16, or where nothing stands there.
  CsvTable(std::string file, std::string_view text, std::string expected);

  std::size_t size() const { return names_.size(); }  // columns

  // A column by one of its names, in either case.
  std::optional<std::size_t> find(std::initializer_list<std::string_view> names) const;
  std::size_t need(std::initializer_list<std::string_view> names) const;  // throws where there is none

  // The next row that is not blank; false past the last. Throws where it has not as many fields as the header; the one after is read next.
  bool next();
  std::string_view field(std::size_t column) const { return fields_.at(column).text; }  // without blanks and quotes around it
  double number(std::size_t column) const;                                              // throws where it is none, or not finite
  bool yes_or_no(std::size_t column) const;     // 1, 1.0, True or 0, 0.0, False, in any case; throws
  bool says_nothing(std::size_t column) const;  // empty, or not a finite number by its words

  std::size_t line() const { return lines_.number(); }
  std::string place() const { return lines_.place(); }
  std::string place(std::size_t column) const;  // file:line:column, from 1
  const std::string& name(std::size_t column) const { return names_.at(column); }
  std::string header_place(std::size_t column) const;  // of its name
  [[noreturn]] void refuse_header() const;

 private:
  struct Field {
    std::string_view text;
    std::size_t begin = 0;  // in the line
  };
  void read_header();
  std::vector<Field> split(std::string_view line) const;

  Lines lines_;
  std::string expected_, header_;
  char separator_ = ',';
  std::vector<std::string> names_;
  std::vector<std::size_t> name_begins_;  // in the header's line
  std::vector<Field> fields_;
  std::size_t header_line_ = 1;
};

}  // namespace lasso::sim
