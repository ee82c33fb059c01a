#include "mdat/missiondb/mission_writer.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "mdat/missiondb/mission_source.hpp"
#include "mdat/missiondb/model_file.hpp"
#include "mdat/missiondb/value_row.hpp"
#include "mdat/source/sha256.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

const std::filesystem::path kProbe = kSourceFolder / "cfg/models/probe.toml";

// The mission of the probe at some scale, moved in its file by `shift_m`.
NewMission probe(double scale, const Eigen::Vector3d& shift_m = Eigen::Vector3d::Zero()) {
  Mesh mesh = build_model(kProbe, {});
  for (Eigen::Vector3d& v : mesh.vertices) v = scale * v + shift_m;
  NewMission mission;
  mission.name = "probe";
  mission.path = kProbe.string();
  mission.sha256 = sha256_of(read_file(kProbe));
  mission.parametric = true;
  mission.scale = scale;
  mission.size = size_of(mesh);
  mission.cell_size_m = 0.012;
  mission.surface_sigma_m = 1e-5;
  return mission;
}

void write_new_mission(double scale, const std::filesystem::path& file) {
  std::ofstream(file, std::ios::binary) << new_mission_text(probe(scale));
}

// The target at its initial pose, as seen by the sensor.
double largest_angle(const MissionSource& source, double& nearest_m) {
  const MissionParameters& p = source.parameters;
  double largest = 0;
  nearest_m = 1e9;
  for (const Eigen::Vector3d& v : load_target(source).vertices) {  // the written attitude is the identity
    const Eigen::Vector3d seen = v + Eigen::Vector3d(p.initial_x_m, p.initial_y_m, p.initial_z_m);
    largest = std::max({largest, std::fabs(seen.x()) / seen.z(), std::fabs(seen.y()) / seen.z()});
    nearest_m = std::min(nearest_m, seen.norm());
  }
  return std::atan(largest);
}

TEST(MissionWriter, WritesAMissionThatLoadsWhateverTheTargetsSize) {
  VERIFIES("LASSO-GND-012~1");
  const Folder folder;
  for (const double scale : {0.02, 0.3, 1.0, 10.0, 300.0}) {
    const auto file = folder.path() / "new.toml";
    write_new_mission(scale, file);
    const MissionSource source = load_mission(file);
    EXPECT_EQ(source.target.scale, scale);
    EXPECT_EQ(source.target.sha256, sha256_of(read_file(kProbe)));
    double nearest_m = 0;
    EXPECT_LT(largest_angle(source, nearest_m), source.parameters.fov_half_x_rad) << scale;
    EXPECT_GT(nearest_m, source.parameters.range_min_m) << scale;
    EXPECT_EQ(source.parameters.initial_present, 1);
    EXPECT_EQ(source.scenarios.count("paper"), 1u);
    EXPECT_EQ(source.parameters.start_check, 1) << "a wrong start is not believed";
    EXPECT_EQ(source.parameters.start_fifth, 5) << "and the target is searched, as the last source";
    EXPECT_EQ(source.parameters.recover, 1);
  }
}

TEST(MissionWriter, SizeDependentValuesGrowWithTheTarget) {
  VERIFIES("LASSO-GND-012~1");
  const Folder folder;
  write_new_mission(1, folder.path() / "small.toml");
  write_new_mission(10, folder.path() / "large.toml");
  const MissionSource small = load_mission(folder.path() / "small.toml"), large = load_mission(folder.path() / "large.toml");
  for (const char* key : {"estimation.gate_first_m", "estimation.silhouette_band_m", "estimation.edge_gap_min_m", "tracking.initial.z_m"}) {
    for (const ParameterRow& row : parameter_rows()) {
      if (std::string(row.key) == key) {
        EXPECT_NEAR(large.parameters.*row.member / (small.parameters.*row.member), 10, 0.6) << key;
      }
    }
  }
  EXPECT_EQ(large.parameters.kernel_width, small.parameters.kernel_width);
}

