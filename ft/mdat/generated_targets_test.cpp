// Targets that mdat makes from a number, by the command line alone.
#include <gtest/gtest.h>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

TEST(GeneratedTargets, AreCheckedCompiledAndFlown) {
  VERIFIES("LASSO-GND-113~1");
  for (const std::string kind : {"plain", "nearly-symmetric", "rock"}) {
    SCOPED_TRACE(kind);
    const WorkFolder work;
    const Answer made = work.mdat("mission new --generate 7 --kind " + kind + " --out t.toml");
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_NE(made.out.find("body 7: " + kind), std::string::npos) << made.out;
    EXPECT_NE(made.out.find("exact symmetry: "), std::string::npos) << made.out;
    EXPECT_EQ(work.mdat("mission check t.toml").exit_code, 0);
    const Answer flown = work.mdat("run t.toml --scenario spin --frames 12 --no-report --out r");
    ASSERT_EQ(flown.exit_code, 0) << flown.err;
    const Json spin = Json::parse(work.read("r/results.json"));
    EXPECT_EQ(spin.dump().find("\"lost\":12"), std::string::npos);
  }
}

TEST(GeneratedTargets, SameNumberSameBytesInAFolderOfItsOwn) {
  VERIFIES("LASSO-GND-110~1");
  const WorkFolder one, two;
  ASSERT_EQ(one.mdat("mission new --generate 11").exit_code, 0);
  ASSERT_EQ(two.mdat("mission new --generate 11").exit_code, 0);
  EXPECT_EQ(one.read("body_11_model.toml"), two.read("body_11_model.toml"));
  EXPECT_TRUE(one.read("body_11.toml") == two.read("body_11.toml"));
  EXPECT_NE(one.read("body_11.toml").find("model = \"body_11_model.toml\""), std::string::npos);
}

TEST(GeneratedTargets, SensorIsTheOneThatIsAskedFor) {
  VERIFIES("LASSO-GND-113~1");
  const WorkFolder work;
  for (const std::string sensor : {"laser_camera", "time_of_flight"}) {
    ASSERT_EQ(work.mdat("mission new --generate 7 --force --out t.toml --sensor " + sensor).exit_code, 0);
    EXPECT_NE(work.read("t.toml").find("kind = \"" + sensor + "\"  #"), std::string::npos);
  }
}

TEST(GeneratedTargets, NothingIsReplacedOrLeftUnasked) {
  VERIFIES("LASSO-GND-113~1");
  const WorkFolder work;
  work.write("t_model.toml", "mine");
  const auto before = work.contents();
  const Answer refused = work.mdat("mission new --generate 7 --out t.toml");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("t_model.toml"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("--force"), std::string::npos) << refused.err;
  EXPECT_EQ(work.contents(), before);
  for (const std::string wrong : {"", "--generate 7 --model t_model.toml", "--generate -1", "--generate 1 --kind saucer",
                                  "--kind rock --model m.stl", "--model m.stl"}) {
    const Answer answer = work.mdat("mission new " + wrong);
    EXPECT_EQ(answer.exit_code, 2) << wrong;
    EXPECT_EQ(lines_of(answer.err).size(), 1u) << answer.err;
    EXPECT_EQ(work.contents(), before) << wrong;
  }
}

}  // namespace
}  // namespace lasso::ft
