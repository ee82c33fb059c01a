#include "mdat/missiondb/toml_reader.hpp"

#include <algorithm>
#include <cmath>
#include <regex>
#include <sstream>

#include "mdat/missiondb/old_keys.hpp"
#include "mdat/source/nearest.hpp"
#include "mdat/source/sha256.hpp"

namespace lasso::mdat {
namespace {

std::string shortened(std::string text) {
  constexpr std::size_t kLongest = 60;
  std::replace(text.begin(), text.end(), '\n', ' ');
  if (text.size() > kLongest) text.replace(kLongest, std::string::npos, "...");
  return text;
}

std::string as_written(const toml::node& node) {
  if (node.is_table()) return "a table";
  if (node.is_array_of_tables()) return "an array of tables";
  std::ostringstream stream;
  if (const auto* array = node.as_array()) {
    stream << *array;
  } else {
    node.visit([&](const auto& value) {
      if constexpr (toml::is_value<decltype(value)>) stream << value;
    });
  }
  return shortened(stream.str());
}

// What is expected, and what it means where a row says so.
std::string described(const ValueRow& row) { return expectation(row) + (row.meaning.empty() ? "" : " (" + row.meaning + ")"); }

std::optional<double> number_of(const toml::node& node, bool whole) {
  if (const auto integer = node.value_exact<std::int64_t>()) return static_cast<double>(*integer);
  if (whole) return std::nullopt;
  return node.value_exact<double>();
}

bool in_range(const ValueRow& row, double value) { return value >= row.minimum && value <= row.maximum; }

std::optional<FoundValue> read_number(const toml::node& node, const ValueRow& row, const std::string& key, ProblemList& problems) {
  const std::optional<double> value = number_of(node, row.kind == ValueKind::kInteger);
  if (!value) {
    problems.add(node, key, "wrong type: " + expectation(row));
  } else if (!std::isfinite(*value)) {
    problems.add(node, key, "not a finite number: " + expectation(row));
  } else if (!in_range(row, *value)) {
    problems.add(node, key, "out of range: " + described(row));
  } else {
    return FoundValue{{*value}, {}, origin_of(node.source())};
  }
  return std::nullopt;
}

using ReadItem = std::optional<FoundValue> (*)(const toml::node&, const ValueRow&, const std::string&, ProblemList&);

// Each item of the list by itself: its numbers and texts one behind the other.
std::optional<FoundValue> read_items(const toml::array& array, const ValueRow& row, const std::string& key, ReadItem read,
                                     ProblemList& problems) {
  FoundValue found{{}, {}, origin_of(array.source())};
  for (std::size_t i = 0; i < array.size(); ++i) {
    const auto item = read(array[i], row, key + "[" + std::to_string(i) + "]", problems);
    if (!item) return std::nullopt;
    found.numbers.insert(found.numbers.end(), item->numbers.begin(), item->numbers.end());
    found.texts.insert(found.texts.end(), item->texts.begin(), item->texts.end());
  }
  return found;
}

std::optional<FoundValue> read_list(const toml::node& node, const ValueRow& row, const std::string& key, ProblemList& problems) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() < row.count_min || array->size() > row.count_max) {
    problems.add(node, key, expectation(row));
    return std::nullopt;
  }
  return read_items(*array, row, key, read_number, problems);
}

std::optional<FoundValue> read_text(const toml::node& node, const ValueRow& row, const std::string& key, ProblemList& problems) {
  const auto text = node.value_exact<std::string>();
  if (!text || !std::regex_match(*text, std::regex(row.pattern))) {
    problems.add(node, key, described(row));
    return std::nullopt;
  }
  return FoundValue{{}, {*text}, origin_of(node.source())};
}

