// Messages of CCSDS in key-value notation (502.0-B, 504.0-B, section on syntax), of one segment: keys, and rows of data. Inside of scene.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "mdat/scene/ccsds.hpp"
#include "mdat/scene/problems.hpp"

namespace lasso::mdat::scene {

struct KvnRow {
  Epoch epoch;
  std::vector<double> numbers;
  int line = 0;
};

// A value in capitals, with one underscore for blanks and underscores in a row: they mean the same.
std::string kvn_word(std::string_view text);

class KvnMessage {
 public:
  // `kind` is OEM or AEM. What is wrong is added to `problems`, here and in all functions below.
  KvnMessage(std::string_view text, const std::string& file, const std::string& kind, Problems& problems);

  std::string value(const std::string& key) const;  // as kvn_word; "" where it is not written
  Place place(const std::string& key) const;        // of its line; of the file, where it is not written
  void complain(const std::string& key, const std::string& expected);
  // The value, if it is one of `choices`; "" and a problem where it is not, or where it is needed and not written.
  std::string choice(const std::string& key, const std::vector<std::string>& choices, bool needed);

  // The first of the keys' values that is one of `frames`; "" and problems where none is, or one of them is not written.
  std::string known_frame(const std::vector<std::string>& keys, const std::vector<std::string>& frames);

  // What both kinds say: version, time system, name; then the rows of an epoch and numbers, which are as many as one of `counts`.
  Ephemeris header(const std::vector<std::string>& versions);
  std::vector<KvnRow> rows(const std::vector<std::size_t>& counts, const std::string& columns);
  // The table's own problems; those of its degree at the line of `degree_key`. Throws MissionError, if there are any problems.
  void check(const MotionTable& table, const std::string& degree_key);

 private:
  struct Line {
    std::string_view text;
    int number = 0;
  };
  bool take_mark(std::string_view text, int number);
  void take_key(std::string_view text, int number);
  bool take_row(const Line& line, const std::vector<std::size_t>& counts, const std::string& columns, KvnRow& row);
  Place at(int line) const { return {file_, line, line > 0 ? 1 : 0}; }

  struct Value {
    std::string text;
    int line = 0;
  };
  std::string file_, kind_;
  Problems& problems_;
  std::map<std::string, Value> values_;
  std::vector<Line> lines_;
  bool has_data_ = false, in_covariance_ = false, ended_ = false;
};

}  // namespace lasso::mdat::scene
