#include "mdat/scene/ccsds_epoch.hpp"

#include <charconv>
#include <chrono>

namespace lasso::mdat::scene {
namespace {

constexpr double kSecondsPerDay = 86400;

// `digits` digits and nothing else.
std::optional<unsigned> take_digits(std::string_view& text, std::size_t digits) {
  unsigned value = 0;
  if (text.size() < digits) return std::nullopt;
  const std::string_view part = text.substr(0, digits);
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
  if (error != std::errc() || end != part.data() + part.size()) return std::nullopt;
  text.remove_prefix(digits);
  return value;
}

bool take(std::string_view& text, char expected) {
  if (!text.starts_with(expected)) return false;
  text.remove_prefix(1);
  return true;
}

// Month and day, or the day of the year.
std::optional<std::chrono::sys_days> take_date(std::string_view& text) {
  using namespace std::chrono;
  const auto year_number = take_digits(text, 4);
  if (!year_number || !take(text, '-')) return std::nullopt;
  const year in(static_cast<int>(*year_number));
  if (text.size() > 3 && text[3] == 'T') {
    const auto day_number = take_digits(text, 3);
    if (!day_number || *day_number < 1 || *day_number > (in.is_leap() ? 366U : 365U)) return std::nullopt;
    return sys_days{in / January / 1} + days{*day_number - 1};
  }
  const auto month_number = take_digits(text, 2);
  if (!month_number || !take(text, '-')) return std::nullopt;
  const auto day_number = take_digits(text, 2);
  if (!day_number) return std::nullopt;
  const year_month_day date = in / month{*month_number} / day{*day_number};
  return date.ok() ? std::optional<sys_days>(date) : std::nullopt;
}

// ss[.d...]
std::optional<double> take_second(std::string_view& text) {
  double second = 0;
  if (text.size() < 2 || text[0] < '0' || text[0] > '5') return std::nullopt;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), second, std::chars_format::fixed);
  const auto length = static_cast<std::size_t>(end - text.data());
  if (error != std::errc() || length < 2 || (length > 2 && text[2] != '.')) return std::nullopt;
  text.remove_prefix(length);
  return second;
}

}  // namespace

std::optional<Epoch> parse_epoch(std::string_view text) {
  const auto date = take_date(text);
  if (!date || !take(text, 'T')) return std::nullopt;
  const auto hour = take_digits(text, 2);
  if (!hour || *hour > 23 || !take(text, ':')) return std::nullopt;
  const auto minute = take_digits(text, 2);
  if (!minute || *minute > 59 || !take(text, ':')) return std::nullopt;
  const auto second = take_second(text);
  if (!second || (!text.empty() && text != "Z")) return std::nullopt;
  return Epoch{date->time_since_epoch().count(), 3600.0 * *hour + 60.0 * *minute + *second};
}

double seconds_between(const Epoch& from, const Epoch& to) {
  return kSecondsPerDay * static_cast<double>(to.day - from.day) + (to.second - from.second);
}

}  // namespace lasso::mdat::scene
