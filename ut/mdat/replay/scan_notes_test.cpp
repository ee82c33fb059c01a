#include "mdat/replay/scan_notes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

sim::ScanFacts spanning(double first, double last) {
  sim::ScanFacts facts;
  facts.hits = facts.kept_hits = 10;
  facts.has_times = true;
  facts.first_time = first;
  facts.last_time = last;
  return facts;
}

// 0.18 s a scan; a sensor that takes a third, or thrice as long, is no other unit.
TEST(ScanNotes, TheUnitOfTimesIsTheOneWhoseSpanIsClosest) {
  VERIFIES("LASSO-MDT-070~1");
  const struct {
    double span, unit_s;
  } cases[] = {{0.18, 1}, {0.06, 1}, {0.54, 1}, {5, 1}, {180, 1e-3}, {60, 1e-3}, {540, 1e-3}, {180e3, 1e-6}, {180e6, 1e-9}, {0, 1}};
  for (const auto& c : cases) {
    const std::vector<sim::ScanFacts> facts = {spanning(7, 7), spanning(1e3, 1e3 + c.span), spanning(2e3, 2e3 + c.span)};
    EXPECT_EQ(time_unit_s(facts, 0.18), c.unit_s) << c.span;
  }
  sim::ScanFacts named = spanning(0, 180);
  named.unit_s = 1e-3;
  EXPECT_EQ(time_unit_s({named}, 0.18), 1) << "of others: this one's header says it";
}

TEST(ScanNotes, SecondsThatAreNamedGiveWayToTheSameSpanInAnotherUnitAlone) {
  VERIFIES("LASSO-MDT-070~1");
  const struct {
    double span, unit_s;
    std::size_t warnings;
  } cases[] = {{0.18, 1, 0}, {5, 1, 0},      {0.02, 1, 0},   {10, 1, 1},     {60, 1, 1},
               {144, 1, 1},  {160, 1e-3, 0}, {180, 1e-3, 0}, {210, 1e-3, 0}, {180e6, 1e-9, 0}};
  for (const auto& c : cases) {
    std::vector<sim::ScanFacts> facts = {spanning(0, c.span)};
    facts[0].seconds_named = true;
    EXPECT_EQ(time_unit_s(facts, 0.18), c.unit_s) << c.span;
    const Notes notes = time_unit_note(facts, 0.18, c.unit_s);
    const auto warns = [](const std::string& note) { return note.starts_with("warning: the scans' times are taken as seconds"); };
    EXPECT_EQ(static_cast<std::size_t>(std::count_if(notes.begin(), notes.end(), warns)), c.warnings) << c.span;
  }
}

TEST(ScanNotes, TimesInMinutesAreTold) {
  VERIFIES("LASSO-MDT-070~1");
  const std::vector<sim::ScanFacts> facts = {spanning(7, 7.003)};  // of 0.18 s
  EXPECT_EQ(time_unit_s(facts, 0.18), 1) << "told, and not taken so";
  const Notes notes = time_unit_note(facts, 0.18, 1);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("spans 0.003 of them"), std::string::npos) << notes[0];
  EXPECT_NE(notes[0].find("--time-unit min"), std::string::npos) << notes[0];
  EXPECT_TRUE(time_unit_note({spanning(7, 7.001)}, 0.18, 1).empty()) << "a third of the mission's, in minutes";
}

TEST(ScanNotes, SayWhatWasLeftOut) {
  VERIFIES("LASSO-MDT-070~1");
  EXPECT_TRUE(row_notes({spanning(0, 1)}).empty());
  sim::ScanFacts organised = spanning(0, 1);
  organised.unmeasured = 6;
  organised.viewpoint = true;
  sim::ScanFacts dense = spanning(0, 1);
  dense.hits = 10000;
  dense.kept_hits = 3072;
  dense.misses = 20000;
  dense.kept_misses = 1024;
  const Notes notes = row_notes({organised, dense, spanning(0, 1)});
  ASSERT_EQ(notes.size(), 3U);
  EXPECT_EQ(notes[0], "note: 6 of 30026 rows have no measurement (NaN or zeros; in 1 of 3 scans): they are left out, and are no misses");
  EXPECT_EQ(
      notes[1],
      "note: 1 of 3 scans thinned to 4096 rays: of the largest 3072 of 10000 returns are taken, spread over the target, and 1024 of 20000 "
      "misses, those around them");
  EXPECT_EQ(notes[2].find("note: VIEWPOINT of 1 of 3 scans"), 0U);
}

TEST(ScanNotes, WarnOfWhatTheReadersWarnOfAndOfDirections) {
  VERIFIES("LASSO-MDT-124~1");
  sim::ScanFacts odd = spanning(0, 1);
  odd.warnings = {{"b.csv:1:9", "column"}};
  odd.directions = 4;
  sim::ScanFacts other = odd;
  other.warnings = {{"c.csv:1:9", "column"}, {"c.csv:1:3", "times"}};
  const Notes notes = row_notes({spanning(0, 1), odd, other});
  ASSERT_EQ(notes.size(), 3U);
  EXPECT_EQ(notes[0], "warning: b.csv:1:9: column (warned of 2 of 3 scans)");
  EXPECT_EQ(notes[1], "warning: c.csv:1:3: times (warned of 1 of 3 scans)");
  EXPECT_EQ(notes[2].find("warning: 8 of 30 returns have the length 1, as directions have (in 2 of 3 scans)"), 0U) << notes[2];
}

}  // namespace
}  // namespace lasso::mdat
