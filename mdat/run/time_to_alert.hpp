// How long a wrong pose is called valid, before the component says that it is not, or it is right again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lasso::mdat {

// One frame of a flight, in the order of their times.
struct JudgedFrame {
  double t_s = 0;
  bool wrong = false;  // its pose is valid and wrong
};

// Frames one after the other whose poses are valid and wrong.
struct WrongEpisode {
  double begin_s = 0;          // time of the first one
  double time_to_alert_s = 0;  // from there to the first frame that is none: without a valid pose, or right again
  bool censored = false;       // the flight ended before there was one, so that the time is at least this
};

// All of a flight that ends at `end_s`, where its next frame would have begun.
std::vector<WrongEpisode> wrong_episodes(const std::vector<JudgedFrame>& flight, double end_s);

// Of many episodes; a censored one counts with the time that it has lasted at least. Percentiles by nearest rank, the lower median.
struct AlertStatistics {
  std::size_t episodes = 0, censored = 0;
  double median_s = std::numeric_limits<double>::quiet_NaN(), p95_s = median_s, worst_s = median_s;  // of no episode, not numbers
  bool worst_is_censored = false;                                                                    // of equal ones, any
};

// Times to alert of any number of flights, as counts of milliseconds. So those of all flights are the same whatever parts they are put
// together from, and in which order.
class AlertTimes {
 public:
  void add(const WrongEpisode& episode);
  void add(const std::vector<WrongEpisode>& episodes);
  void add(const AlertTimes& others);
  AlertStatistics statistics() const;

  // "200*3 400 600+": three times 200 ms, 400 ms, at least 600 ms (censored).
  std::string text() const;
  // Nothing where it is not what text() writes.
  static std::optional<AlertTimes> of(std::string_view text);

  bool operator==(const AlertTimes&) const = default;

 private:
  struct Time {
    std::int64_t ms;
    bool censored;
    auto operator<=>(const Time&) const = default;
  };
  std::map<Time, std::size_t> counts_;
};

}  // namespace lasso::mdat
