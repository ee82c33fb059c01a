// Columns of a table of rays that are not read: which of them are common beside coordinates, and which may say what the rows mean.
#pragma once

#include <array>
#include <limits>
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
  // Throws ScanFileError of a second column with the name of one that is read.
  OtherColumns(const CsvTable& table, const ReadColumns& read);

  // Takes in the row that stands in the table, and how far its point is, in the file's unit; of rows with a measurement alone.
  void look_at_row(double length);

  // Throws ScanFileError where returns are not known from misses and a column that is not known may tell them apart. It has two values, and
  // is named so, or the points of one value are all 1 long to two decimals, as directions are, or all nearer or farther than the others, as
  // directions and greatest ranges are.
  void check() const;

  // Of the columns that are not known, and of times whose name is not read.
  std::vector<ScanWarning> warnings() const;

 private:
  struct Kind {
    std::string value;
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0;  // of the rows with this value
  };
  struct Unknown {
    std::size_t column = 0;
    bool named_so = false;      // by a word for returns or misses
    std::array<Kind, 2> kinds;  // of the first two values that differ
    std::size_t values = 0;     // that differ: 0, 1, 2; 3 for more
  };
  bool is_read(std::size_t column) const;
  static void take(Unknown& unknown, std::string_view value, double length);
  static bool may_tell_misses(const Unknown& unknown);

  const CsvTable& table_;
  ReadColumns read_;
  std::vector<Unknown> unknown_;
  std::vector<std::size_t> times_;  // not read
};

}  // namespace lasso::sim
