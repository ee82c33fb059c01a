// Values changed in a mission's text: the result is read again by the TOML library, whose tables are the truth.
#include "mdat/missiondb/mission_edit.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mdat/missiondb/mission_diff.hpp"
#include "mdat/missiondb/value_row.hpp"
#include "mdat/source/mission_error.hpp"
#include "mdat/source/sha256.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

const std::string kText =
    "# a mission\n[scan] # the scan\npoints = 1024   # rays\nname = \"süß\" # two\nlist = [1,\n  2 ]  # of two\n"
    "inner = { a = 1, b = 2 } # both\nnone = {}\n# of the next table\n[scenario.spin]\nframes = 3\noverride.tracking.coast_frames = 2\n"
    "\n[scenario.paper.override]\nx = 1";

std::string value_in(const std::string& text, const std::string& key) {
  const auto span = span_of(text, key, "m.toml");
  return span ? text.substr(span->begin, span->end - span->begin) : "(none)";
}

TEST(MissionEdit, FindsEachValueByItsBytes) {
  VERIFIES("LASSO-GND-146~1");
  const std::pair<const char*, const char*> cases[] = {{"scan.points", "1024"},
                                                       {"scan.name", "\"süß\""},
                                                       {"scan.list", "[1,\n  2 ]"},
                                                       {"scan.inner.b", "2"},
                                                       {"scan.none", "{}"},
                                                       {"scenario.spin.override.tracking.coast_frames", "2"},
                                                       {"scenario.paper.override.x", "1"},
                                                       {"scan.other", "(none)"},
                                                       {"scan.points.x", "(none)"}};
  for (const auto& [key, value] : cases) EXPECT_EQ(value_in(kText, key), value) << key;
}

// Everything but the value's own characters stays.
TEST(MissionEdit, ReplacesAValueWhereItStands) {
  VERIFIES("LASSO-GND-146~1");
  for (const auto& [key, value, toml] :
       {std::tuple{"scan.points", "512", "512"}, std::tuple{"scan.name", "other", "\"other\""}, std::tuple{"scan.list", "[3]", "[3]"},
        std::tuple{"scan.inner.b", ".5", "0.5"}, std::tuple{"scenario.paper.override.x", "true", "true"}}) {
    const auto span = span_of(kText, key, "m.toml");
    ASSERT_TRUE(span.has_value()) << key;
    const std::string expected = kText.substr(0, span->begin) + toml + kText.substr(span->end);
    EXPECT_EQ(edited(kText, {std::string(key) + "=" + value}, "m.toml"), expected) << key;
  }
}

// A new value joins its table: below its last line, inside of its braces, or as a table at the end.
TEST(MissionEdit, AddsAValueWhereAPersonWould) {
  VERIFIES("LASSO-GND-146~1");
  const auto lines = [](const std::string& setting) { return changed_lines(kText, edited(kText, {setting}, "m.toml")); };
  EXPECT_EQ(lines("scan.pattern=rosette"), "9: +pattern = \"rosette\"\n");
  EXPECT_EQ(lines("scan.inner.c=3"), "7: -inner = { a = 1, b = 2 } # both\n7: +inner = { a = 1, b = 2, c = 3 } # both\n");
  EXPECT_EQ(lines("scan.none.c=3"), "8: -none = {}\n8: +none = {c = 3}\n");
  EXPECT_EQ(lines("scenario.spin.override.scan.points=7"), "13: +override.scan.points = 7\n");
  EXPECT_EQ(lines("scenario.paper.override.y=7"), "16: +y = 7\n");
  EXPECT_EQ(lines("scenario.paper.frames=7"), "16: +\n17: +[scenario.paper]\n18: +frames = 7\n");
  EXPECT_EQ(lines("filter.a=7"), "16: +\n17: +[filter]\n18: +a = 7\n");
}

TEST(MissionEdit, RefusesWhatHasNoPlaceAndLeavesTheText) {
  VERIFIES("LASSO-GND-146~1");
  for (const char* setting : {"scan=5", "=3", "scan.points", "scan.points.x=3", "alone=3", "scan.points=1\nother = 2"})
    EXPECT_THROW(static_cast<void>(edited(kText, {setting}, "m.toml")), MissionError) << setting;
  EXPECT_THROW(static_cast<void>(edited("[scan", {"scan.points=3"}, "m.toml")), MissionError);
}

TEST(MissionEdit, KeepsTheLineEndsOfTheFile) {
  VERIFIES("LASSO-GND-146~1");
  EXPECT_EQ(edited("[scan]\r\npoints = 1\r\n\r\n[b]\r\nc = 1\r\n", {"scan.margin=2"}, "m.toml"),
            "[scan]\r\npoints = 1\r\nmargin = 2\r\n\r\n[b]\r\nc = 1\r\n");
}

