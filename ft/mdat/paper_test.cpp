// The paper's experiments in a shortened form, by what mdat paper leaves.
#include <gtest/gtest.h>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

// One run for all tests that look at it. It takes seconds: 240 scans, and fewer stands would not show the errors' size.
struct ShortPaper {
  WorkFolder work;
  Answer answer = work.mdat("paper --missions " + source_path("cfg/missions") + " --frames 4 --stands 8 --mock-ups 1 --out paper");
  Json results = answer.exit_code == 0 ? Json::parse(work.read("paper/results.json")) : Json();
};
const ShortPaper& short_paper() {
  static const ShortPaper run;
  return run;
}

TEST(Paper, SetsItsFiguresBesideThePapers) {
  VERIFIES("LASSO-MDT-120~1");
  const ShortPaper& run = short_paper();
  ASSERT_EQ(run.answer.exit_code, 0) << run.answer.err;
  EXPECT_EQ(run.results.at("table_1").at("paper").at("z_mm").at("std"), 6.25);
  EXPECT_LT(run.results.at("table_1").at("noise_free").at("z_mm").at("std").get<double>(), 0.1);
  EXPECT_GT(run.results.at("table_1").at("noisy").at("z_mm").at("std").get<double>(), 0.01);
  EXPECT_EQ(run.results.at("table_2").at("paper").at("z_mm").at("mean"), 5.01);
  EXPECT_EQ(run.results.at("table_2").at("paper").at("turn_deg").at("std"), 0.24);
  EXPECT_EQ(run.results.at("table_2").at("simulated"), true);
  EXPECT_EQ(run.results.at("table_2").at("by_range").size(), 6U);
  EXPECT_EQ(run.results.at("time").at("paper_card_ms"), 148);
  EXPECT_EQ(run.results.at("time").at("paper_laptop_ms"), 9.2);
  for (const char* experiment : {"simulation_us", "laboratory_us"})
    EXPECT_GT(run.results.at("time").at(experiment).at("median"), 1) << experiment;
  EXPECT_NE(run.answer.out.find("5.01 ± 2.62"), std::string::npos) << run.answer.out;
  EXPECT_NE(run.answer.out.find("the laboratory test is simulated"), std::string::npos);
}

TEST(Paper, SaysWhatOfThePaperIsNotKnown) {
  VERIFIES("LASSO-MDT-120~1");
  const ShortPaper& run = short_paper();
  ASSERT_EQ(run.answer.exit_code, 0) << run.answer.err;
  EXPECT_NE(run.answer.out.find("not known here: Figure 4, Figure 5, Figure 9, Figure 12, Figure 14\n"), std::string::npos)
      << run.answer.out;
  const std::string page = run.work.read("paper/paper.html");
  EXPECT_NE(page.find("<h2>Laboratory test, simulated"), std::string::npos) << "the title says that it is";
  EXPECT_NE(page.find("<td>Figure 9</td><td>not known here</td>"), std::string::npos);
  EXPECT_NE(page.find("<svg"), std::string::npos);
  EXPECT_EQ(page.find("class='missing'"), std::string::npos) << "every figure is drawn";
  EXPECT_EQ(page.find("src='http"), std::string::npos) << "the page opens offline";
}

TEST(Paper, HasErrorsInTheLaboratoryThatItsBudgetAllows) {
  VERIFIES("LASSO-MDT-123~1");
  const ShortPaper& run = short_paper();
  ASSERT_EQ(run.answer.exit_code, 0) << run.answer.err;
  for (const char* figure : {"z_mm", "turn_deg", "z_step_mm", "turn_step_deg"}) {
    const Json& errors = run.results.at("table_2").at(figure);
    EXPECT_LE(errors.at("ratio").get<double>(), 1.1) << figure;
    EXPECT_GE(errors.at("ratio").get<double>(), 0.5) << figure << ": a budget that is far too large says nothing";
    EXPECT_EQ(errors.at("held"), true);
  }
  for (const Json& range : run.results.at("table_2").at("by_range")) {
    EXPECT_EQ(range.at("frames"), 32);
    EXPECT_EQ(range.at("lost"), 0);
  }
}

TEST(Paper, RefusesWhatItCannotFly) {
  VERIFIES("LASSO-MDT-007~1");
  const WorkFolder work;
  const Answer none = work.mdat("paper --missions nowhere --out paper");
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.err.find("nowhere/laboratory.toml: no such file; --missions DIR"), std::string::npos) << none.err;
  EXPECT_FALSE(std::filesystem::exists(work / "paper")) << "nothing is left behind";
  work.write("missions/laboratory.toml", read_text(work / "missions/test.toml"));
  const Answer other = work.mdat("paper --missions missions --out paper");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find("scenario.spin.variants"), std::string::npos) << other.err;
  std::string turning = read_text(source_path("cfg/missions/laboratory.toml"));
  turning.replace(turning.find("step_deg = 0.0"), 14, "step_deg = 3.0");
  turning.replace(turning.rfind("frames = 50"), 11, "frames = 40");
  work.write("missions/laboratory.toml", turning);
  const Answer uneven = work.mdat("paper --missions missions --out paper");
  EXPECT_EQ(uneven.exit_code, 2);
  EXPECT_NE(uneven.err.find("scenario.calibrated.step_deg: 3: expected 0"), std::string::npos) << uneven.err;
  EXPECT_NE(uneven.err.find("scenario.extrapolated.frames: 40: expected 50"), std::string::npos) << uneven.err;
  EXPECT_EQ(work.mdat("paper --stands 1").exit_code, 2);
}

TEST(Paper, IsTheSameForAnyNumberOfJobs) {
  VERIFIES("LASSO-MDT-120~1");
  const WorkFolder work;
  const std::string command = "paper --missions " + source_path("cfg/missions") + " --frames 1 --stands 2 --mock-ups 1 --no-report --out ";
  ASSERT_EQ(work.mdat(command + "one -j 1").exit_code, 0);
  ASSERT_EQ(work.mdat(command + "three -j 3").exit_code, 0);
  const Json one = Json::parse(work.read("one/results.json")), three = Json::parse(work.read("three/results.json"));
  EXPECT_EQ(one.at("table_1"), three.at("table_1"));
  EXPECT_EQ(one.at("table_2"), three.at("table_2"));
  EXPECT_EQ(work.mdat(command + "one").exit_code, 2) << "an earlier one stays";
}

}  // namespace
}  // namespace lasso::ft