TEST(MissionWriter, ItsExamplesOfASensorAndAPartAreGoodOnceUncommented) {
  VERIFIES("LASSO-GND-012~1");
  const Folder folder;
  for (const double scale : {0.3, 10.0}) {
    const auto file = folder.path() / "new.toml";
    write_new_mission(scale, file);
    std::string text = read_file(file);
    text.resize(text.find("\n# A scene: "));
    for (const char* start : {"[further", "kind", "use_", "[part", "box", "range_m =", "view", "cone"}) {
      for (std::size_t at = text.find("\n# " + std::string(start)); at != std::string::npos; at = text.find("\n# " + std::string(start))) {
        text.erase(at + 1, 2);
      }
    }
    const MissionSource source = load_mission(folder.write("uncommented.toml", text));
    ASSERT_EQ(source.further_sensors.size(), 1U);
    EXPECT_EQ(source.further_sensors[0].name, "near");
    ASSERT_EQ(source.parts.size(), 1U);
    const Mesh target = load_target(source);
    const Mesh part = load_part(source, source.parts[0], target);
    EXPECT_GT(part.triangles.size(), 0U);
    EXPECT_LT(part.triangles.size(), 2 * target.triangles.size());
  }
}

TEST(MissionWriter, ItsExampleOfASceneIsGoodOnceUncommented) {
  VERIFIES("LASSO-GND-012~1 LASSO-SCN-020~2");
  const Folder folder;
  write_new_mission(0.3, folder.path() / "new.toml");
  std::string text = read_file(folder.path() / "new.toml");
  for (std::size_t at = text.find("\n# [motion.turning]"); at != std::string::npos; at = text.find("\n# ", at)) text.erase(at + 1, 2);
  const MissionSource source = load_mission(folder.write("uncommented.toml", text));
  const SceneRun& run = *source.scenarios.at("scene").scene;
  EXPECT_EQ(run.relative.size(), 1U);
  EXPECT_EQ(run.ranges_m.size(), 240U);
  EXPECT_LT(run.ranges_m.back(), 0.9 * run.ranges_m.front());
}

TEST(MissionWriter, ALargeTargetIsMetByALidar) {
  VERIFIES("LASSO-GND-041~1");
  const Folder folder;
  write_new_mission(1, folder.path() / "small.toml");
  write_new_mission(30, folder.path() / "large.toml");
  EXPECT_EQ(load_mission(folder.path() / "small.toml").sensor, SensorKind::kLaserCamera);
  const MissionSource large = load_mission(folder.path() / "large.toml");
  EXPECT_EQ(large.sensor, SensorKind::kTimeOfFlight);
  EXPECT_EQ(large.parameters.sigma0_m, 0.02);
  EXPECT_GT(large.parameters.sigma_angle_rad, 0);
}

TEST(MissionWriter, ExplainsEveryFlightParameter) {
  VERIFIES("LASSO-GND-012~1");
  const std::string text = new_mission_text(probe(1));
  for (const ValueRow& row : flight_rows()) EXPECT_NE(text.find(row.meaning), std::string::npos) << row.key;
}

TEST(MissionWriter, TheTrackStartsWithTheMiddleOnTheBoresight) {
  VERIFIES("LASSO-GND-012~1");
  const NewMission mission = probe(1, {0.4, -0.3, 0.5});
  const Folder folder;
  const MissionSource source = load_mission(folder.write("new.toml", new_mission_text(mission)));
  const MissionParameters& p = source.parameters;
  EXPECT_NEAR(p.initial_x_m + mission.size.center.x(), 0, 1e-9);
  EXPECT_NEAR(p.initial_y_m + mission.size.center.y(), 0, 1e-9);
  EXPECT_NEAR(p.initial_z_m + mission.size.center.z(), initial_range_m(mission.size), 1e-9);
}

TEST(MissionWriter, SaysWhatWasGuessedAboveTheKeys) {
  VERIFIES("LASSO-GND-043~1");
  NewMission mission = probe(1);
  mission.remarks = {"size: a guess"};
  const std::string text = new_mission_text(mission);
  EXPECT_LT(text.find("# size: a guess\n"), text.find("[mission]"));
}

}  // namespace
}  // namespace lasso::mdat
