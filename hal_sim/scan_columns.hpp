// Columns of a table of rays that are not read: which of them are common beside coordinates, and which may say what the rows mean.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "hal_sim/csv_table.hpp"

namespace lasso::sim {

// Which of a table's columns its reader reads, and whether it knows returns from misses, and times, by them.
struct ReadColumns {
  std::vector<std::size_t> columns;
  bool returns = false, times = false;
};

class OtherColumns {
 public:
  OtherColumns(const CsvTable& table, const ReadColumns& read);

  // Takes in the row that stands in the table; of rows with a measurement alone.
  void look_at_row();

  // Throws ScanFileError where returns are not known from misses and a column that is not known has two values: it may tell them apart.
  void check() const;

  // A line each: that of the columns that are not known, and that of times whose name is not read.
  std::vector<std::string> warnings() const;

 private:
  struct Unknown {
    std::size_t column = 0;
    std::array<std::string, 2> values;  // the first two that differ
    std::size_t kinds = 0;              // values that differ: 0, 1, 2; 3 for more
  };
  static void count(Unknown& unknown, std::string_view value);

  const CsvTable& table_;
  ReadColumns read_;
  std::vector<Unknown> unknown_;
  std::vector<std::size_t> times_;  // not read
};

}  // namespace lasso::sim
