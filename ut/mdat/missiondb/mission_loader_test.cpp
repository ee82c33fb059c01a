#include <algorithm>
#include <cmath>
#include <limits>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/missiondb/mission_source.hpp"
#include "mdat/missiondb/value_row.hpp"
#include "mdat/source/sha256.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

const std::string kHead = "[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmodel = 'box.toml'\n";  // 6 lines

class Missions : public ::testing::Test {
 protected:
  Missions() {
    folder.write("box.toml",
                 "[parameters.width]\npreset = 1\nminimum = 0.5\nmaximum = 2\nunit = 'm'\nmeaning = 'width'\n"
                 "[[part]]\nkind = 'box'\nsize = ['width', 1, 1]\n");
  }
  MissionSource load(const std::string& text) { return load_mission(folder.write("m.toml", text)); }
  std::string error(const std::string& text) {
    return mission_error_of([&] { static_cast<void>(load(text)); });
  }
  void expect_error(const std::string& text, const std::string& expected) {
    const std::string message = error(text);
    EXPECT_NE(message.find(expected), std::string::npos) << "got: " << message << "\nexpected: " << expected;
  }
  Folder folder;
};

// `key = value` as TOML with its section, on line 2.
std::string assignment(const std::string& key, const std::string& value) {
  const auto dot = key.rfind('.');
  return "[" + key.substr(0, dot) + "]\n" + key.substr(dot + 1) + " = " + value + "\n";
}

std::size_t lines_of(const std::string& text) { return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1; }

TEST_F(Missions, PresetsHoldWhereNothingIsWritten) {
  VERIFIES("LASSO-GND-001~1 LASSO-GND-002~1");
  const MissionSource source = load(kHead);
  EXPECT_EQ(source.id, 7u);
  EXPECT_EQ(source.version, 2u);
  EXPECT_EQ(source.name, "test");
  EXPECT_EQ(source.target.scale, 1);
  EXPECT_EQ(source.target.cell_size_m, 0.012);
  const MissionParameters presets = preset_parameters();
  for (const ParameterRow& row : parameter_rows()) {
    EXPECT_EQ(source.parameters.*row.member, presets.*row.member) << row.key;
    EXPECT_TRUE(source.origins.at(row.key).preset()) << row.key;
  }
}

TEST_F(Missions, ALidarHasPresetsOfItsOwnWhereNothingIsWritten) {
  VERIFIES("LASSO-GND-001~1 LASSO-SIM-033~1");
  const std::string scenario = "[scenario.s]\nranges_m = [40]\n";
  const MissionSource lidar = load(kHead + "[sensor]\nkind = 'time_of_flight'\nrange_max_m = 80\n" + scenario);
  EXPECT_EQ(lidar.sensor, SensorKind::kTimeOfFlight);
  EXPECT_EQ(lidar.parameters.sigma0_m, 0.02);
  EXPECT_EQ(lidar.parameters.sigma_k_per_m, 5e-7);
  EXPECT_EQ(lidar.parameters.range_min_m, 1);
  EXPECT_EQ(lidar.parameters.range_max_m, 80);  // written
  EXPECT_EQ(lidar.parameters.fov_half_x_rad, preset_parameters().fov_half_x_rad);
  EXPECT_EQ(lidar.scenarios.at("s").sigma0_m, 0.02);  // as the estimator assumes
  EXPECT_EQ(lidar.scenarios.at("s").beam_divergence_rad, 2.5e-4);
  EXPECT_EQ(load(kHead + "[sensor]\nkind = 'time_of_flight'\n" + scenario + "beam_divergence_rad = 0.001\n")
                .scenarios.at("s")
                .beam_divergence_rad,
            0.001);
  const MissionSource camera = load(kHead + "[sensor]\nkind = 'laser_camera'\n[scenario.s]\nranges_m = [4]\n");
  EXPECT_EQ(camera.sensor, SensorKind::kLaserCamera);
  EXPECT_EQ(camera.parameters.sigma0_m, preset_parameters().sigma0_m);
  EXPECT_EQ(camera.scenarios.at("s").beam_divergence_rad, 0);
  expect_error(kHead + "[sensor]\nkind = 'sonar'\n", "sensor.kind");
}

