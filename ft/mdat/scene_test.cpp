// Scenes of a mission's nodes, flown and drawn.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

const std::string kScenes = R"(
[motion.spin]
kind = "rates"
position_m = [0.02, -0.01, 4.0]
quaternion = [-0.088182217301, -0.096234003384, -0.669810439735, 0.730969826988]
spin_degps = [5, 0, 0]

[motion.before]             # a screen that stands between sensor and target from 4 s on
kind = "waypoints"
at = [{time_s = 3.5, position_m = [3, 0, 2]}, {time_s = 4, position_m = [0, 0, 2]}]

[node.telescope]
target = true
motion = "spin"

[node.screen]
model = "models/probe.toml"
scale = 4
motion = "before"

[node.camera]
sensor = true

[scenario.screened]
frames = 40
override.tracking.start_sigma_m = 0.02
override.tracking.start_sigma_deg = 2.0

[scenario.checked]
)";

// missions/test.toml, with these scenes.
void write_scenes(const WorkFolder& work) {
  work.write_mission({{"\n[scenario.checked]\n", kScenes}});
  work.write("models/probe.toml", read_text(source_path("cfg/models/probe.toml")));
}

// Columns of a CSV text by their names, as numbers.
class Columns {
 public:
  explicit Columns(const std::string& text) : lines_(lines_of(text)), names_(fields_of(lines_.at(0))) {}
  std::size_t rows() const { return lines_.size() - 1; }
  double at(const std::string& name, std::size_t row) const {
    const auto column = static_cast<std::size_t>(std::find(names_.begin(), names_.end(), name) - names_.begin());
    return std::stod(fields_of(lines_.at(row + 1)).at(column));
  }

 private:
  std::vector<std::string> lines_, names_;
};

// Its target is the one of the scenario spin, but for the screen.
TEST(SceneRun, FliesTheNodesOfAMission) {
  VERIFIES("LASSO-SCN-020~2 LASSO-SCN-021~1");
  const WorkFolder work;
  write_scenes(work);
  const Answer answer = work.mdat("run missions/test.toml --scenario screened --out out/run --no-report");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const Columns frames(work.read("out/run/frames.csv"));
  for (std::size_t frame = 2; frame < 17; ++frame) EXPECT_EQ(frames.at("valid", frame), 1) << frame;
  for (std::size_t frame = 22; frame < 40; ++frame) EXPECT_EQ(frames.at("valid", frame), 0) << frame;
  const Json results = Json::parse(work.read("out/run/results.json"));
  EXPECT_EQ(results.at("timeline").at("wrong"), 0);
  EXPECT_LT(results.at("timeline").at("rms_mm").get<double>(), 0.5);
}

// A wall of points, each a disc that overlaps the next.
std::string wall_of_points() {
  std::string rows;
  int count = 0;
  for (int x = -30; x <= 30; ++x) {
    for (int y = -30; y <= 30; ++y, ++count) rows += std::to_string(0.05 * x) + " " + std::to_string(0.05 * y) + " 0 0 0 -2\n";
  }
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count) +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\nproperty float nz\nend_header\n" +
         rows;
}

TEST(SceneRun, LasersMeetClouds) {
  VERIFIES("LASSO-SCN-033~1");
  const WorkFolder work;
  std::string scenes = kScenes;
  const std::string probe = "model = \"models/probe.toml\"\nscale = 4\n";
  scenes.replace(scenes.find(probe), probe.size(), "points = \"models/wall.ply\"\ndisc_radius_m = 0.04\n");
  work.write_mission({{"\n[scenario.checked]\n", scenes}});
  work.write("models/wall.ply", wall_of_points());
  const Answer answer = work.mdat("run missions/test.toml --scenario screened --frames 26 --out out/run --no-report");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const Columns frames(work.read("out/run/frames.csv"));
  for (std::size_t frame = 2; frame < 17; ++frame) EXPECT_EQ(frames.at("valid", frame), 1) << frame;
  for (std::size_t frame = 22; frame < 26; ++frame) EXPECT_EQ(frames.at("valid", frame), 0) << frame;
}

// A hundredth of the range beside the sensor frame, and turned by 6 deg: a laser camera that is in use all the time.
TEST(SceneRun, ASensorBesideTheSensorFrameTracks) {
  VERIFIES("LASSO-SCN-034~1");
  const WorkFolder work;
  write_scenes(work);
  const Answer answer = work.mdat(
      "run missions/test.toml --scenario screened --frames 18 --out out/run --no-report --set sensor.use_from_m=10 "
      "--set 'node.mast={parent=\"camera\", position_m=[0.03, 0.02, -0.05], quaternion=[0.0, -0.0523359562, 0.0, 0.9986295348]}' "
      "--set 'further_sensor.side={node=\"mast\", use_to_m=10, fov_half_x_deg=20, fov_half_y_deg=20}'");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const Json timeline = Json::parse(work.read("out/run/results.json")).at("timeline");
  EXPECT_GE(timeline.at("valid"), 14);
  EXPECT_EQ(timeline.at("wrong"), 0);
  EXPECT_LT(timeline.at("rms_mm").get<double>(), 1);
  const std::vector<std::string> lines = lines_of(work.read("out/run/frames.csv"));
  EXPECT_EQ(std::count_if(lines.begin(), lines.end(), [](const std::string& line) { return line.find(",side,") != std::string::npos; }),
            18);
}

