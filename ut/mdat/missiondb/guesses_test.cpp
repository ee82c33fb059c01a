#include "mdat/missiondb/guesses.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// A drawn body of 1.3 m at its file's origin, without a near-symmetry.
struct Target {
  Target() {
    mission.size.sides = {1.3, 0.5, 0.4};
    mission.size.largest_m = 1.3;
    mission.size.radius_m = 0.7;
    mission.cell_size_m = 0.012;
    surface = {5000, 4, 0.9, 1e-4};
  }
  std::string line(const std::string& topic) const {
    for (const std::string& line : guesses({mission, surface, coarser, widths_m, tables, report})) {
      if (line.starts_with(topic + ": ")) return line;
    }
    return "";
  }
  void turn(double degrees, double mismatch) {
    const double half = degrees * 3.14159265358979 / 360;
    for (const double x : {0.0, std::sin(half), 0.0, std::cos(half), 0.0, 0.0, 0.0})
      tables[TableId::kSymmetries].push_back(static_cast<std::uint32_t>(static_cast<std::int32_t>(std::lround(std::ldexp(x, 30)))));
    report.symmetries = 1;
    report.symmetry_mismatch = mismatch;
  }
  NewMission mission;
  SurfaceFacts surface;
  std::optional<Simplified> coarser;
  std::vector<double> widths_m{0.5};
  ModelTables tables;
  CompileReport report;
};

TEST(Guesses, ASizeThatIsNoSpacecraftsIsAskedAbout) {
  VERIFIES("LASSO-GND-043~1");
  Target target;
  EXPECT_EQ(target.line("size"), "size: 1.3 x 0.5 x 0.4 m, by --scale 1");
  target.mission.size.largest_m = 110;
  EXPECT_EQ(target.line("size").find("spacecraft"), std::string::npos) << "a space station";
  target.mission.size.largest_m = 340;
  EXPECT_NE(target.line("size").find("in millimetres? --scale 0.001 makes it 0.34 m"), std::string::npos) << target.line("size");
  target.mission.scale = 0.01;
  EXPECT_NE(target.line("size").find("by --scale 0.01: large for a spacecraft: in millimetres? --scale 1e-05 makes it 0.34 m"),
            std::string::npos)
      << target.line("size");
  target.mission.size.largest_m = 0.1;
  EXPECT_EQ(target.line("size").find("spacecraft"), std::string::npos) << "a CubeSat";
  target.mission.size.largest_m = 0.099;
  EXPECT_NE(target.line("size").find("small for a spacecraft: another --scale may be needed"), std::string::npos) << target.line("size");
}

TEST(Guesses, AMeshOffItsOriginIsTold) {
  VERIFIES("LASSO-GND-043~1");
  Target target;
  EXPECT_EQ(target.line("origin"), "");
  target.mission.size.center = {0.5, 0, 0};
  EXPECT_NE(target.line("origin").find("(0.5, 0, 0) m"), std::string::npos);
  EXPECT_NE(target.line("origin").find("center_m"), std::string::npos);
  target.mission.origin_m = {20, -35, 10};
  EXPECT_NE(target.line("origin").find("poses, of recorded scans too, are of that point (target.origin_m)"), std::string::npos);
}

TEST(Guesses, SymmetrySaysWhatASearchMakesOfIt) {
  VERIFIES("LASSO-GND-043~1");
  Target target;
  EXPECT_NE(target.line("symmetry").find("a search tells its attitude"), std::string::npos);
  target.turn(180, 0.02);
  EXPECT_NE(target.line("symmetry").find("180 deg about the y axis"), std::string::npos) << target.line("symmetry");
  EXPECT_NE(target.line("symmetry").find("stays ambiguous"), std::string::npos);
  target.report.symmetry_mismatch = 0.3;
  EXPECT_NE(target.line("symmetry").find("near itself"), std::string::npos);
}

TEST(Guesses, TheSurfaceIsAsRoughAsItsScanAndAsItsSimplification) {
  VERIFIES("LASSO-GND-043~1 LASSO-GND-042~1");
  Target target;
  EXPECT_NEAR(guessed_surface_sigma_m(target.mission.size, target.surface, {}), 1e-5, 1e-6) << "the preset, for a body of 1.33 m";
  EXPECT_NE(target.line("surface").find("drawn"), std::string::npos);
  target.surface.regular_share = 0.1;
  EXPECT_EQ(guessed_surface_sigma_m(target.mission.size, target.surface, {}), 1e-4);
  EXPECT_NE(target.line("surface").find("measured"), std::string::npos);
  target.coarser = Simplified{{}, 3e-4, 1e-3, 5000};
  EXPECT_NEAR(guessed_surface_sigma_m(target.mission.size, target.surface, target.coarser), std::hypot(1e-4, 3e-4), 1e-12);
  EXPECT_NE(target.line("mesh").find("of 5000; their error, 0.0003 m rms and 0.001 m at most"), std::string::npos) << target.line("mesh");
}

TEST(Guesses, PartsAndTargetsThatFewRaysMeetAreTold) {
  VERIFIES("LASSO-GND-043~1");
  Target target;
  EXPECT_EQ(target.line("parts"), "");
  EXPECT_EQ(target.line("rays"), "");
  target.widths_m = {0.5, 0.02, 0.01};  // rays are 1.3 m / 32 apart
  EXPECT_NE(target.line("parts").find("2 of 3 are narrower than 0.041 m"), std::string::npos) << target.line("parts");
  target.surface.area_m2 = 0.1;
  EXPECT_NE(target.line("rays").find("some 13 of 1024 rays"), std::string::npos) << target.line("rays");
}

}  // namespace
}  // namespace lasso::mdat