TEST_F(Missions, EveryParameterIsReadConvertedAndItsLineKnown) {
  VERIFIES("LASSO-GND-001~1 LASSO-GND-002~1");
  for (const ParameterRow& row : parameter_rows()) {
    const std::string key = row.key;
    if (key.rfind("tracking.initial.q", 0) == 0 || key == "scan.cycles_b" || key == "scan.cycles_a") continue;  // not free of each other
    if (key == "sensor.range_min_m" || key == "scan.duration_s" || key == "filter.period_s") continue;
    const double value = key == "scan.points" || key == "sensor.range_max_m" || key == "sensor.use_to_m" ? row.maximum : row.minimum;
    const bool is_inliers = key == "tracking.inliers_min";
    const MissionSource source = load(kHead + assignment(key, toml_text(value_row(row), {is_inliers ? 12 : value})));
    EXPECT_NEAR(source.parameters.*row.member, value * row.to_si, 1e-12 * std::fabs(value)) << key;
    EXPECT_EQ(source.origins.at(key).line, 8) << key;
  }
}

TEST_F(Missions, EveryParameterIsRefusedOutOfItsRangeAndOfAnotherType) {
  VERIFIES("LASSO-GND-003~1");
  for (const ParameterRow& row : parameter_rows()) {
    const std::string place = "m.toml:8:", key = row.key;
    for (const double value : {row.minimum - 0.5 * (1 + std::fabs(row.minimum)), row.maximum + 0.5 * (1 + std::fabs(row.maximum))}) {
      const std::string text = number_text(row.kind == ParameterKind::kInteger ? std::round(value) : value);
      const std::string message = error(kHead + assignment(key, text));
      EXPECT_NE(message.find(place), std::string::npos) << message;
      EXPECT_NE(message.find(key + ": " + text.substr(0, 4)), std::string::npos) << message;
    }
    for (const char* text : {"[1, 2]", "{a = 1}", "'wrong'", "nan", "1979-05-27"}) {
      const std::string message = error(kHead + assignment(key, text));
      EXPECT_NE(message.find(key), std::string::npos) << key << " = " << text << ": " << message;
    }
  }
  expect_error(kHead + "[scan]\npoints = 1024.0\n",
               "m.toml:8:10: scan.points: 1024.0: wrong type: expected a whole number from 64 to 4096");
  expect_error(kHead + "[estimation]\ndeskew = 1\n", "expected true or false");
  expect_error(kHead + "[sensor]\nrange_max_m = inf\n", "not a finite number");
}

TEST_F(Missions, EachProblemIsOneLineWhateverTheFileSays) {
  VERIFIES("LASSO-GND-003~1");
  const std::string key = "\"\\u001b[2J\\n" + std::string(500, 'k') + "\"";
  const std::string said = mission_error_of([&] { static_cast<void>(load(kHead + key + " = 1\nname = f\n")); });
  for (const char c : said) EXPECT_TRUE(c < 0 || c >= ' ') << said;
  const std::string unknown = mission_error_of([&] { static_cast<void>(load(kHead + key + " = 1\n")); });
  EXPECT_NE(unknown.find("?[2J?kkk"), std::string::npos) << unknown;
  EXPECT_LT(unknown.size(), 400u);
}

TEST_F(Missions, AKeyOfAnEarlierVersionSaysWhatIsInItsPlace) {
  VERIFIES("LASSO-GND-003~1");
  expect_error(kHead + "[tracking]\nnormalized_residual_max = 5\n",
               "m.toml:8:1: tracking.normalized_residual_max: is sensor.noise_tolerance now");
  expect_error(kHead + "[start]\ntwin_margin = 5\n", "m.toml:8:1: start.twin_margin: is no longer asked");
  EXPECT_EQ(load(kHead + "[sensor]\nnoise_tolerance = 5\n").parameters.noise_tolerance, 5);
}

