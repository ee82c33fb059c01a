// A large target close by, scanned part by part, by its results.
#include <gtest/gtest.h>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

const std::string kNearMission = source_path("cfg/missions/hubble_near.toml");

TEST(CloseBy, TheFilterHoldsAFullSizeTargetOfWhichNoScanSeesTheWhole) {
  VERIFIES("LASSO-MOD-161~3 LASSO-MOD-163~3 LASSO-MOD-164~2 LASSO-SIM-035~1");
  const WorkFolder work;
  const Answer answer = work.mdat("run " + kNearMission + " --scenario close_by --out out");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const Json noisy = Json::parse(work.read("out/results.json")).at("noisy");
  EXPECT_EQ(noisy.at("lost"), 0);
  EXPECT_EQ(noisy.at("frames"), 800);
  EXPECT_LT(noisy.at("invalid"), 40) << "poses of parts that the others contradict";
  EXPECT_LT(noisy.at("filtered").at("rms_mm").get<double>(), 2.5);
  EXPECT_LT(noisy.at("filtered").at("rms_deg").get<double>(), 0.05);
  EXPECT_NE(
      answer.out.find("1 of 1 runs; the filter's pose rms " + std::to_string(noisy.at("filtered").at("rms_mm").get<double>()).substr(0, 4)),
      std::string::npos)
      << answer.out;
  const std::string report = work.read("out/report.html");
  EXPECT_NE(report.find("looks at"), std::string::npos) << "which part, over time";
  EXPECT_NE(report.find("array boom"), std::string::npos);
}

TEST(CloseBy, AMissionSaysItsParts) {
  VERIFIES("LASSO-GND-001~1 LASSO-GND-002~1 LASSO-MDL-024~1");
  const WorkFolder work;
  const Answer compiled = work.mdat("mission compile " + kNearMission + " --out near.3dli");
  ASSERT_EQ(compiled.exit_code, 0) << compiled.err;
  EXPECT_NE(compiled.out.find("part 3, equipment_bay: "), std::string::npos) << compiled.out;
  const Answer image = work.mdat("mission info near.3dli");
  EXPECT_NE(image.out.find("part 1: origin at -6.35, 0, 0 m, serves from 1 m to 15 m, priority 1"), std::string::npos) << image.out;
  const Answer source = work.mdat("mission info " + kNearMission);
  EXPECT_NE(source.out.find("part.array_boom.range_m"), std::string::npos) << source.out;
}

}  // namespace
}  // namespace lasso::ft
