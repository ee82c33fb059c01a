#include "mdat/campaign/level_counts.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>

namespace lasso::mdat {
namespace {

constexpr int kParts = 8;  // of a factor of two
constexpr double kEdges[kParts] = {1.0,
                                   1.0905077326652577,
                                   1.1892071150027210,
                                   1.2968395546510096,
                                   1.4142135623730951,
                                   1.5422108254079407,
                                   1.6817928305074290,
                                   1.8340080864093424};  // 2^(i / 8): constants, as logarithms are not the same everywhere
constexpr double kHalfPart = 1.0442737824274138;         // 2^(1 / 16)
constexpr double kHalfRatioPart = 1.0905077326652577;    // 2^(1 / 8)
constexpr int kRatioStep = 2;                            // parts of a ratio's cell
constexpr int kLeastLevel = -24 * kParts, kMostLevel = 12 * kParts - 1;
constexpr int kLeastRatio = -6 * kParts / kRatioStep, kMostRatio = 10 * kParts / kRatioStep - 1;

// The largest n with 2^(n / 8) <= value, within the ends.
int part_of(double value, int least, int most) {
  if (!(value > 0)) return least;
  if (!std::isfinite(value)) return most;
  int exponent = 0;
  const double mantissa = 2 * std::frexp(value, &exponent);  // 1 to 2
  const auto part = std::upper_bound(std::begin(kEdges), std::end(kEdges), mantissa) - std::begin(kEdges);
  return std::clamp(kParts * (exponent - 1) + static_cast<int>(part) - 1, least, most);
}

// 2^(part / 8).
double edge_of(int part) {
  const int exponent = part >= 0 ? part / kParts : -((kParts - 1 - part) / kParts);
  return std::ldexp(kEdges[part - kParts * exponent], exponent);
}

int ratio_part(double level, double error) {
  const int eighth = part_of(error / level, kLeastRatio * kRatioStep, kMostRatio * kRatioStep + 1);
  const int part = (eighth - kLeastRatio * kRatioStep) / kRatioStep + kLeastRatio;
  return error > level ? std::max(part, 0) : std::min(part, -1);
}

bool take_digits(std::string_view& text, auto& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return error == std::errc{};
}

bool take_letter(std::string_view& text, char letter) {
  if (text.empty() || text.front() != letter) return false;
  text.remove_prefix(1);
  return true;
}

}  // namespace

void LevelCounts::add(double level, double error) { ++counts_[{part_of(level, kLeastLevel, kMostLevel), ratio_part(level, error)}]; }

void LevelCounts::add(const LevelCounts& others) {
  for (const auto& [place, count] : others.counts_) counts_[place] += count;
}

std::size_t LevelCounts::poses() const {
  std::size_t sum = 0;
  for (const auto& [place, count] : counts_) sum += count;
  return sum;
}

std::size_t LevelCounts::misleading() const {
  std::size_t sum = 0;
  for (const auto& [place, count] : counts_) sum += place.ratio >= 0 ? count : 0;
  return sum;
}

double LevelCounts::median() const {
  const std::size_t rank = (poses() + 1) / 2;
  std::size_t sum = 0;
  for (const auto& [place, count] : counts_) {
    sum += count;
    if (sum >= rank) return edge_of(place.level) * kHalfPart;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::vector<LevelCounts::Cell> LevelCounts::cells() const {
  std::vector<Cell> cells;
  for (const auto& [place, count] : counts_) {
    const double level = edge_of(place.level) * kHalfPart;
    cells.push_back({level, level * edge_of(kRatioStep * place.ratio) * kHalfRatioPart, count, place.ratio >= 0});
  }
  return cells;
}

std::string LevelCounts::text() const {
  std::string text;
  std::optional<int> level;
  for (const auto& [place, count] : counts_) {
    if (level == place.level) {
      text += "/";
    } else {
      text += (text.empty() ? "" : " ") + std::to_string(place.level) + ":";
    }
    level = place.level;
    text += std::to_string(place.ratio);
    if (count > 1) text += "*" + std::to_string(count);
  }
  return text;
}

std::optional<LevelCounts> LevelCounts::of(std::string_view text) {
  LevelCounts counts;
  Place place{};
  for (std::string_view rest = text; !rest.empty();) {
    std::size_t count = 1;
    if (!take_letter(rest, '/')) {
      take_letter(rest, ' ');
      if (!take_digits(rest, place.level) || !take_letter(rest, ':')) return std::nullopt;
    }
    if (!take_digits(rest, place.ratio)) return std::nullopt;
    if (take_letter(rest, '*') && !take_digits(rest, count)) return std::nullopt;
    counts.counts_[place] += count;
  }
  return counts.text() == text ? std::optional(counts) : std::nullopt;
}

}  // namespace lasso::mdat
