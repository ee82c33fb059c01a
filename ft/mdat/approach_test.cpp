// An approach through the modes, by its results.
#include <gtest/gtest.h>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

const std::string kFullSize = source_path("cfg/missions/hubble.toml");

// "to" of each change of the mode, in order.
std::vector<std::string> modes_of(const Json& timeline) {
  std::vector<std::string> modes;
  for (const Json& change : timeline.at("changes")) modes.push_back(change.at("to"));
  return modes;
}

// Of the first change to the mode after `from_s`; -1: none.
double time_of(const Json& timeline, const std::string& mode, double from_s = 0) {
  for (const Json& change : timeline.at("changes")) {
    const double t_s = change.at("t_s");
    if (change.at("to") == mode && t_s > from_s) return t_s;
  }
  return -1;
}

// The shipped approach, flown once for all tests that look at it.
struct Flight {
  Flight() : answer(work.mdat("run " + kFullSize + " --scenario approach --out out")) {
    if (answer.exit_code == 0) timeline = Json::parse(work.read("out/results.json")).at("timeline");
  }
  WorkFolder work;
  Answer answer;
  Json timeline;
};

const Flight& approach() {
  static const Flight flight;
  return flight;
}

// The whole flight: bearing, search, tracking by the LIDAR, a loss and its recovery, the laser camera, the parts, and all the way back.
TEST(Approach, RunsThroughAllModesWithTwoSensorsAndRecoversFromAnEclipse) {
  VERIFIES(
      "LASSO-MOD-174~2 LASSO-SYS-014~2 LASSO-GND-026~1 LASSO-SIM-034~1 LASSO-SIM-035~1 LASSO-MDT-004~1 LASSO-SNS-041~1 LASSO-SNS-046~1");
  ASSERT_EQ(approach().answer.exit_code, 0) << approach().answer.err;
  const Json& timeline = approach().timeline;
  const std::vector<std::string> expected = {"bearing",     "searching", "starting",    "tracking", "coasting",
                                             "reacquiring", "tracking",  "short_range", "tracking"};
  EXPECT_EQ(modes_of(timeline), expected);
  EXPECT_LT(time_of(timeline, "tracking"), 15) << "found without help";
  EXPECT_NEAR(time_of(timeline, "coasting"), 60.2, 0.4) << "the eclipse begins at 60 s";
  EXPECT_NEAR(time_of(timeline, "tracking", 60), 65.2, 0.6) << "and ends at 65 s";
  EXPECT_LE(timeline.at("wrong"), 1);
  EXPECT_GT(timeline.at("valid"), 1340);
  const Json& tracking = timeline.at("by_mode").at("tracking");
  EXPECT_EQ(tracking.at("valid"), tracking.at("frames")) << "no frame is lost at a change of the sensor";
  EXPECT_LT(tracking.at("filtered").at("rms_mm").get<double>(), 2.5);
  EXPECT_LT(tracking.at("filtered").at("rms_deg").get<double>(), 0.04);
  const Json& near = timeline.at("by_mode").at("short_range").at("filtered");
  EXPECT_LT(near.at("rms_mm").get<double>(), 5);
  EXPECT_LT(near.at("rms_deg").get<double>(), 0.1);
  for (const char* part : {"whole", "aft_bulkhead", "array_boom", "equipment_bay"})
    EXPECT_TRUE(timeline.at("by_part").contains(part)) << part;
}

TEST(Approach, SaysInWordsThatNoPoseIsValid) {
  VERIFIES("LASSO-GND-026~1");
  const WorkFolder work;
  const Answer answer = work.mdat("run " + kFullSize + " --scenario approach --frames 3 --out out");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_NE(answer.out.find("no valid pose in 2 frames"), std::string::npos) << answer.out;
  EXPECT_EQ(answer.out.find("rms 0.00 mm"), std::string::npos);
  EXPECT_TRUE(Json::parse(work.read("out/results.json")).at("timeline").at("rms_mm").is_null());
}

// Twenty random attitudes, each start turned end for end.
TEST(Approach, AStartHalfATurnOffIsNeverConfirmed) {
  VERIFIES("LASSO-MOD-182~2");
  const WorkFolder work;
  const Answer answer = work.mdat("run " + kFullSize + " --scenario half_turn --no-report --out out");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const Json noisy = Json::parse(work.read("out/results.json")).at("noisy");
  EXPECT_EQ(noisy.at("frames"), 800);
  EXPECT_EQ(noisy.at("wrong"), 0) << "a start that was confirmed would be";
  EXPECT_GT(noisy.at("invalid"), 400) << "what is valid was found by a search";
}

