#include "mdat/missiondb/mission_writer.hpp"

#include <algorithm>
#include <cmath>

#include "mdat/missiondb/mission_source.hpp"
#include "mdat/missiondb/sha256.hpp"
#include "mdat/missiondb/value_row.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

const std::filesystem::path kProbe = kSourceFolder / "cfg/models/probe.toml";

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
    write_new_mission(kProbe, scale, file);
    const MissionSource source = load_mission(file);
    EXPECT_EQ(source.target.scale, scale);
    EXPECT_EQ(source.target.sha256, sha256_of(read_file(kProbe)));
    double nearest_m = 0;
    EXPECT_LT(largest_angle(source, nearest_m), source.parameters.fov_half_x_rad) << scale;
    EXPECT_GT(nearest_m, source.parameters.range_min_m) << scale;
    EXPECT_EQ(source.parameters.initial_present, 1);
    EXPECT_EQ(source.scenarios.count("paper"), 1u);
    EXPECT_EQ(source.parameters.start_check, 1) << "a wrong start is not believed";
    EXPECT_EQ(source.parameters.start_fifth, 5) << "and the target is searched, by the last way";
    EXPECT_EQ(source.parameters.recover, 1);
    EXPECT_EQ(parameters_for(source, "paper").start_check, 0);
    EXPECT_FALSE(std::filesystem::exists(file.string() + ".part"));
  }
}

TEST(MissionWriter, SizeDependentValuesGrowWithTheTarget) {
  VERIFIES("LASSO-GND-012~1");
  const Folder folder;
  write_new_mission(kProbe, 1, folder.path() / "small.toml");
  write_new_mission(kProbe, 10, folder.path() / "large.toml");
  const MissionSource small = load_mission(folder.path() / "small.toml"), large = load_mission(folder.path() / "large.toml");
  for (const char* key : {"estimation.gate_first_m", "estimation.silhouette_band_m", "estimation.edge_gap_min_m", "tracking.initial.z_m"}) {
    for (const ParameterRow& row : parameter_rows()) {
      if (std::string(row.key) == key) {
        EXPECT_NEAR(large.parameters.*row.member / (small.parameters.*row.member), 10, 0.6) << key;
      }
    }
  }
  EXPECT_NEAR(large.target.cell_size_m / small.target.cell_size_m, 10, 0.6);
  EXPECT_EQ(large.parameters.kernel_width, small.parameters.kernel_width);
}

TEST(MissionWriter, ItsExamplesOfASensorAndAPartAreGoodOnceUncommented) {
  VERIFIES("LASSO-GND-012~1");
  const Folder folder;
  for (const double scale : {0.3, 10.0}) {
    const auto file = folder.path() / "new.toml";
    write_new_mission(kProbe, scale, file);
    std::string text = read_file(file);
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

TEST(MissionWriter, ExplainsEveryFlightParameter) {
  VERIFIES("LASSO-GND-012~1");
  const std::string text = new_mission_text(kProbe, 1, "probe.toml");
  for (const ValueRow& row : flight_rows()) EXPECT_NE(text.find(row.meaning), std::string::npos) << row.key;
}

TEST(MissionWriter, RefusesWhatItCannotReadOrWriteAndLeavesNothing) {
  VERIFIES("LASSO-GND-012~1");
  const Folder folder;
  const auto attempt = [](const std::filesystem::path& model, double scale, const std::filesystem::path& out) {
    return mission_error_of([&] { write_new_mission(model, scale, out); });
  };
  EXPECT_NE(attempt(kProbe, 1, folder.path() / "no/such/m.toml").find("cannot be written"), std::string::npos);
  EXPECT_NE(attempt(folder.path() / "none.stl", 1, folder.path() / "m.toml").find("none.stl: cannot be read"), std::string::npos);
  EXPECT_NE(attempt(kProbe, 1e6, folder.path() / "m.toml").find("is the scale right?"), std::string::npos);
  EXPECT_NE(attempt(kProbe, std::nan(""), folder.path() / "m.toml").find("scale: nan"), std::string::npos);
  EXPECT_NE(attempt(kProbe, -1, folder.path() / "m.toml").find("scale: -1"), std::string::npos);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace lasso::mdat