// One text, or a list of them where the row takes several.
std::optional<FoundValue> read_texts(const toml::node& node, const ValueRow& row, const std::string& key, ProblemList& problems) {
  const toml::array* array = row.count_max > 1 ? node.as_array() : nullptr;
  if (array == nullptr) return read_text(node, row, key, problems);
  if (array->empty() || array->size() > row.count_max) {
    problems.add(node, key, described(row));
    return std::nullopt;
  }
  return read_items(*array, row, key, read_text, problems);
}

std::optional<FoundValue> read_choice(const toml::node& node, const ValueRow& row, const std::string& key, ProblemList& problems) {
  const auto text = node.value_exact<std::string>();
  const auto found = std::find(row.choices.begin(), row.choices.end(), text.value_or(""));
  if (!text || found == row.choices.end()) {
    const std::string meant = nearest(text.value_or(""), row.choices);
    problems.add(node, key, expectation(row) + (meant.empty() ? "" : "; did you mean \"" + meant + "\"?"));
    return std::nullopt;
  }
  return FoundValue{{static_cast<double>(found - row.choices.begin())}, {}, origin_of(node.source())};
}

std::optional<FoundValue> read_boolean(const toml::node& node, const ValueRow& row, const std::string& key, ProblemList& problems) {
  const auto value = node.value_exact<bool>();
  if (!value) {
    problems.add(node, key, "wrong type: " + expectation(row));
    return std::nullopt;
  }
  return FoundValue{{*value ? 1.0 : 0.0}, {}, origin_of(node.source())};
}

bool contains(const std::vector<std::string>& keys, const std::string& key) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

// One pass over a table and the tables in it.
class TableWalk {
 public:
  TableWalk(const std::string& prefix, const std::vector<ValueRow>& rows, const std::vector<std::string>& others, ProblemList& problems)
      : prefix_(prefix), rows_(rows), others_(others), problems_(problems) {}

  void walk(const toml::table& table, const std::string& path) {
    for (const auto& [key, node] : table) visit(key, node, path + std::string(key.str()));
  }
  void require(const toml::table& table) {
    for (const ValueRow& row : rows_) {
      if (row.required && !table.at_path(row.key)) {
        problems_.add(origin_of(table.source()), prefix_ + row.key, "", "is missing: " + described(row));
      }
    }
  }
  FoundValues found;

 private:
  void visit(const toml::key& key, const toml::node& node, const std::string& path) {
    if (key.str().find('.') != std::string_view::npos) return unknown(key, path);  // a quoted key is not a path
    if (contains(others_, path)) return;
    if (const ValueRow* row = find_row(rows_, path)) {
      const auto value = read_value(node, *row, prefix_ + path, problems_);
      if (value) found.emplace(path, *value);
    } else if (is_section(path)) {
      visit_section(node, path);
    } else {
      unknown(key, path);
    }
  }
  void visit_section(const toml::node& node, const std::string& path) {
    if (const toml::table* table = node.as_table()) return walk(*table, path + ".");
    problems_.add(node, prefix_ + path, "wrong type: expected a table [" + prefix_ + path + "]");
  }
  bool is_section(const std::string& path) const {
    const auto begins = [&](const std::string& key) { return key.rfind(path + ".", 0) == 0; };
    return std::any_of(others_.begin(), others_.end(), begins) ||
           std::any_of(rows_.begin(), rows_.end(), [&](const ValueRow& row) { return begins(row.key); });
  }
  void unknown(const toml::key& key, const std::string& path) {
    std::vector<std::string> candidates = others_;
    for (const ValueRow& row : rows_) {
      candidates.push_back(row.key);
      const auto dot = row.key.rfind('.');
      if (dot != std::string::npos) candidates.push_back(row.key.substr(0, dot));
    }
    const std::string old = remedy_of_old_key(path);
    if (!old.empty()) return problems_.add(origin_of(key.source()), prefix_ + path, "", old);
    const std::string meant = nearest(path, candidates);
    const std::string remedy =
        meant.empty() ? "see cfg/mission.schema.json for the keys that exist" : "did you mean " + prefix_ + meant + "?";
    problems_.add(origin_of(key.source()), prefix_ + path, "", "unknown key; " + remedy);
  }

