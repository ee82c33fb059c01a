// A recorded run through a changed component: both side by side, and recorded again.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

class WhatIf : public ::testing::Test {
 protected:
  void SetUp() override {
    const Answer run =
        work_.mdat("run missions/test.toml --no-report --frames 12 --out run --record run.mcap --scenario spin --set scan.points=512");
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  // The figures of a row of the table: of the recorded run, of the changed one.
  static std::vector<std::string> row(const std::string& text, const std::string& title) {
    for (const std::string& line : lines_of(text)) {
      if (line.rfind(title + " ", 0) != 0) continue;
      std::istringstream words(line.substr(title.size()));
      std::string recorded, changed;
      words >> recorded >> changed;
      return {recorded, changed};
    }
    ADD_FAILURE() << title << " is not in\n" << text;
    return {"", ""};
  }
  WorkFolder work_;
};

TEST_F(WhatIf, BothAreToldSideBySide) {
  VERIFIES("LASSO-REC-022~1");
  const Json results = Json::parse(work_.read("run/results.json"));
  const Answer changed = work_.mdat("replay run.mcap --set estimation.silhouettes=false");
  ASSERT_EQ(changed.exit_code, 0) << changed.err;
  EXPECT_EQ(row(changed.out, "poses told"), (std::vector<std::string>{"12", "12"}));
  EXPECT_EQ(row(changed.out, "wrong"), (std::vector<std::string>{"0", "0"}));
  // What the run itself reported of its poses, all of which are valid.
  const std::vector<std::string> rms = row(changed.out, "rms, mm");
  EXPECT_NEAR(std::stod(rms[0]), results.at("noisy").at("rms_mm").get<double>(), 6e-4);
  EXPECT_NE(rms[0], rms[1]);
  EXPECT_NE(changed.out.find("the first pose that differs: at 1.09"), std::string::npos) << changed.out;
}

// A setting that says again what the run had changes no pose; one of the simulated world is told to be idle.
TEST_F(WhatIf, WhatChangesNothingIsTold) {
  VERIFIES("LASSO-REC-022~1");
  const Answer same = work_.mdat("replay run.mcap --set scenario.spin.dropout_probability=0.5");
  EXPECT_EQ(same.exit_code, 0) << same.err;
  EXPECT_NE(same.err.find("the flight image is the recorded one"), std::string::npos) << same.err;
  EXPECT_NE(same.out.find("no pose differs"), std::string::npos) << same.out;
}

TEST_F(WhatIf, ByAnImageOrAMissionIsTheSame) {
  VERIFIES("LASSO-REC-022~1");
  ASSERT_EQ(
      work_
          .mdat("mission compile missions/test.toml --scenario spin --set scan.points=512 --set estimation.silhouettes=false -o other.3dli")
          .exit_code,
      0);
  const std::string settings = work_.mdat("replay run.mcap --set estimation.silhouettes=false").out;
  EXPECT_EQ(work_.mdat("replay run.mcap --image other.3dli").out, settings);
  EXPECT_EQ(work_.mdat("replay run.mcap --mission missions/test.toml --set scan.points=512 --set estimation.silhouettes=false").out,
            settings);
}

// The result flies again from itself alone, and can be changed further.
TEST_F(WhatIf, IsARecordingToo) {
  VERIFIES("LASSO-REC-022~1");
  const Answer changed = work_.mdat("replay run.mcap --set estimation.silhouettes=false --record changed.mcap");
  ASSERT_EQ(changed.exit_code, 0) << changed.err;
  std::filesystem::remove_all(work_ / "missions");
  const Answer again = work_.mdat("replay changed.mcap");
  EXPECT_EQ(again.exit_code, 0) << again.err << again.out;
  EXPECT_NE(again.out.find("telemetry: the same as recorded"), std::string::npos) << again.out;
  const Answer back = work_.mdat("replay changed.mcap --set estimation.silhouettes=true --record back.mcap");
  EXPECT_EQ(back.exit_code, 0) << back.err;
  ASSERT_EQ(work_.mdat("recording export back.mcap --format packets -o packets").exit_code, 0);
  EXPECT_EQ(row(back.out, "rms, mm")[1], row(changed.out, "rms, mm")[0]) << "there and back";
  EXPECT_EQ(work_.mdat("recording merge run.mcap changed.mcap --prefix before,after -o both.mcap").exit_code, 0);
}

TEST_F(WhatIf, WhatDoesNotFitIsRefused) {
  VERIFIES("LASSO-REC-022~1");
  for (const auto& [arguments, said] : std::vector<std::pair<std::string, std::string>>{
           {"--set filter.period_s=0.25", "filter.period_s is 0.25 s, and the recorded scans come every 0.2 s"},
           {"--image missing.3dli", "missing.3dli: "},
           {"--image run.mcap --set scan.points=512", "are fixed"},
           {"--record run.mcap", "run.mcap"},
           {"--key none", "--key none: the commands of run.mcap needed none"},
           {"--record out.txt", "--record out.txt: expected FILE.mcap"}}) {
    const Answer answer = work_.mdat("replay run.mcap " + arguments);
    EXPECT_EQ(answer.exit_code, 2) << arguments << answer.out;
    EXPECT_NE(answer.err.find(said), std::string::npos) << answer.err;
  }
  const Answer scans = work_.mdat("replay missions/test.toml --image x.3dli");
  EXPECT_EQ(scans.exit_code, 2);
  EXPECT_NE(scans.err.find("--image x.3dli: is for a recording of a run (.mcap) alone"), std::string::npos) << scans.err;
}

}  // namespace
}  // namespace lasso::ft