// Each flight parameter of each shipped mission, to another value of its range: the mission then has this value, no other one has
// changed, and setting it back restores the text where the value was written.
TEST(MissionEdit, ChangesOneValueOfShippedMissions) {
  VERIFIES("LASSO-GND-146~1");
  for (const char* name : {"hubble_tenth", "hubble_stereo"}) {
    const std::string text = read_file(kSourceFolder / "cfg/missions" / (std::string(name) + ".toml"));
    for (const ValueRow& row : flight_rows()) {
      const double value = row.preset.at(0) == row.minimum ? row.maximum : row.minimum;
      const std::string changed = edited(text, {row.key + "=" + toml_text(row, {value})}, "m.toml");
      EXPECT_EQ(value_in(changed, row.key), toml_text(row, {value}));
      EXPECT_EQ(std::count(changed.begin(), changed.end(), '#'), std::count(text.begin(), text.end(), '#')) << row.key;
      const std::string before = value_in(text, row.key);
      if (before != "(none)") {
        EXPECT_EQ(edited(changed, {row.key + "=" + before}, "m.toml"), text) << name << ' ' << row.key;
      }
    }
  }
}

std::string joined_settings(const std::string& before, const std::string& after) {
  const auto settings = settings_between(before, after, "m.toml");
  std::string text;
  for (const std::string& setting : settings.value_or(std::vector<std::string>{"(none)"})) text += (text.empty() ? "" : "; ") + setting;
  return text;
}

// What `edited` does is undone by what the two texts say of each other.
TEST(MissionEdit, SaysTheSettingsBetweenTwoTexts) {
  VERIFIES("LASSO-WEB-026~2");
  EXPECT_EQ(joined_settings(kText, kText), "");
  EXPECT_EQ(joined_settings(kText, "# other words\n" + kText), "");
  for (const char* setting : {"scan.points=512", "scan.name=other", "scan.name=\"7\"", "scan.list=[3]", "scan.inner={ a = 1, b = 3 }",
                              "scenario.paper.override.x=true", "filter.a=7.5", "filter.a=[0.15, 2.0, -3.0, 1e-07]",
                              "node.mine={ parent = \"root\", position_m = [1, 2.5, 3] }"})
    EXPECT_EQ(joined_settings(kText, edited(kText, {setting}, "m.toml")), setting);
  const std::string copied = kText + "\n[scenario.mine]\nframes = 3\noverride.tracking.coast_frames = 4\n";
  EXPECT_EQ(joined_settings(kText, copied), "scenario.mine.frames=3; scenario.mine.override.tracking.coast_frames=4");
  EXPECT_EQ(joined_settings(copied, kText), "(none)") << "nothing takes a value away";
  EXPECT_EQ(joined_settings("", "[a.\"b.c\"]\nx = 1\n"), "(none)") << "a name with a dot is no key of the command line";
  std::string many = "[a]\n";
  for (std::size_t i = 0; i <= kMostSettings; ++i) many += "k" + std::to_string(i) + " = 1\n";
  EXPECT_EQ(joined_settings("", many), "(none)");
  EXPECT_THROW(static_cast<void>(settings_between(kText, "[scan", "m.toml")), MissionError);
}

// The copy of a scenario, as the page makes it of the text, is what the command line makes of its settings.
TEST(MissionEdit, SettingsMakeACopiedScenarioOfAShippedMission) {
  VERIFIES("LASSO-WEB-026~2");
  const std::string text = read_file(kShippedMission);
  const std::size_t begin = text.find("[scenario.spin]"), end = text.find("\n[", begin);
  const std::string copied = text + "\n[scenario.mine]" + text.substr(begin + 15, end - begin - 15) + "\n";
  const auto settings = settings_between(text, copied, kShippedMission);
  ASSERT_TRUE(settings.has_value());
  ASSERT_GT(settings->size(), 1U);
  const std::string made = edited(text, *settings, kShippedMission);
  EXPECT_EQ(joined_settings(made, copied), "");
  EXPECT_EQ(joined_settings(copied, made), "");
}

TEST(MissionEdit, TellsWhatIsWrittenBelowATable) {
  VERIFIES("LASSO-WEB-026~2");
  const std::string text =
      "[campaign.a]\ncases = 7\ntruth = { range_m = { uniform = [1,\n 2] } }\n[campaign.a.knowledge]\n[scan]\npoints = 1\n";
  std::string told;
  for (const WrittenValueText& value : written_below(text, "campaign", "m.toml"))
    told += value.key + " " + value.toml + " " + std::to_string(value.line) + "; ";
  EXPECT_EQ(told, "campaign.a.cases 7 2; campaign.a.truth.range_m { uniform = [1, 2] } 3; ");
  EXPECT_TRUE(written_below(text, "material", "m.toml").empty());
}

TEST(MissionDiff, TellsWhatEitherHas) {
  VERIFIES("LASSO-GND-148~2");
  const std::vector<EffectiveValue> first{
      {"a", "1", "m", "", ""}, {"", "", "", "", ""}, {"b", "2", "", "", ""}, {"c", "3", "", "", ""}, {"e", "6", "", "as b", ""}};
  const std::vector<EffectiveValue> second{
      {"b", "2", "", "", ""}, {"c", "4", "", "", ""}, {"d", "5", "s", "", ""}, {"e", "7", "", "as b", ""}};
  std::string text;
  for (const ValueChange& change : changes_between(first, second))
    text += change.key + ":" + change.first + ">" + change.second + change.unit + " ";
  EXPECT_EQ(text, "a:1>m c:3>4 d:>5s ");
}

}  // namespace
}  // namespace lasso::mdat
