// An approach through the modes, by its results.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

using Json = nlohmann::json;

const std::string kMission = std::string(MDAT_SOURCES) + "/cfg/missions/hubble.toml";

// "to" of each change of the mode, in order.
std::vector<std::string> modes_of(const Json& timeline) {
  std::vector<std::string> modes;
  for (const Json& change : timeline.at("changes")) modes.push_back(change.at("to"));
  return modes;
}

double time_of(const Json& timeline, const std::string& mode) {
  double t_s = -1;
  for (const Json& change : timeline.at("changes")) {
    if (change.at("to") == mode) t_s = change.at("t_s");
  }
  return t_s;
}

TEST(Approach, BeginsWithTheBearingAndRecoversFromAnEclipse) {
  VERIFIES("LASSO-SIM-034~1 LASSO-SIM-035~1 LASSO-MDT-004~1");
  const WorkFolder work;
  const Answer answer = work.mdat("run " + kMission + " --scenario approach --frames 280 --out out");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const Json timeline = Json::parse(work.read("out/results.json")).at("timeline");
  const std::vector<std::string> expected = {"bearing", "starting", "tracking", "coasting", "reacquiring", "tracking"};
  EXPECT_EQ(modes_of(timeline), expected);
  EXPECT_GT(time_of(timeline, "starting"), 4) << "no pose is offered before";
  EXPECT_NEAR(time_of(timeline, "coasting"), 45.2, 0.4) << "the eclipse begins at 45 s";
  EXPECT_NEAR(time_of(timeline, "tracking"), 50.2, 0.6) << "and ends at 50 s";
  EXPECT_EQ(timeline.at("wrong"), 0);
  EXPECT_GT(timeline.at("valid"), 220);
  EXPECT_LT(timeline.at("rms_mm").get<double>(), 10);
  const std::string report = work.read("out/report.html");
  EXPECT_NE(report.find("Through the modes"), std::string::npos);
  EXPECT_NE(report.find("<svg"), std::string::npos);
  EXPECT_NE(report.find("found near the prediction"), std::string::npos) << "each change with its meaning";
  EXPECT_NE(answer.out.find("found near the prediction"), std::string::npos);
}

TEST(Approach, TimesThatContradictTheRangesAreRefused) {
  VERIFIES("LASSO-SIM-035~1");
  const struct {
    const char *before, *after, *said;
  } cases[] = {{"times_s = [0.0, ", "times_s = [", "expected one for each of ranges_m"},
               {"times_s = [0.0, 60.0, ", "times_s = [60.0, 60.0, ", "expected more than the time before it"},
               {"eclipse_s = [45.0, 50.0]", "eclipse_s = [50.0, 45.0]", "expected an end that is not before the begin"},
               {"ranges_m = [60.0", "ranges_m = [600.0", "expected between sensor.range_min_m and sensor.range_max_m"}};
  for (const auto& c : cases) {
    const WorkFolder work;
    std::string text = read_text(kMission);
    const std::size_t place = text.find(c.before);
    ASSERT_NE(place, std::string::npos) << c.before;
    work.write("missions/approach.toml", text.replace(place, std::string(c.before).size(), c.after));
    const Answer answer = work.mdat("mission check missions/approach.toml");
    EXPECT_NE(answer.exit_code, 0) << c.after;
    EXPECT_NE(answer.err.find(c.said), std::string::npos) << answer.err;
  }
}

}  // namespace
}  // namespace lasso::ft
