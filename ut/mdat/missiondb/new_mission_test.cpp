#include "mdat/missiondb/new_mission.hpp"

#include <cmath>

#include "mdat/missiondb/mission_source.hpp"
#include "mdat/missiondb/simplify.hpp"
#include "mdat/source/sha256.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/mdat/modelc/meshes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

const std::filesystem::path kParametric = kSourceFolder / "cfg/models/probe.toml";

// A needle whose triangles all meet in its tip.
Mesh needle(std::uint32_t sectors) {
  Mesh mesh;
  mesh.vertices.emplace_back(0, 0, 1);
  for (std::uint32_t i = 0; i < sectors; ++i) {
    const double angle = 2 * std::numbers::pi * i / sectors;
    mesh.vertices.emplace_back(0.03 * std::cos(angle), 0.02 * std::sin(angle), 0);
    mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % sectors});
  }
  return mesh;
}

NewMissionRequest request_of(const std::filesystem::path& model, const std::filesystem::path& out) {
  NewMissionRequest request;
  request.model = model;
  request.out = out;
  return request;
}

std::string error_of(const NewMissionRequest& request) {
  return mission_error_of([&] { write_new_mission(request); });
}

TEST(NewMission, AMeshFarFromItsOriginGetsAnOriginOfItsOwn) {
  VERIFIES("LASSO-GND-012~1 LASSO-GND-043~1");
  const Folder folder;
  const auto file = folder.write("far.stl", stl_bytes(shapes::box({300, -250, 200}, {301, -249.2, 200.02})));
  write_new_mission(request_of(file, folder.path() / "far.toml"));
  const MissionSource source = load_mission(folder.path() / "far.toml");
  EXPECT_EQ(source.target.sha256, sha256_of(read_file(file)));
  EXPECT_EQ(source.target.origin_m, std::vector<double>({300.5, -249.6, 200.01}));
  for (const Eigen::Vector3d& v : load_target(source).vertices) {
    EXPECT_NEAR(std::fabs(v.x()), 0.5, 1e-4);
    EXPECT_NEAR(std::fabs(v.y()), 0.4, 1e-4);
    EXPECT_NEAR(std::fabs(v.z()), 0.01, 1e-4);
  }
}

TEST(NewMission, AMeshThatNoCellFitsIsRefusedWithTheRemedyWhichHelps) {
  VERIFIES("LASSO-GND-040~1 LASSO-GND-042~1");
  const Folder folder;
  NewMissionRequest request = request_of(folder.write("needle.stl", stl_bytes(needle(1200))), folder.path() / "needle.toml");
  const std::string error = error_of(request);
  EXPECT_NE(error.find("needle.stl"), std::string::npos) << error;
  EXPECT_NE(error.find("lists "), std::string::npos) << error;
  EXPECT_NE(error.find(": make it coarser: --simplify 300 (it has 1200 triangles)"), std::string::npos) << error;
  EXPECT_FALSE(std::filesystem::exists(request.out));

  request.simplify = kSimplifyChosen;
  write_new_mission(request);
  const MissionSource source = load_mission(request.out);
  EXPECT_EQ(source.target.file.filename(), "needle_simplified.stl");
  EXPECT_LE(load_target(source).triangles.size(), 450U);
  EXPECT_GT(source.parameters.surface_sigma_m, 0);
  EXPECT_NE(error_of(request).find("--force replaces it"), std::string::npos);
}

TEST(NewMission, TakesSmallerCellsWhereTheMeshIsDense) {
  VERIFIES("LASSO-GND-040~1");
  const Folder folder;
  Mesh mesh = shapes::box({-0.5, -0.02, -0.02}, {0.5, 0.02, 0.02});
  Mesh knob = shapes::sphere(0.006, 24, 32);
  shapes::move(knob, shapes::generic_turn(), {0.5, 0.01, 0.01});
  shapes::append(mesh, knob);
  std::vector<double> cells;
  NewMissionRequest request = request_of(folder.write("knob.stl", stl_bytes(mesh)), folder.path() / "knob.toml");
  request.compile = [&](const Mesh& m, const ModelOptions& options, CompileReport& report) {
    cells.push_back(options.cell_size_m);
    return compile_model(m, options, report);
  };
  write_new_mission(request);
  ASSERT_GE(cells.size(), 2U) << "the first one is too large";
  EXPECT_LT(cells.back(), 0.8 * cells.front());
  EXPECT_EQ(load_mission(request.out).target.cell_size_m, cells.back());
}

TEST(NewMission, RefusesWhatItCannotReadOrWriteAndLeavesNothing) {
  VERIFIES("LASSO-GND-012~1");
  const Folder folder;
  const auto attempt = [](const std::filesystem::path& model, double scale, const std::filesystem::path& out) {
    NewMissionRequest request = request_of(model, out);
    request.scale = scale;
    return error_of(request);
  };
  EXPECT_NE(attempt(kParametric, 1, folder.path() / "no/such/m.toml").find("cannot be written"), std::string::npos);
  EXPECT_NE(attempt(folder.path() / "none.stl", 1, folder.path() / "m.toml").find("none.stl: cannot be read"), std::string::npos);
  EXPECT_NE(attempt(kParametric, 1e6, folder.path() / "m.toml").find("is the scale right?"), std::string::npos);
  EXPECT_NE(attempt(kParametric, std::nan(""), folder.path() / "m.toml").find("scale: nan"), std::string::npos);
  EXPECT_NE(attempt(kParametric, -1, folder.path() / "m.toml").find("scale: -1"), std::string::npos);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace lasso::mdat
