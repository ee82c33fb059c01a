#include "mdat/missiondb/law_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "mdat/source/nearest.hpp"

namespace lasso::mdat {
namespace {

constexpr char kLaws[] =
    "expected a number or a law: { uniform = [LOW, HIGH] }, { log_uniform = [LOW, HIGH] }, { normal = [MEAN, SIGMA], within = [LOW, HIGH] "
    "} "
    "or { one_of = [VALUE, VALUE], weights = [3, 1] }";
constexpr double kMostSigmas = 6;  // that `within` may begin beside the mean: beyond is less than 1e-9 of the law

ValueRow pair_row(ValueRow row) {
  row.kind = ValueKind::kReals;
  row.count_min = row.count_max = 2;
  return row;
}

ValueRow numbers_row(double minimum, double maximum, std::size_t count, const char* meaning) {
  ValueRow row;
  row.kind = ValueKind::kReals;
  row.minimum = minimum;
  row.maximum = maximum;
  row.count_min = row.count_max = count;
  row.meaning = meaning;
  return row;
}

// One law's table.
class LawTable {
 public:
  LawTable(const toml::table& table, const ValueRow& row, const std::string& key, ProblemList& problems)
      : table_(table), row_(row), key_(key), problems_(problems) {}

  std::optional<NumberLaw> read() {
    if (!knows_all_keys()) return std::nullopt;
    if (row_.kind != ValueKind::kReal && table_.get("one_of") == nullptr)
      return complain(table_, "", "has no continuous law: list its values, { one_of = [VALUE, VALUE] }; " + expectation(row_));
    if (const toml::node* node = table_.get("uniform")) return uniform(*node);
    if (const toml::node* node = table_.get("log_uniform")) return log_uniform(*node);
    if (const toml::node* node = table_.get("normal")) return normal(*node);
    return one_of(*table_.get("one_of"));
  }

 private:
  // One law, and what belongs to it.
  bool knows_all_keys() {
    const std::vector<std::string> laws{"uniform", "log_uniform", "normal", "one_of"},
        all{"uniform", "log_uniform", "normal", "one_of", "within", "weights"};
    std::size_t given = 0;
    for (const auto& [key, node] : table_) {
      const std::string name(key.str());
      if (std::find(all.begin(), all.end(), name) == all.end()) {
        problems_.add(origin_of(key.source()), key_ + "." + name, "", "unknown law" + did_you_mean(name, all) + "; " + kLaws);
        return false;
      }
      if (std::find(laws.begin(), laws.end(), name) != laws.end()) ++given;
    }
    if (given != 1) return refuse(table_, "", std::string("expected exactly one law, not ") + std::to_string(given) + "; " + kLaws);
    return belongs("within", "normal") && belongs("weights", "one_of");
  }
  bool belongs(const char* name, const char* law) {
    const toml::node* node = table_.get(name);
    if (node == nullptr || table_.get(law) != nullptr) return true;
    return refuse(*node, std::string(".") + name, std::string("goes with ") + law + " alone: delete it");
  }
  bool refuse(const toml::node& node, const std::string& part, const std::string& why) {
    problems_.add(node, key_ + part, why);
    return false;
  }
  std::optional<NumberLaw> complain(const toml::node& node, const std::string& part, const std::string& why) {
    problems_.add(node, key_ + part, why);
    return std::nullopt;
  }

  // Two numbers in the row's range, the lower one first.
  std::optional<Span> pair(const toml::node& node, const char* name) {
    const auto found = read_value(node, pair_row(row_), key_ + "." + name, problems_);
    if (!found) return std::nullopt;
    if (found->numbers[0] < found->numbers[1]) return Span{found->numbers[0], found->numbers[1]};
    complain(node, std::string(".") + name, "expected the lower end first, then a higher one");
    return std::nullopt;
  }
  std::optional<NumberLaw> uniform(const toml::node& node) {
    const auto ends = pair(node, "uniform");
    return ends ? std::optional<NumberLaw>(Uniform{ends->low, ends->high}) : std::nullopt;
  }
  std::optional<NumberLaw> log_uniform(const toml::node& node) {
    const auto ends = pair(node, "log_uniform");
    if (!ends) return std::nullopt;
    if (!(ends->low > 0)) return complain(node, ".log_uniform", "expected numbers above 0: of others there is no logarithm");
    return LogUniform{ends->low, ends->high};
  }

