// Campaigns as their user has them: flown, stopped, divided, flown again one by one, compared; and what is refused.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <set>
#include <thread>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

const std::string kCampaign = R"(
[campaign.rough]
scenario = "spin"
cases = 6
frames = 3
[campaign.rough.truth]
range_m = { uniform = [3, 5] }
attitude = "any"
noise_factor = { uniform = [0.5, 1.5] }
[campaign.rough.mission]
estimation.surface_sigma_m = { one_of = [0.0, 0.004] }
[campaign.rough.criteria.accuracy]
figure = "worst_mm"
at_most = 20
share_min = 0.5

# The same cases of a target of which an array is gone, turned and larger.
[campaign.gone]
scenario = "spin"
cases = 3
frames = 3
[campaign.gone.truth]
range_m = { uniform = [3, 5] }
attitude = "any"
noise_factor = { uniform = [0.5, 1.5] }
model_scale = 1.002
model_vertex_sigma_m = 0.001
)";

class CampaignCommand : public ::testing::Test {
 protected:
  CampaignCommand() { write_campaigns(kCampaign); }
  void write_campaigns(const std::string& campaigns) {
    work.write_mission({{"cell_size_m = 0.012", "cell_size_m = 0.05"}});
    work.write("missions/test.toml", work.read("missions/test.toml") + campaigns);
  }
  Answer run(const std::string& arguments) const { return work.mdat("campaign " + arguments); }
  Answer fly(const std::string& folder, const std::string& options = "") const {
    return run("run missions/test.toml --campaign rough --no-report --out " + folder + " " + options);
  }
  void expect_refusal(const Answer& answer, const std::string& words) const {
    EXPECT_EQ(answer.exit_code, 2);
    EXPECT_NE(answer.err.find(words), std::string::npos) << answer.err;
  }
  WorkFolder work;
};

TEST_F(CampaignCommand, GivesTheSameBytesHoweverItIsDivided) {
  VERIFIES("LASSO-GND-064~1");
  const Answer whole = fly("whole", "--jobs 2");
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_NE(whole.out.find("worst_mm <= 20 in at least 50 %  6 of 6"), std::string::npos) << whole.out;
  ASSERT_EQ(run("expand missions/test.toml --campaign rough --out parts").exit_code, 0);
  EXPECT_EQ(work.read("parts/plan.json"), work.read("whole/plan.json"));
  ASSERT_EQ(run("run parts --chunk 2/2 --jobs 1").exit_code, 0);
  EXPECT_EQ(run("status parts").exit_code, 1) << "half of them are missing";
  expect_refusal(run("merge parts --no-report"), "3 of 6 cases are missing: mdat campaign run parts goes on");
  ASSERT_EQ(run("run parts --chunk 1/2 --jobs 1").exit_code, 0);
  EXPECT_EQ(run("status parts").exit_code, 0);
  ASSERT_EQ(run("merge parts --no-report").exit_code, 0);
  for (const char* file : {"cases.csv", "results.csv", "results.h5"})
    EXPECT_TRUE(work.read(std::string("parts/") + file) == work.read(std::string("whole/") + file)) << file;
}