// The ground's table of a handle on the target in a port beside the camera, and what the component reports of the same.
void expect_equal(const Columns& table, const Columns& told, std::size_t row) {
  constexpr double kDegPerRad = 180 / 3.14159265358979323846;
  const std::string axes[] = {"x", "y", "z"}, variances[] = {"covariance_15", "covariance_18", "covariance_20"};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string& axis = axes[i];
    const std::string term = "_" + std::to_string(i);
    EXPECT_NEAR(table.at(axis + "_m", row), told.at("p_in_of_m" + term, row), 1e-8);
    EXPECT_NEAR(table.at("q" + axis, row), told.at("q_in_of" + term, row), 1e-8);
    EXPECT_NEAR(table.at("filtered_" + axis + "_m", row), told.at("filter_p_in_of_m" + term, row), 1e-8);
    EXPECT_NEAR(table.at("v" + axis + "_mps", row), told.at("filter_v_mps" + term, row), 1e-8);
    EXPECT_NEAR(table.at("w" + axis + "_degps", row), told.at("filter_omega_radps" + term, row) * kDegPerRad, 1e-6);
    const double sigma_mm = table.at("sigma_" + axis + "_mm", row);
    EXPECT_NEAR(sigma_mm, 1e3 * std::sqrt(told.at(variances[i], row)), 1e-5 * sigma_mm);
  }
}

TEST(SceneRun, ItsComponentTellsPosesBetweenNamedFramesAsTheGroundFindsThem) {
  VERIFIES("LASSO-LNK-050~1");
  const WorkFolder work;
  write_scenes(work);
  const Answer answer = work.mdat(
      "run missions/test.toml --scenario screened --frames 14 --out out/run --no-report "
      "--set 'node.port={parent=\"camera\", position_m=[0.3, -0.2, -0.5], quaternion=[0.1, -0.5, 0.1, 0.8544003745]}' "
      "--set 'node.handle={parent=\"telescope\", position_m=[-0.4, 0.1, 0.2], quaternion=[0.5, 0.5, -0.5, 0.5]}' "
      "--set 'relative.grasp={of=\"handle\", in=\"port\"}'");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const Answer decoded = work.mdat("decode out/run/telemetry.ccsds --packet named_pose --format csv");
  ASSERT_EQ(decoded.exit_code, 0) << decoded.err;
  const Columns table(work.read("out/run/relative.csv")), told(decoded.out);
  ASSERT_EQ(told.rows(), table.rows());
  ASSERT_GE(told.rows(), 10U);
  for (std::size_t row = 0; row < told.rows(); ++row) expect_equal(table, told, row);
  EXPECT_GT(std::abs(told.at("filter_v_mps_1", told.rows() - 1)), 1e-3) << "the handle moves round the pivot";
}

// With the offers of a navigation system.
TEST(SceneRun, StartsByItselfWhereItIsAutonomous) {
  VERIFIES("LASSO-SCN-031~1");
  const WorkFolder work;
  write_scenes(work);
  const Answer answer =
      work.mdat("run missions/test.toml --scenario screened --set scenario.screened.autonomous=true --out out --no-report");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const Json timeline = Json::parse(work.read("out/results.json")).at("timeline");
  EXPECT_GE(timeline.at("valid"), 15);
  EXPECT_EQ(timeline.at("wrong"), 0);
  std::string changes;
  for (const Json& change : timeline.at("changes")) changes += change.at("event").get<std::string>() + " ";
  EXPECT_EQ(changes.find("seek start pose_valid"), 0U) << changes;
}

// Of a run of fewer scans than six, each is shown.
TEST(SceneRun, ItsReportShowsWhatTheSensorsSaw) {
  VERIFIES("LASSO-PIC-017~1");
  const WorkFolder work;
  write_scenes(work);
  const Answer answer = work.mdat("run missions/test.toml --scenario screened --frames 2 --out out/run");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const std::string report = work.read("out/run/report.html");
  const std::size_t seen = report.find("What the sensors see");
  ASSERT_NE(seen, std::string::npos);
  std::size_t pictures = 0;
  for (std::size_t at = report.find("<figcaption>", seen); at < report.find("</section>", seen); at = report.find("<figcaption>", at + 1))
    ++pictures;
  EXPECT_EQ(pictures, 2U);
}

TEST(SceneRun, NamesThePartsOfItsNodesForPictures) {
  VERIFIES("LASSO-PIC-016~1");
  const WorkFolder work;
  write_scenes(work);
  const std::string render = "render missions/test.toml --scenario screened --size 64x64 --samples 1 --force --material ";
  EXPECT_EQ(work.mdat(render + "screen.bus=mli").exit_code, 0);
  const Answer other = work.mdat(render + "screen.bux=mli");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find("did you mean screen.bus?"), std::string::npos) << other.err;
}

TEST(SceneRun, NamesEveryProblemAndLeavesNothing) {
  VERIFIES("LASSO-SCN-024~1");
  const WorkFolder work;
  work.write_mission({{"\n[scenario.checked]\n", "\n[node.a]\nparent = \"b\"\nmotion = \"c\"\n\n[scenario.checked]\n"}});
  const std::vector<std::string> before = work.contents();
  const Answer answer = work.mdat("run missions/test.toml --scenario paper --out out/run");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_NE(answer.err.find("node.a.motion: \"c\": the mission has no [motion.c]"), std::string::npos) << answer.err;
  EXPECT_NE(answer.err.find("node.a.parent: \"b\": there is no such node"), std::string::npos) << answer.err;
  EXPECT_EQ(work.contents(), before);
}

}  // namespace
}  // namespace lasso::ft