  const std::string& prefix_;
  const std::vector<ValueRow>& rows_;
  const std::vector<std::string>& others_;
  ProblemList& problems_;
};

// What somebody may have meant who gave a file of another kind.
std::string other_kind_of(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  if (ending == ".3dli") return "; a flight image: give the mission file that it was compiled from";
  if (ending == ".toml" || ending.empty()) return "";
  return "; of a mesh, make a mission first: mdat mission new --model " + file.string() + " --out MISSION.toml";
}

}  // namespace

Origin origin_of(const toml::source_region& region) {
  if (region.path && *region.path == kSettingPlace) return {0, 0, true};
  return {static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

void ProblemList::add(Origin origin, const std::string& key, const std::string& value, const std::string& expected) {
  problems_.push_back({origin.set ? kSettingPlace : file_, origin.line, origin.column, key, value, expected});
}

void ProblemList::add(const toml::node& node, const std::string& key, const std::string& expected) {
  add(origin_of(node.source()), key, as_written(node), expected);
}

void ProblemList::throw_if_any() const {
  if (!problems_.empty()) throw MissionError(problems_);
}

toml::table parse_toml_text(const std::string& text, const std::filesystem::path& file) {
  ProblemList problems(file);
  try {
    if (text.size() <= kMaxTomlBytes) return toml::parse(text, file.string());
    problems.add({}, "", std::to_string(text.size()) + " bytes",
                 "expected a TOML file of at most " + std::to_string(kMaxTomlBytes) + " bytes" + other_kind_of(file));
  } catch (const toml::parse_error& error) {
    problems.add(origin_of(error.source()), "", "", "not valid TOML: " + std::string(error.description()) + other_kind_of(file));
  }
  problems.throw_if_any();
  return {};
}

toml::table parse_toml(const std::filesystem::path& file) {
  std::string text;
  try {
    text = read_file(file);
  } catch (const std::runtime_error& error) {
    ProblemList problems(file);
    problems.add({}, "", "", error.what());
    problems.throw_if_any();
  }
  return parse_toml_text(text, file);
}

std::vector<std::string> texts_of(const FoundValues& found, const std::string& key) {
  const auto value = found.find(key);
  return value == found.end() ? std::vector<std::string>{} : value->second.texts;
}

std::optional<FoundValue> read_value(const toml::node& node, const ValueRow& row, const std::string& key, ProblemList& problems) {
  switch (row.kind) {
    case ValueKind::kBoolean:
      return read_boolean(node, row, key, problems);
    case ValueKind::kChoice:
      return read_choice(node, row, key, problems);
    case ValueKind::kText:
      return read_texts(node, row, key, problems);
    case ValueKind::kReals:
      return read_list(node, row, key, problems);
    case ValueKind::kReal:
    case ValueKind::kInteger:
      break;
  }
  return read_number(node, row, key, problems);
}

void for_each_table(const toml::table& root, const std::string& section, ProblemList& problems,
                    const std::function<void(const std::string&, const toml::table&)>& read) {
  const toml::node* node = root.get(section);
  if (node == nullptr) return;
  if (!node->is_table()) return problems.add(*node, section, "wrong type: expected tables [" + section + ".NAME]");
  for (const auto& [name, entry] : *node->as_table()) {
    const std::string path = section + "." + std::string(name.str());
    if (const toml::table* table = entry.as_table()) {
      read(std::string(name.str()), *table);
    } else {
      problems.add(entry, path, "wrong type: expected a table [" + path + "]");
    }
  }
}

FoundValues read_table(const toml::table& table, const std::string& prefix, const std::vector<ValueRow>& rows,
                       const std::vector<std::string>& others, ProblemList& problems) {
  TableWalk walk(prefix, rows, others, problems);
  walk.walk(table, "");
  walk.require(table);
  return std::move(walk.found);
}

}  // namespace lasso::mdat