TEST_F(CampaignCommand, GoesOnWhereItWasStopped) {
  VERIFIES("LASSO-GND-062~1 LASSO-GND-063~1");
  ASSERT_EQ(fly("whole").exit_code, 0);
  Program program(work, "campaign run missions/test.toml --campaign rough --set campaign.rough.frames=400 --no-report --out halted");
  for (int i = 0; i < 300 && !std::filesystem::exists(work / "halted/chunks/1of1.part"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const Answer halted = program.interrupt();
  EXPECT_EQ(halted.exit_code, 75) << halted.err;
  EXPECT_NE(halted.err.find("the same command goes on"), std::string::npos) << halted.err;
  expect_refusal(fly("halted"), "holds another campaign");
  ASSERT_EQ(fly("halted", "--force").exit_code, 0);
  EXPECT_TRUE(work.read("halted/results.csv") == work.read("whole/results.csv"));
  const Answer again = fly("halted");
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_TRUE(work.read("halted/results.csv") == work.read("whole/results.csv"));
}

TEST_F(CampaignCommand, FliesACaseAgainBitForBit) {
  VERIFIES("LASSO-GND-067~1");
  ASSERT_EQ(fly("c").exit_code, 0);
  const Answer again = run("case c 4 --no-report");
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_NE(again.out.find("all figures are those that the campaign recorded"), std::string::npos) << again.out;
  EXPECT_FALSE(work.read("c/case-4/telemetry.ccsds").empty());
  expect_refusal(run("case c 6"), "the campaign has cases 0 to 5");
}

// Of a campaign whose target differs from the model, too: its surface is that of the run.
TEST_F(CampaignCommand, FliesACaseOfAnotherTargetAgainBitForBit) {
  VERIFIES("LASSO-GND-067~1 LASSO-SIM-043~1");
  ASSERT_EQ(run("run missions/test.toml --campaign gone --no-report --out g").exit_code, 0);
  EXPECT_EQ(run("case g 2 --no-report").exit_code, 0);
  ASSERT_EQ(run("run missions/test.toml --campaign gone --no-report --out same --set campaign.gone.truth.model_scale=1.0 --set "
                "campaign.gone.truth.model_vertex_sigma_m=0")
                .exit_code,
            0);
  EXPECT_NE(work.read("g/results.csv"), work.read("same/results.csv"));
}

TEST_F(CampaignCommand, FliesFaultScriptsAndFliesThemAgain) {
  VERIFIES("LASSO-GND-069~1");
  work.write("missions/late.toml", "[[fault]]\nkind = 'late'\nfrom_s = 0.4\nto_s = 2.0\ndelay_s = 0.15\n");
  work.write("missions/silent.toml", "[[fault]]\nkind = 'silent'\nfrom_s = 0.4\nto_s = 2.0\n");
  const std::string campaign = "[campaign.faults]\nscenario = 'spin'\ncases = 4\nframes = 8\n";
  const std::string scripts = "[campaign.faults.truth]\ncamera_faults = ['late.toml', 'silent.toml']\n";
  write_campaigns(campaign + scripts);
  const std::string fly_it = "run missions/test.toml --campaign faults --no-report --out f";
  expect_refusal(run(fly_it), "only a camera on its line fails by a script");
  write_campaigns(campaign + "sensor = 'lcs-wire'\n" + scripts);
  ASSERT_EQ(run(fly_it).exit_code, 0);
  std::set<std::string> flown;
  for (const std::string& line : lines_of(work.read("f/cases.csv"))) flown.insert(fields_of(line).at(2));
  EXPECT_EQ(flown, (std::set<std::string>{"truth.camera_faults", "0", "1"}));
  EXPECT_EQ(run("case f 3 --no-report").exit_code, 0);
  work.write("missions/late.toml", "");
  EXPECT_EQ(run("case f 3 --no-report").exit_code, 0) << "the folder keeps the scripts";
  work.write("f/mission/late.toml", "");
  expect_refusal(run("run f"), "f/mission/late.toml: is not what the campaign was expanded from");
}

// Of a scenario of several ranges a case flies the first, and so does its run.
TEST_F(CampaignCommand, FliesACaseOfOneOfSeveralRangesAgain) {
  VERIFIES("LASSO-GND-067~1");
  write_campaigns("[campaign.many]\nscenario = 'rates'\ncases = 1\nframes = 2\n");
  ASSERT_EQ(run("run missions/test.toml --campaign many --no-report --out m").exit_code, 0);
  ASSERT_EQ(run("case m 0 --no-report").exit_code, 0);
  EXPECT_EQ(lines_of(work.read("m/case-0/frames.csv")).size(), 1U + 2);
}

TEST_F(CampaignCommand, LivesBehindALinkAndReplacesNobodysFiles) {
  VERIFIES("LASSO-GND-068~1");
  std::filesystem::create_directories(work / "far/away/scratch");
  std::filesystem::create_directory_symlink(work / "far/away/scratch", work / "link");
  EXPECT_EQ(fly("link/c").exit_code, 0);
  EXPECT_EQ(run("case link/c 0 --no-report").exit_code, 0);
  std::filesystem::create_directories(work / "own");
  work.write("own/results.csv", "mine\n");
  expect_refusal(fly("own"), "own/results.csv");
  EXPECT_EQ(work.read("own/results.csv"), "mine\n");
}

TEST_F(CampaignCommand, ComparesTheSameCasesOfTwoMissions) {
  VERIFIES("LASSO-GND-066~1");
  ASSERT_EQ(fly("a").exit_code, 0);
  ASSERT_EQ(fly("b", "--set estimation.silhouettes=false").exit_code, 0);
  const Answer both = run("compare a b");
  EXPECT_EQ(both.exit_code, 0) << both.err;
  EXPECT_NE(both.out.find("6 cases in both"), std::string::npos) << both.out;
  EXPECT_NE(both.out.find("accuracy: within in both"), std::string::npos) << both.out;
  ASSERT_EQ(fly("c", "--set campaign.rough.seed=2").exit_code, 0);
  expect_refusal(run("compare a c"), "these are not the same cases");
}

TEST_F(CampaignCommand, RefusesWhatIsNotItsOwn) {
  VERIFIES("LASSO-GND-068~1");
  expect_refusal(run("run missions/test.toml --campaign roug"), "did you mean rough?");
  expect_refusal(run("run missions/test.toml"), "--campaign NAME is needed");
  expect_refusal(run("status ."), "plan.json: there is none");
  ASSERT_EQ(run("expand missions/test.toml --campaign rough --out c").exit_code, 0);
  expect_refusal(run("expand missions/test.toml --campaign rough --out c"), "holds a campaign; --out DIR keeps it");
  const std::string cases = work.read("c/cases.csv"), mission = work.read("missions/test.toml"), plan = work.read("c/plan.json");
  work.write("c/cases.csv", cases.substr(0, cases.size() - 2) + "9\n");
  expect_refusal(run("run c"), "c/cases.csv:7: case 5 has ");
  work.write("c/cases.csv", cases);
  const std::string kept = "c/" + Json::parse(plan).at("mission").get<std::string>();
  work.write(kept, mission + "# a word\n");
  expect_refusal(run("run c"), "test.toml: is not what the campaign was expanded from");
  work.write(kept, mission);
  const auto with_other = [&](const std::string& digest) {
    const std::size_t place = plan.find('"' + digest + "\": \"") + digest.size() + 5;
    return plan.substr(0, place) + (plan[place] == '0' ? "1" : "0") + plan.substr(place + 1);
  };
  work.write("c/plan.json", with_other("program"));
  expect_refusal(run("run c"), "this mdat is another one");
  work.write("c/plan.json", with_other("image"));
  expect_refusal(run("run c"), "compiled: is not what the campaign was expanded from");
  work.write("c/plan.json", plan.substr(0, plan.size() / 2));
  expect_refusal(run("run c"), "c/plan.json: ");
}

// The mission is edited, then gone, and the folder is elsewhere: its cases are what they were.
TEST_F(CampaignCommand, FliesFromItsFolderAlone) {
  VERIFIES("LASSO-GND-068~1");
  ASSERT_EQ(fly("here").exit_code, 0);
  const std::string mission = work.read("missions/test.toml"), results = work.read("here/results.csv");
  work.write("missions/test.toml", mission + "# a word\n");
  expect_refusal(fly("here"), "before test.toml changed: mdat campaign run here goes on with that");
  ASSERT_EQ(fly("new").exit_code, 0);
  EXPECT_EQ(run("compare here new").exit_code, 0);
  std::filesystem::remove_all(work / "missions");
  std::filesystem::create_directories(work / "far/away");
  std::filesystem::rename(work / "here", work / "far/away/there");
  std::filesystem::remove_all(work / "far/away/there/chunks");
  EXPECT_EQ(run("run far/away/there --no-report").exit_code, 0);
  EXPECT_EQ(work.read("far/away/there/results.csv"), results);
  EXPECT_EQ(run("case far/away/there 2 --no-report").exit_code, 0);
}

// The campaign's copy of the mission is in a folder of a name that somebody may have, and may itself be what is expanded.
TEST_F(CampaignCommand, TakesNobodysFolder) {
  VERIFIES("LASSO-GND-068~1");
  work.write("own/mission/notes.txt", "mine\n");
  expect_refusal(run("expand missions/test.toml --campaign rough --out own"), "own/mission: is there, and no campaign beside it");
  expect_refusal(run("expand missions/test.toml --campaign rough --out own --force"), "own/mission: is there, and no campaign beside it");
  EXPECT_EQ(work.read("own/mission/notes.txt"), "mine\n");
  ASSERT_EQ(run("expand missions/test.toml --campaign rough --out c").exit_code, 0);
  const std::string kept = "c/" + Json::parse(work.read("c/plan.json")).at("mission").get<std::string>(), mission = work.read(kept);
  ASSERT_EQ(run("expand " + kept + " --campaign rough --out c --force").exit_code, 0);
  EXPECT_EQ(work.read("c/" + Json::parse(work.read("c/plan.json")).at("mission").get<std::string>()), mission);
  EXPECT_EQ(run("run c --no-report").exit_code, 0);
}

TEST_F(CampaignCommand, RemovesNothingUnderARunner) {
  VERIFIES("LASSO-GND-090~1");
  ASSERT_EQ(run("expand missions/test.toml --campaign rough --out c").exit_code, 0);
  work.write("c/chunks/1of2.part", "a runner has it");
  const int file = open((work / "c/chunks/1of2.part").c_str(), O_RDWR);
  ASSERT_EQ(flock(file, LOCK_EX), 0);
  expect_refusal(run("expand missions/test.toml --campaign rough --out c --force"), "1of2.part: another process flies this chunk");
  EXPECT_EQ(work.read("c/chunks/1of2.part"), "a runner has it");
  close(file);
  EXPECT_EQ(run("expand missions/test.toml --campaign rough --out c --force").exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(work / "c/chunks"));
}

TEST_F(CampaignCommand, StopsWhenItsCriteriaAreDecided) {
  VERIFIES("LASSO-GND-055~1");
  write_campaigns(kCampaign + "[campaign.rough.unused]\n");
  expect_refusal(fly("x"), "unused");
  write_campaigns(kCampaign);
  const Answer stopped = fly("s", "--set campaign.rough.cases=400 --set campaign.rough.look_every=10 --set campaign.rough.frames=1");
  ASSERT_EQ(stopped.exit_code, 0) << stopped.err;
  const Json summary = Json::parse(work.read("s/summary.json"));
  EXPECT_TRUE(summary.at("stopped_by_rule"));
  EXPECT_EQ(summary.at("cases").get<int>() % 10, 0);
  EXPECT_LT(summary.at("cases"), 400);
  EXPECT_EQ(summary.at("criteria").at(0).at("verdict"), "met");
  const Answer status = run("status s");
  EXPECT_EQ(status.exit_code, 0);
  EXPECT_NE(status.out.find("the stopping rule ended the campaign after " + std::to_string(summary.at("cases").get<int>())),
            std::string::npos)
      << status.out;
}

}  // namespace
}  // namespace lasso::ft
