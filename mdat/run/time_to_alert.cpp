#include "mdat/run/time_to_alert.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

constexpr double kMsPerS = 1e3;

// Takes a number off the front.
template <class Number>
bool take_number(std::string_view& text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return error == std::errc{};
}

bool take_mark(std::string_view& text, char mark) {
  if (text.empty() || text.front() != mark) return false;
  text.remove_prefix(1);
  return true;
}

}  // namespace

std::vector<WrongEpisode> wrong_episodes(const std::vector<JudgedFrame>& flight, double end_s) {
  std::vector<WrongEpisode> episodes;
  bool is_wrong = false;
  for (const JudgedFrame& frame : flight) {
    if (frame.wrong && !is_wrong) episodes.push_back({frame.t_s, 0, true});
    if (!frame.wrong && is_wrong) episodes.back() = {episodes.back().begin_s, frame.t_s - episodes.back().begin_s, false};
    is_wrong = frame.wrong;
  }
  if (is_wrong) episodes.back().time_to_alert_s = std::max(end_s, flight.back().t_s) - episodes.back().begin_s;
  return episodes;
}

void AlertTimes::add(const WrongEpisode& episode) {
  ++counts_[{static_cast<std::int64_t>(std::llround(kMsPerS * episode.time_to_alert_s)), episode.censored}];
}

void AlertTimes::add(const std::vector<WrongEpisode>& episodes) {
  for (const WrongEpisode& episode : episodes) add(episode);
}

void AlertTimes::add(const AlertTimes& others) {
  for (const auto& [time, count] : others.counts_) counts_[time] += count;
}

AlertStatistics AlertTimes::statistics() const {
  AlertStatistics result;
  for (const auto& [time, count] : counts_) {
    result.episodes += count;
    result.censored += time.censored ? count : 0;
  }
  const std::size_t median = (result.episodes + 1) / 2, p95 = (95 * result.episodes + 99) / 100;  // ranks, from 1
  std::size_t below = 0;
  for (const auto& [time, count] : counts_) {
    const double time_s = static_cast<double>(time.ms) / kMsPerS;
    const auto holds = [&](std::size_t rank) { return below < rank && rank <= below + count; };
    if (holds(median)) result.median_s = time_s;
    if (holds(p95)) result.p95_s = time_s;
    result.worst_s = time_s;
    result.worst_is_censored = time.censored;
    below += count;
  }
  return result;
}

std::string AlertTimes::text() const {
  std::string text;
  for (const auto& [time, count] : counts_) {
    text += (text.empty() ? "" : " ") + std::to_string(time.ms) + (time.censored ? "+" : "");
    if (count > 1) text += "*" + std::to_string(count);
  }
  return text;
}

std::optional<AlertTimes> AlertTimes::of(std::string_view text) {
  AlertTimes times;
  for (std::string_view rest = text; !rest.empty();) {
    Time time{};
    std::size_t count = 1;
    if (!take_number(rest, time.ms)) return std::nullopt;
    time.censored = take_mark(rest, '+');
    if (take_mark(rest, '*') && !take_number(rest, count)) return std::nullopt;
    times.counts_[time] += count;
    if (!rest.empty() && !take_mark(rest, ' ')) return std::nullopt;
  }
  return times.text() == text ? std::optional(times) : std::nullopt;
}

}  // namespace lasso::mdat