TEST_F(Missions, AllProblemsAreListedInOrder) {
  VERIFIES("LASSO-GND-003~1");
  const std::string message = error(kHead + "[scan]\nponts = 3\npattern = 'rosete'\n[filter]\nperiod_s = -1\n[scanner]\nx = 1\n");
  EXPECT_EQ(lines_of(message), 4u) << message;
  EXPECT_LT(
      message.find("m.toml:8:1: scan.ponts: unknown key; did you mean scan.points?"),
      message.find("m.toml:9:11: scan.pattern: rosete: expected one of \"rosette\", \"lissajous\", \"raster\"; did you mean \"rosette\"?"));
  const std::size_t first = message.find("m.toml:8:1: scan.ponts: unknown key; did you mean scan.points?");
  const std::size_t second = message.find(
      "m.toml:9:11: scan.pattern: 'rosete': expected one of \"rosette\", \"lissajous\", \"raster\"; did you mean \"rosette\"?");
  const std::size_t third = message.find("m.toml:11:12: filter.period_s: -1: out of range");
  EXPECT_LT(first, second) << message;
  EXPECT_LT(second, third) << message;
  EXPECT_NE(third, std::string::npos) << message;
  EXPECT_NE(message.find("scanner: unknown key"), std::string::npos) << message;
}

TEST_F(Missions, MissingTargetsAndContradictionsAreListedTogether) {
  VERIFIES("LASSO-GND-003~1");
  const std::string message =
      error("[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmodel = 'none.toml'\n[scan]\nduration_s = 1\ncycles_b = 38\n");
  EXPECT_EQ(lines_of(message), 3u) << message;
  folder.write("box.toml", "[parameters.width]\n");
  const std::string model = error(kHead + "[scan]\nduration_s = 1\n");
  EXPECT_EQ(lines_of(model), 6u) << model;  // five keys of the model's parameter, and the scan
}

TEST_F(Missions, MissingAndWrongHeadersAreNamed) {
  VERIFIES("LASSO-GND-003~1");
  const std::string message = error("[target]\nmodel = 'box.toml'\n");
  EXPECT_EQ(lines_of(message), 3u) << message;
  EXPECT_NE(message.find("mission.id: is missing"), std::string::npos);
  expect_error("[mission]\nid = 0\nversion = 1\nname = ''\n[target]\nmodel = 'box.toml'\n", "mission.id: 0: out of range");
  expect_error("mission = 3\n", "mission: 3: wrong type: expected a table");
  expect_error("[mission]\nid = 1\nversion = 1\nname = 'x'\n", "target: expected exactly one of");
  expect_error(kHead + "mesh = 'box.stl'\n", "target: expected exactly one of");
  expect_error("'mission.id' = 3\n", "unknown key");
  expect_error("[mission\n", "m.toml:1:");
  expect_error("a = 1\na = 2\n", "not valid TOML");
  expect_error("\xff\xfe", "not valid TOML");
  EXPECT_NE(mission_error_of([&] { static_cast<void>(load_mission(folder.path() / "none.toml")); }).find("none.toml: cannot be read"),
            std::string::npos);
  EXPECT_NE(mission_error_of([&] { static_cast<void>(load_mission(folder.path())); }).find("is a folder"), std::string::npos);
  expect_error(std::string(std::size_t{2} << 20, '#'), "at most 1048576 bytes");
}

