#include "mdat/run/time_to_alert.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

std::vector<JudgedFrame> flight_of(const std::string& judged, double period_s) {
  std::vector<JudgedFrame> flight;
  for (std::size_t i = 0; i < judged.size(); ++i) flight.push_back({period_s * static_cast<double>(i), judged[i] == 'w'});
  return flight;
}

TEST(WrongEpisodes, LastUntilTheFirstFrameThatIsNotWrong) {
  VERIFIES("LASSO-GND-130~1");
  const std::vector<WrongEpisode> episodes = wrong_episodes(flight_of("..www..w.", 0.2), 1.8);
  ASSERT_EQ(episodes.size(), 2U);
  EXPECT_DOUBLE_EQ(episodes[0].begin_s, 0.4);
  EXPECT_NEAR(episodes[0].time_to_alert_s, 0.6, 1e-12);
  EXPECT_FALSE(episodes[0].censored);
  EXPECT_NEAR(episodes[1].time_to_alert_s, 0.2, 1e-12);
  EXPECT_TRUE(wrong_episodes(flight_of("....", 0.2), 0.8).empty());
  EXPECT_TRUE(wrong_episodes({}, 0).empty());
}

TEST(WrongEpisodes, ThatTheFlightEndsInLastAtLeastUntilThen) {
  VERIFIES("LASSO-GND-130~1");
  const std::vector<WrongEpisode> episodes = wrong_episodes(flight_of("w.ww", 0.5), 2);
  ASSERT_EQ(episodes.size(), 2U);
  EXPECT_FALSE(episodes[0].censored);
  EXPECT_TRUE(episodes[1].censored);
  EXPECT_DOUBLE_EQ(episodes[1].time_to_alert_s, 1);
  EXPECT_DOUBLE_EQ(wrong_episodes(flight_of("w", 0.5), 0.5).at(0).time_to_alert_s, 0.5);
}

// What a flight says, by a search over all pairs of a first wrong frame and what follows it.
std::vector<double> times_by_search(const std::vector<JudgedFrame>& flight, double end_s, std::size_t& censored) {
  std::vector<double> times;
  for (std::size_t i = 0; i < flight.size(); ++i) {
    if (!flight[i].wrong || (i > 0 && flight[i - 1].wrong)) continue;
    const auto from = flight.begin() + static_cast<std::ptrdiff_t>(i);
    const auto end = std::find_if(from, flight.end(), [](const JudgedFrame& frame) { return !frame.wrong; });
    censored += end == flight.end() ? 1U : 0U;
    times.push_back((end == flight.end() ? end_s : end->t_s) - flight[i].t_s);
  }
  return times;
}

double at_rank(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  std::size_t rank = 0;  // the first of which at least this share is not above
  while (static_cast<double>(rank + 1) < share * static_cast<double>(values.size()) - 1e-9) ++rank;
  return values.at(rank);
}

struct Flight {
  std::vector<JudgedFrame> frames;
  double end_s = 0;
};

Flight random_flight(test::Generator& random) {
  Flight flight;
  const auto frames = static_cast<std::size_t>(1 + 60 * std::abs(random.uniform(0, 1)));
  const double change = random.uniform(0.05, 0.6);
  bool wrong = random.uniform(0, 1) < 0.3;
  for (std::size_t i = 0; i < frames; ++i) {
    wrong = random.uniform(0, 1) < change ? !wrong : wrong;
    flight.end_s += 1e-3 * std::round(random.uniform(50, 400));  // frames as far apart as they like
    flight.frames.push_back({flight.end_s, wrong});
  }
  flight.end_s += 0.1;
  return flight;
}

TEST(AlertTimes, AreThoseOfASearchThroughRandomFlights) {
  VERIFIES("LASSO-GND-130~1");
  test::Generator random(11);
  for (int round = 0; round < 200; ++round) {
    AlertTimes times;
    std::vector<double> expected;
    std::size_t censored = 0;
    for (int i = 0; i < 5; ++i) {
      const Flight flight = random_flight(random);
      times.add(wrong_episodes(flight.frames, flight.end_s));
      for (const double time_s : times_by_search(flight.frames, flight.end_s, censored)) expected.push_back(time_s);
    }
    const AlertStatistics statistics = times.statistics();
    ASSERT_EQ(statistics.episodes, expected.size());
    EXPECT_EQ(statistics.censored, censored);
    if (expected.empty()) continue;
    EXPECT_NEAR(statistics.median_s, at_rank(expected, 0.5), 5e-4);
    EXPECT_NEAR(statistics.p95_s, at_rank(expected, 0.95), 5e-4);
    EXPECT_NEAR(statistics.worst_s, *std::max_element(expected.begin(), expected.end()), 5e-4);
  }
}

TEST(AlertTimes, AreTheSameWhateverPartsTheyComeFrom) {
  VERIFIES("LASSO-GND-130~1");
  test::Generator random(12);
  AlertTimes whole, forwards, backwards;
  std::vector<AlertTimes> parts(7);
  for (std::size_t i = 0; i < 100; ++i) {
    const Flight flight = random_flight(random);
    whole.add(wrong_episodes(flight.frames, flight.end_s));
    parts[i % parts.size()].add(wrong_episodes(flight.frames, flight.end_s));
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    forwards.add(parts[i]);
    const std::optional<AlertTimes> read = AlertTimes::of(parts[parts.size() - 1 - i].text());
    ASSERT_TRUE(read);
    backwards.add(*read);
  }
  EXPECT_EQ(forwards, whole);
  EXPECT_EQ(backwards, whole);
  EXPECT_EQ(backwards.text(), whole.text());
  EXPECT_GT(whole.statistics().episodes, 300U);
}

TEST(AlertTimes, KeepWhatIsCensoredApart) {
  VERIFIES("LASSO-GND-130~1");
  AlertTimes times;
  EXPECT_TRUE(std::isnan(times.statistics().worst_s));
  for (const double time_s : {0.2, 0.4, 0.2, 0.2}) times.add(WrongEpisode{1, time_s, false});
  EXPECT_FALSE(times.statistics().worst_is_censored);
  times.add(WrongEpisode{1, 0.6, true});
  EXPECT_EQ(times.text(), "200*3 400 600+");
  EXPECT_TRUE(times.statistics().worst_is_censored);
  EXPECT_DOUBLE_EQ(times.statistics().median_s, 0.2);
  EXPECT_DOUBLE_EQ(times.statistics().p95_s, 0.6);
}

TEST(AlertTimes, AreReadFromTheirOwnTextAlone) {
  VERIFIES("LASSO-GND-130~1");
  EXPECT_EQ(AlertTimes::of(""), AlertTimes());
  for (const char* text : {"x", "200*", "200 x", "200+*x", "200,3", "200*3x", "200 "}) EXPECT_FALSE(AlertTimes::of(text)) << text;
}

}  // namespace
}  // namespace lasso::mdat