// Twenty random attitudes of the tenth-scale target, each start turned by 150 deg: what a scan would confirm a search of it contradicts.
// Then the target is searched, and all are tracked.
TEST(Approach, AStartThatItsScanWouldConfirmIsContradictedAndTheTargetFound) {
  VERIFIES("LASSO-MOD-184~5 LASSO-MOD-182~2");
  const WorkFolder work;
  const Answer answer = work.mdat("run " + source_path("cfg/missions/hubble_tenth.toml") + " --scenario wrong_start --no-report --out out");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_NE(answer.out.find("with noise: tracked in the last frame 20 of 20 runs"), std::string::npos) << answer.out;
  const Json results = Json::parse(work.read("out/results.json"));
  EXPECT_EQ(results.at("noisy").at("wrong"), 0);
  EXPECT_LT(results.at("noisy").at("invalid"), FIXED_POINT ? 1400 : 800) << "of 2400: starting, and some 25 frames of bearing and search";
}

TEST(Approach, TheRangeChangesTheSensorInBothDirectionsAndTheReportShowsIt) {
  VERIFIES("LASSO-MOD-174~2 LASSO-GND-026~1 LASSO-SNS-042~1");
  ASSERT_EQ(approach().answer.exit_code, 0) << approach().answer.err;
  const Json& changes = approach().timeline.at("sensor_changes");
  ASSERT_EQ(changes.size(), 2U) << "once each way: the bands overlap";
  EXPECT_EQ(changes[0].at("to"), "laser_camera");
  EXPECT_NEAR(changes[0].at("range_m").get<double>(), 16, 0.2);
  EXPECT_EQ(changes[1].at("to"), "time_of_flight");
  EXPECT_NEAR(changes[1].at("range_m").get<double>(), 18, 0.2);
  EXPECT_EQ(changes[1].at("reason"), "in_band");
  const std::string report = approach().work.read("out/report.html");
  for (const char* shown : {"Through the modes", "<svg", "found near the prediction", "close by: its parts in turn", "equipment bay",
                            "another sensor takes the scans, at 16.0 m", "<img"}) {
    EXPECT_NE(report.find(shown), std::string::npos) << shown;
  }
  EXPECT_NE(approach().answer.out.find("sensor laser_camera after time_of_flight"), std::string::npos) << approach().answer.out;
}

TEST(Approach, TimesThatContradictTheRangesAreRefused) {
  VERIFIES("LASSO-SIM-035~1");
  const struct {
    const char *before, *after, *said;
  } cases[] = {{"times_s = [0.0, ", "times_s = [", "expected one for each of ranges_m"},
               {"times_s = [0.0, 15.0, ", "times_s = [15.0, 15.0, ", "expected more than the time before it"},
               {"eclipse_s = [60.0, 65.0]", "eclipse_s = [65.0, 60.0]", "expected an end that is not before the begin"}};
  for (const auto& c : cases) {
    const WorkFolder work;
    std::string text = read_text(kFullSize);
    const std::size_t place = text.find(c.before);
    ASSERT_NE(place, std::string::npos) << c.before;
    work.write("missions/approach.toml", text.replace(place, std::string(c.before).size(), c.after));
    const Answer answer = work.mdat("mission check missions/approach.toml");
    EXPECT_NE(answer.exit_code, 0) << c.after;
    EXPECT_NE(answer.err.find(c.said), std::string::npos) << answer.err;
  }
}

TEST(Approach, AWayThatBeginsBeyondTheReachOfTheSensorsIsDoubtful) {
  VERIFIES("LASSO-SIM-035~1");
  const WorkFolder work;
  std::string text = read_text(kFullSize);
  work.write("missions/approach.toml", text.replace(text.find("ranges_m = [60.0"), sizeof("ranges_m = [60.0") - 1, "ranges_m = [600.0"));
  const Answer answer = work.mdat("mission check missions/approach.toml");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_NE((answer.out + answer.err).find("ranges nothing is measured: expected between sensor.range_min_m and sensor.range_max_m"),
            std::string::npos)
      << answer.out << answer.err;
}

}  // namespace
}  // namespace lasso::ft