TEST_F(Missions, ContradictionsAreRefused) {
  VERIFIES("LASSO-GND-009~1");
  expect_error(kHead + "[scan]\ncycles_a = 18\n",
               "m.toml:8:12: scan.cycles_b: 12: expected a count that differs from scan.cycles_a, which is 18");
  expect_error(kHead + "[scan]\ncycles_a = 12\n", "scan.cycles_b: 12");
  expect_error(kHead + "[scan]\npattern = 'raster'\npoints = 64\ncycles_a = 33\n[tracking]\ninliers_min = 12\n",
               "at least 2 points a line");
  expect_error(kHead + "[scan]\nduration_s = 0.2\n", "m.toml:8:14: scan.duration_s: 0.2: expected less than filter.period_s");
  expect_error(kHead + "[sensor]\nrange_min_m = 30\n", "sensor.range_min_m: 30: expected less than sensor.range_max_m, which is 20 m");
  expect_error(kHead + "[tracking]\ninliers_min = 2000\n", "expected at most scan.points, which is 1024");
  expect_error(kHead + "[tracking.initial]\nqw = 0.9\n",
               "m.toml:8:6: tracking.initial.qw: 0.9: expected a quaternion of unit length (within 0.001), that of [0, 0, 0, 0.9] is 0.9");
  expect_error(kHead + "[tracking.initial]\npresent = true\nz_m = -1\n", "the target is in front");
}

TEST_F(Missions, SourcesOfAStartAreTriedOnceEach) {
  VERIFIES("LASSO-GND-001~1 LASSO-MOD-133~4");
  expect_error(kHead + "[start]\nthird = 'handover'\n", "expected another source than that of start.second, or none");
  EXPECT_EQ(load(kHead + "[start]\nsecond = 'none'\nthird = 'none'\n").parameters.start_third, 0);
}

TEST_F(Missions, AlmostUnitQuaternionsAreNormalised) {
  VERIFIES("LASSO-GND-009~1");
  const MissionSource source = load(kHead + "[tracking.initial]\nqx = 0.5\nqy = 0.5\nqz = -0.5\nqw = 0.5005\n");
  const MissionParameters& p = source.parameters;
  EXPECT_NEAR(std::hypot(std::hypot(p.initial_qx, p.initial_qy), std::hypot(p.initial_qz, p.initial_qw)), 1, 1e-15);
  EXPECT_NEAR(p.initial_qw / p.initial_qx, 1.001, 1e-12);
}

TEST_F(Missions, ScenariosHaveTheirPresetsFromTheSensorAndTheirOverrides) {
  VERIFIES("LASSO-GND-010~1");
  const MissionSource source = load(kHead +
                                    "[sensor]\nsigma0_m = 0.002\n[scenario.one]\nranges_m = [2, 3.5]\nspin_degps = [18, 0, -9]\n"
                                    "override.scan.points = 512\noverride.estimation.deskew = false\n"
                                    "[scenario.two]\nvariants = true\nranges_m = [4]\nsigma_k_per_m = 0\n[scenario.two.override.sensor]\n"
                                    "sigma0_m = 0.003\nsigma_angle_rad = 1e-4\n");
  const Scenario& one = scenario_of(source, "one");
  EXPECT_FALSE(one.has_profile());
  EXPECT_EQ(one.ranges_m, (std::vector<double>{2, 3.5}));
  EXPECT_NEAR(one.spin_radps[0], 0.1 * M_PI, 1e-15);
  EXPECT_NEAR(one.spin_radps[2], -0.05 * M_PI, 1e-15);
  EXPECT_EQ(one.sigma0_m, 0.002);
  EXPECT_EQ(one.frames, 360);
  EXPECT_EQ(one.noise, 1);
  EXPECT_EQ(parameters_for(source, "one").points, 512);
  EXPECT_EQ(parameters_for(source, "one").deskew, 0);
  EXPECT_EQ(parameters_for(source, "").points, 1024);
  EXPECT_EQ(source.origins.at("scenario.one.override.scan.points").line, 12);
  const Scenario& two = scenario_of(source, "two");
  EXPECT_EQ(two.sigma0_m, 0.003);
  EXPECT_EQ(two.angle_noise_rad, 1e-4);
  EXPECT_EQ(two.sigma_k_per_m, 0);
  EXPECT_EQ(parameters_for(source, "two").sigma_k_per_m, source.parameters.sigma_k_per_m);
  EXPECT_NE(mission_error_of([&] { static_cast<void>(parameters_for(source, "three")); }).find("expected one of one, two"),
            std::string::npos);
}