  std::optional<NumberLaw> normal(const toml::node& node) {
    constexpr double kLargest = 1e12;
    const auto found = read_value(node, numbers_row(-kLargest, kLargest, 2, "mean and sigma"), key_ + ".normal", problems_);
    if (!found) return std::nullopt;
    Normal law{found->numbers[0], found->numbers[1], row_.minimum, row_.maximum};
    if (!(law.sigma > 0)) return complain(node, ".normal", "expected the mean and a sigma above 0");
    if (const toml::node* within = table_.get("within")) return cut_off(law, *within);
    return reaches_no_farther(law, node) ? std::optional<NumberLaw>(law) : std::nullopt;
  }
  std::optional<NumberLaw> cut_off(Normal law, const toml::node& node) {
    const auto ends = pair(node, "within");
    if (!ends) return std::nullopt;
    if (ends->low > law.mean + kMostSigmas * law.sigma || ends->high < law.mean - kMostSigmas * law.sigma)
      return complain(node, ".within", "is more than 6 sigma away from the mean, where nothing is drawn: expected numbers about the mean");
    law.low = ends->low;
    law.high = ends->high;
    return law;
  }
  bool reaches_no_farther(const Normal& law, const toml::node& node) {
    const double low = law.mean - kReach * law.sigma, high = law.mean + kReach * law.sigma;
    if (low >= row_.minimum && high <= row_.maximum) return true;
    const std::string from = low < row_.minimum ? number_text(row_.minimum) : rounded_text(low);
    const std::string to = high > row_.maximum ? number_text(row_.maximum) : rounded_text(high);
    const bool overlaps = low < row_.maximum && high > row_.minimum;
    problems_.add(origin_of(node.source()), key_ + ".normal", "[" + number_text(law.mean) + ", " + number_text(law.sigma) + "]",
                  "out of range: " + reach_text(law.mean, law.sigma) + ", expected " + range_text(row_) + " (" + row_.meaning +
                      "): " + (overlaps ? "cut it off by within = [" + from + ", " + to + "]" : "correct the mean"));
    return false;
  }

  std::optional<NumberLaw> one_of(const toml::node& node) {
    const toml::array* items = node.as_array();
    if (items == nullptr || items->empty()) return complain(node, ".one_of", "expected a list of one value or more");
    OneOf law;
    for (std::size_t i = 0; i < items->size(); ++i) {
      const auto value = read_value((*items)[i], row_, key_ + ".one_of[" + std::to_string(i) + "]", problems_);
      if (value) law.values.push_back(value->numbers[0]);
    }
    if (law.values.size() != items->size()) return std::nullopt;
    return weighted(law);
  }
  std::optional<NumberLaw> weighted(OneOf law) {
    constexpr double kLeast = 1e-9, kLargest = 1e9;
    law.weights.assign(law.values.size(), 1);
    const toml::node* node = table_.get("weights");
    if (node == nullptr) return law;
    const auto found = read_value(*node, numbers_row(kLeast, kLargest, law.values.size(), "one for each of one_of, of any sum"),
                                  key_ + ".weights", problems_);
    if (!found) return std::nullopt;
    law.weights = found->numbers;
    return law;
  }

  const toml::table& table_;
  const ValueRow& row_;
  const std::string& key_;
  ProblemList& problems_;
};

}  // namespace

std::optional<NumberLaw> read_law(const toml::node& node, ValueRow row, const std::string& key, ProblemList& problems) {
  if (row.kind == ValueKind::kReals) row.kind = ValueKind::kReal;
  if (const toml::table* table = node.as_table()) return LawTable(*table, row, key, problems).read();
  const bool may_be_text = row.kind == ValueKind::kChoice || row.kind == ValueKind::kBoolean;
  if (node.is_number() || may_be_text) {
    const auto value = read_value(node, row, key, problems);
    return value ? std::optional<NumberLaw>(Fixed{value->numbers[0]}) : std::nullopt;
  }
  problems.add(node, key, std::string("wrong type: ") + kLaws);
  return std::nullopt;
}

std::string rounded_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string reach_text(double mean, double sigma) {
  return "reaches from " + rounded_text(mean - kReach * sigma) + " to " + rounded_text(mean + kReach * sigma) + " (mean and 4 sigma)";
}

Span span_of(const NumberLaw& law) {
  return std::visit(LawVisitor{[](const Fixed& l) {
                                 return Span{l.value, l.value};
                               },
                               [](const OneOf& l) {
                                 const auto [low, high] = std::minmax_element(l.values.begin(), l.values.end());
                                 return Span{*low, *high};
                               },
                               [](const Normal& l) {
                                 return Span{std::max(l.low, l.mean - kReach * l.sigma), std::min(l.high, l.mean + kReach * l.sigma)};
                               },
                               [](const auto& l) {
                                 return Span{l.low, l.high};
                               }},
                    law);
}

}  // namespace lasso::mdat
