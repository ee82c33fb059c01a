// The pages of modes and faults are what the component's own tables say.
#include <gtest/gtest.h>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

TEST(Modes, TheDocumentedTableIsTheExecutedOne) {
  VERIFIES("LASSO-MOD-139~1 LASSO-MOD-176~1");
  const WorkFolder work;
  const Answer answer = work.mdat("modes");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_EQ(answer.out, read_text(source_path("docs/modes.md"))) << "make it anew: mdat modes > docs/modes.md";
}

// The component begins all the same, and says why; here the ground has a pose of its own.
TEST(Modes, AMissionsOwnPoseThatNoSensorReachesIsARefusedStart) {
  VERIFIES("LASSO-MOD-133~4 LASSO-MOD-134~3");
  const WorkFolder work;
  work.write_mission({{"z_m = 4.0", "z_m = 4000.0"}});
  const Answer checked = work.mdat("mission check missions/test.toml");
  EXPECT_EQ(checked.exit_code, 0) << checked.err;
  EXPECT_NE(checked.out.find("tracking.initial.z_m: 4000: the target is wholly outside"), std::string::npos) << checked.out;
  const Answer run = work.mdat("run missions/test.toml --scenario spin --frames 4 --no-report --out run");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto packets = Json::parse(work.mdat("decode run/telemetry.ccsds --format json").out).at("packets");
  int refused = 0;
  for (const auto& packet : packets) {
    if (packet.at("packet") != "start_refused") continue;
    ++refused;
    EXPECT_EQ(packet.at("items").at("start_source"), "apriori");
    EXPECT_EQ(packet.at("items").at("refusal"), "out_of_reach");
  }
  EXPECT_EQ(refused, 1);
}

TEST(Faults, TheDocumentedTableIsTheExecutedOne) {
  VERIFIES("LASSO-HLT-001~1");
  const WorkFolder work;
  const Answer answer = work.mdat("faults");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_EQ(answer.out, read_text(source_path("docs/faults.md"))) << "make it anew: mdat faults > docs/faults.md";
}

}  // namespace
}  // namespace lasso::ft