TEST_F(Missions, ScenariosAreCheckedLikeTheRest) {
  VERIFIES("LASSO-GND-003~1 LASSO-GND-009~1 LASSO-GND-010~1");
  const std::string scenario = kHead + "[scenario.s]\nvariants = true\nranges_m = [4]\n";  // line 10 is next
  expect_error(kHead + "[scenario.s]\n", "m.toml:7:1: scenario.s.ranges_m: is missing");
  expect_error(kHead + "[scenario.s]\nvariants = true\nranges_m = []\n", "expected a list of 1 to 100 numbers");
  expect_error(kHead + "[scenario.s]\nvariants = true\nranges_m = [4, -1]\n", "m.toml:9:16: scenario.s.ranges_m[1]: -1: out of range");
  expect_error(kHead + "[scenario.s]\nvariants = true\nranges_m = [25]\n",
               "scenario.s.ranges_m: [25]: expected between sensor.range_min_m");
  expect_error(scenario + "fames = 3\n", "m.toml:10:1: scenario.s.fames: unknown key; did you mean scenario.s.frames?");
  expect_error(scenario + "offset_m = [1, 2, 3]\n", "expected a list of 2 numbers");
  expect_error(scenario + "override.scan.pints = 3\n",
               "scenario.s.override.scan.pints: unknown key; did you mean scenario.s.override.scan.points?");
  expect_error(scenario + "override = 3\n", "expected a table of flight parameters");
  expect_error(scenario + "override.scan.duration_s = 0.5\n",
               "m.toml:10:28: scenario.s.override: scan.duration_s: 0.5: expected less than");
  expect_error(kHead + "scenario = 3\n", "unknown key");
  expect_error("scenario = 3\n" + kHead, "scenario: 3: wrong type");
  expect_error("scenario.s = 3\n" + kHead, "scenario.s: 3: wrong type");
}

TEST_F(Missions, ModelParametersReachTheTarget) {
  VERIFIES("LASSO-GND-008~1");
  const MissionSource source = load(kHead + "scale = 10\n[target.parameters]\nwidth = 1.5\n");
  double width = 0;
  for (const Eigen::Vector3d& v : load_target(source).vertices) width = std::max(width, v.x());
  EXPECT_NEAR(width, 7.5, 1e-12);
  expect_error(kHead + "[target.parameters]\nwidth = 3\n", "m.toml:8:9: target.parameters.width: 3: out of range: expected 0.5 to 2 m");
  expect_error(kHead + "[target.parameters]\nwidht = 1\n", "the model has no such parameter; did you mean width?");
  expect_error(kHead + "[target.parameters]\nwidth = 'x'\n", "wrong type");
  expect_error(kHead + "parameters = 3\n", "target.parameters: 3: wrong type");
}

TEST_F(Missions, TheTargetsFrameLiesWhereItsOriginIsSaidToBe) {
  VERIFIES("LASSO-GND-012~1");
  const Mesh as_filed = load_target(load(kHead + "scale = 10\n"));
  const Mesh moved = load_target(load(kHead + "scale = 10\norigin_m = [300, -2.5, 0.75]\n"));
  ASSERT_EQ(moved.vertices.size(), as_filed.vertices.size());
  for (std::size_t i = 0; i < moved.vertices.size(); ++i)
    EXPECT_NEAR((as_filed.vertices[i] - moved.vertices[i] - Eigen::Vector3d(300, -2.5, 0.75)).norm(), 0, 1e-12);
}

