#include "mdat/missiondb/campaign_rows.hpp"

#include "mdat/missiondb/figure_names.hpp"

namespace lasso::mdat {
namespace {

constexpr double kMostCases = 1e7, kMostFrames = 1e6, kLargestSeed = 4294967295.0, kLargestFigure = 1e12;
constexpr std::size_t kMostTogether = 64;  // columns of one covariance

ValueRow plain_row(const char* key, ValueKind kind, double minimum, double maximum, std::vector<double> preset, const char* meaning) {
  ValueRow row;
  row.key = key;
  row.kind = kind;
  row.minimum = minimum;
  row.maximum = maximum;
  row.required = preset.empty();
  row.preset = std::move(preset);
  row.meaning = meaning;
  return row;
}

ValueRow optional(ValueRow row) {
  row.required = false;
  return row;
}

ValueRow text(const char* key, const char* pattern, std::size_t count_max, const char* meaning) {
  ValueRow row = plain_row(key, ValueKind::kText, 0, 0, {}, meaning);
  row.pattern = pattern;
  row.count_max = count_max;
  return row;
}

ValueRow choice(ValueRow row, std::vector<std::string> choices) {
  row.kind = ValueKind::kChoice;
  row.maximum = static_cast<double>(choices.size() - 1);
  row.choices = std::move(choices);
  return row;
}

}  // namespace

const std::vector<ValueRow>& campaign_rows() {
  constexpr ValueKind kInteger = ValueKind::kInteger;
  // clang-format off
  static const std::vector<ValueRow> rows = {
    text("scenario", "[^\\x00-\\x1f]+", 1, "the scenario that each case flies, with values of its own"),
    plain_row("cases", kInteger, 1, kMostCases, {}, "number of cases; with look_every: at most"),
    plain_row("seed", kInteger, 0, kLargestSeed, {1}, "start of all random numbers: the same seed draws the same cases"),
    plain_row("frames", kInteger, 0, kMostFrames, {0}, "frames of a case; 0: as the scenario says"),
    choice(plain_row("sampling", kInteger, 0, 0, {0}, "random: independent cases; latin_hypercube: each of as many strata as there are cases holds one of them, in each column; sobol: quasi-random, best with 2^k cases"), {"random", "latin_hypercube", "sobol"}),
    choice(plain_row("sensor", kInteger, 0, 0, {0}, "simulated, or at the end of its line: lcs-wire, lidar-wire, tridar-wire"), {"simulated", "lcs-wire", "lidar-wire", "tridar-wire"}),
    plain_row("look_every", kInteger, 0, kMostCases, {0}, "the stopping rule looks after each so many cases; 0: all are flown"),
  };
  // clang-format on
  return rows;
}

const std::vector<ValueRow>& criterion_rows() {
  constexpr ValueKind kReal = ValueKind::kReal;
  // clang-format off
  static const std::vector<ValueRow> rows = {
    choice(plain_row("figure", kReal, 0, 0, {}, "of a case: a column of its results"), {std::begin(kFigureNames), std::end(kFigureNames)}),
    optional(plain_row("at_least", kReal, -kLargestFigure, kLargestFigure, {}, "the case is good if its figure is not less")),
    optional(plain_row("at_most", kReal, -kLargestFigure, kLargestFigure, {}, "the case is good if its figure is not more")),
    plain_row("share_min", kReal, 0, 1, {}, "share of all possible cases that have to be good, below 1: no number of cases shows that all are"),
    plain_row("confidence", kReal, 0.5, 1, {0.95}, "of the limits by which it is decided, above 0.5 and below 1"),
  };
  // clang-format on
  return rows;
}

const std::vector<ValueRow>& together_rows() {
  constexpr double kLargest = 1e12;
  ValueRow mean = optional(plain_row("mean", ValueKind::kReals, -kLargest, kLargest, {}, "of each of the keys, in its unit"));
  mean.count_max = kMostTogether;
  // clang-format off
  static const std::vector<ValueRow> rows = {
    optional(text("keys", "[^\\x00-\\x1f]+", kMostTogether, "columns that are normal together, such as truth.offset_m.x")),
    mean,
    optional(text("table", "[^\\x00-\\x1f]+", 1, "CSV file whose columns are named as the keys, from the mission's folder or the one above")),
    choice(plain_row("rows", ValueKind::kInteger, 0, 0, {0}, "in_order: case k takes row k, and begins anew after the last; drawn: each row is as likely as any other"), {"in_order", "drawn"}),
  };
  // clang-format on
  return rows;
}

}  // namespace lasso::mdat
