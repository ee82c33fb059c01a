// Reading TOML tables by rows: every key is known, every value of its type and range, every problem with its place. Inside of missiondb.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mdat/missiondb/mission_source.hpp"
#include "mdat/missiondb/value_row.hpp"

namespace lasso::mdat {

Origin origin_of(const toml::source_region& region);

// The problems of one file, and of those that it names.
class ProblemList {
 public:
  explicit ProblemList(const std::filesystem::path& file) : file_(file.string()) {}
  void add(Origin origin, const std::string& key, const std::string& value, const std::string& expected);
  void add(const toml::node& node, const std::string& key, const std::string& expected);  // the value as written
  void add(const MissionError& error) {
    problems_.insert(problems_.end(), error.problems().begin(), error.problems().end());
  }  // of other files
  bool empty() const { return problems_.empty(); }
  std::size_t size() const { return problems_.size(); }
  void throw_if_any() const;

 private:
  std::string file_;
  std::vector<Problem> problems_;
};

// A value in the row's unit: numbers, 0/1, position of the choice; or texts.
struct FoundValue {
  std::vector<double> numbers;
  std::vector<std::string> texts;
  Origin origin;
};
using FoundValues = std::map<std::string, FoundValue>;

// Of a text's row; none where it is not written.
std::vector<std::string> texts_of(const FoundValues& found, const std::string& key);

// Throws MissionError: the file cannot be read, is larger than kMaxTomlBytes, or is not TOML.
constexpr std::size_t kMaxTomlBytes = 1u << 20;
toml::table parse_toml(const std::filesystem::path& file);
// The same of a text; problems name `file`.
toml::table parse_toml_text(const std::string& text, const std::filesystem::path& file);

// The value of `node`, if it is what `row` says; otherwise a problem under the name `key`.
std::optional<FoundValue> read_value(const toml::node& node, const ValueRow& row, const std::string& key, ProblemList& problems);

// All rows found in `table` (its dotted path `prefix`, with a final dot, or ""), by the rows' keys. Keys in `others` (dotted paths in
// the table) are left to the caller. Unknown keys and missing required ones are problems.
FoundValues read_table(const toml::table& table, const std::string& prefix, const std::vector<ValueRow>& rows,
                       const std::vector<std::string>& others, ProblemList& problems);

// The tables [SECTION.NAME] of a mission, each to `read` with its name. A section or an entry of it that is no table is a problem.
void for_each_table(const toml::table& root, const std::string& section, ProblemList& problems,
                    const std::function<void(const std::string&, const toml::table&)>& read);

}  // namespace lasso::mdat