TEST_F(Missions, TargetFilesAreProtectedByTheirDigest) {
  VERIFIES("LASSO-GND-004~1 LASSO-GND-013~1");
  const std::string head = "[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmesh = 'm.obj'\n";
  const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  expect_error(head, "m.toml:6:8: target.mesh: \"m.obj\": no such file");
  const std::string no_name(300, 'm');  // longer than a file's may be
  expect_error("[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmesh = '" + no_name + "'\n",
               "m.toml:6:8: target.mesh: \"" + no_name + "\": no such file");
  folder.write("m.obj", mesh);
  const MissionSource unprotected = load(head);
  ASSERT_EQ(unprotected.warnings.size(), 1u);
  EXPECT_NE(unprotected.warnings[0].find("sha256 = \"" + sha256_of(mesh)), std::string::npos);
  const MissionSource guarded = load(head + "sha256 = '" + sha256_of(mesh) + "'\n");
  EXPECT_TRUE(guarded.warnings.empty());
  EXPECT_EQ(load_target(guarded).triangles.size(), 4u);
  folder.write("m.obj", mesh + "# changed\n");
  expect_error(head + "sha256 = '" + sha256_of(mesh) + "'\n", "m.toml:7:10: target.sha256");
  expect_error(head + "sha256 = 'abc'\n", "64 hexadecimal digits");
  expect_error(head + "[target.parameters]\nwidth = 1\n", "a mesh has no parameters");
}

TEST_F(Missions, BadGeometryIsReportedAtTheMissionsLine) {
  VERIFIES("LASSO-GND-003~1 LASSO-GND-014~1");
  const std::string head = "[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmesh = 'm.stl'\n";
  folder.write("m.stl", "nothing");
  const std::string corrupt = mission_error_of([&] { static_cast<void>(load_target(load(head))); });
  EXPECT_NE(corrupt.find("m.toml:6:8: target.mesh: "), std::string::npos) << corrupt;
  EXPECT_NE(corrupt.find("it begins with \"nothing\""), std::string::npos) << corrupt;
  const std::string huge = mission_error_of([&] { static_cast<void>(load_target(load(kHead + "scale = 1e6\n"))); });
  EXPECT_NE(huge.find("is the scale right?"), std::string::npos) << huge;
  folder.write("box.toml", "[[part]]\n");
  const std::string model = mission_error_of([&] { static_cast<void>(load_target(load(kHead))); });
  EXPECT_NE(model.find("box.toml:1:1: part: kind"), std::string::npos) << model;
}

TEST_F(Missions, TheShippedMissionIsThePapersExperiment) {
  VERIFIES("LASSO-GND-011~1");
  const MissionSource source = load_mission(kShippedMission);
  EXPECT_TRUE(source.warnings.empty());
  for (const char* name : {"paper", "side_on"}) {
    const Scenario& scenario = scenario_of(source, name);
    EXPECT_EQ(scenario.ranges_m, (std::vector<double>{2, 3, 4, 5, 6, 7}));
    EXPECT_EQ(scenario.frames, 360);
    EXPECT_NEAR(scenario.step_rad, kRadPerDeg, 1e-15);
    for (const double range_m : scenario.ranges_m) {
      const double sigma_m = std::hypot(scenario.sigma0_m, scenario.sigma_k_per_m * range_m * range_m);
      EXPECT_NEAR(sigma_m, 1e-3 * std::pow(range_m / 3, 2), 1e-3 * sigma_m);
    }
    EXPECT_EQ(parameters_for(source, name).deskew, 0);
  }
  EXPECT_EQ(scenario_of(source, "outliers").outlier_probability, 0.3);
  EXPECT_EQ(scenario_of(source, "dropouts").dropout_probability, 0.2);
  EXPECT_NEAR(scenario_of(source, "spin").spin_radps[0], 5 * kRadPerDeg, 1e-15);
  EXPECT_EQ(parameters_for(source, "spin").deskew, 1);
}

}  // namespace
}  // namespace lasso::mdat
