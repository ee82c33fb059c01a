#include "mdat/missiondb/campaign_reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <regex>

#include "mdat/missiondb/mission_text.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// What follows begins on line 11.
const std::string kReaderHead =
    "[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmodel = 'box.toml'\n[scenario.s]\nseed = 1\nranges_m = [5]\n"
    "[campaign.c]\n";
const std::string kPlainCampaign = "scenario = 's'\ncases = 100\n";

class CampaignReaderTest : public ::testing::Test {
 protected:
  CampaignReaderTest() { folder_.write("box.toml", "[[part]]\nkind = 'box'\nsize = [1, 1, 1]\n"); }
  CampaignSource load(const std::string& text) { return load_mission(folder_.write("m.toml", kReaderHead + text)).campaigns.at("c"); }
  // The law of the only dispersion.
  template <class L>
  L law_of(const std::string& text) {
    const CampaignSource campaign = load(kPlainCampaign + text + "\n");
    EXPECT_EQ(campaign.dispersions.size(), 1U);
    const Law law = campaign.dispersions.at(0).law;
    if constexpr (std::is_constructible_v<NumberLaw, L>) {
      return std::get<L>(std::get<NumberLaw>(law));
    } else {
      return std::get<L>(law);
    }
  }
  // One error, with its place and key, that says all of `words`.
  void refuses(const std::string& text, const std::vector<std::string>& words) {
    const std::string message = mission_error_of([&] { static_cast<void>(load(kPlainCampaign + text + "\n")); });
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0) << text << ": " << message;
    static const std::regex kPlace("(.*/)?m\\.toml:1[0-9]:[1-9][0-9]*: campaign\\.c.*: .*");
    EXPECT_TRUE(std::regex_match(message, kPlace)) << text << ": " << message;
    for (const std::string& word : words)
      EXPECT_NE(message.find(word), std::string::npos) << text << "\ngot: " << message << "\nexpected: " << word;
  }
  Folder folder_;
};

TEST_F(CampaignReaderTest, PlainValuesAndTheirPresets) {
  VERIFIES("LASSO-GND-045~1");
  const CampaignSource few = load(kPlainCampaign);
  EXPECT_EQ(few.name, "c");
  EXPECT_EQ(few.scenario, "s");
  EXPECT_EQ(few.cases, 100U);
  EXPECT_EQ(few.seed, 1U);
  EXPECT_EQ(few.frames, 0U);
  EXPECT_EQ(few.sampling, Sampling::kRandom);
  const CampaignSource all = load("scenario = 's'\ncases = 10_000_000\nseed = 4294967295\nframes = 25\nsampling = 'sobol'\n");
  EXPECT_EQ(all.cases, 10000000U);
  EXPECT_EQ(all.seed, 4294967295U);
  EXPECT_EQ(all.frames, 25U);
  EXPECT_EQ(all.sampling, Sampling::kSobol);
  const MissionSource source = load_mission(folder_.path() / "m.toml", {"campaign.c.cases=3"});
  EXPECT_EQ(source.campaigns.at("c").cases, 3U);
  EXPECT_TRUE(source.origins.at("campaign.c.cases").set);
  EXPECT_EQ(source.origins.at("campaign.c.frames").line, 14);
  EXPECT_NE(info_text(source).find("campaign c: 3 cases of scenario s"), std::string::npos);
}

TEST_F(CampaignReaderTest, LawsOfOneNumber) {
  VERIFIES("LASSO-GND-045~1");
  EXPECT_EQ(law_of<Uniform>("truth.range_m = { uniform = [2, 7] }").high, 7);
  EXPECT_EQ(law_of<LogUniform>("truth.sigma0_m = { log_uniform = [1e-5, 1e-3] }").low, 1e-5);
  EXPECT_EQ(law_of<Fixed>("truth.tilt_deg = -30").value, -30);
  EXPECT_EQ(law_of<Fixed>("truth.noise = false").value, 0);
  const auto cut = law_of<Normal>("truth.dropout_probability = { normal = [0.1, 0.2], within = [0, 0.3] }");
  EXPECT_EQ(cut.low, 0);
  EXPECT_EQ(cut.high, 0.3);
  const auto free = law_of<Normal>("truth.tilt_deg = { normal = [10, 5] }");
  EXPECT_EQ(free.low, -180) << "the range of the key";
  const auto one = law_of<OneOf>("mission.estimation.surface_sigma_m = { one_of = [0, 0.005], weights = [3, 1] }");
  EXPECT_EQ(one.values, (std::vector<double>{0, 0.005}));
  EXPECT_EQ(one.weights, (std::vector<double>{3, 1}));
  EXPECT_EQ(law_of<OneOf>("mission.scan.points = { one_of = [256, 512, 1024] }").weights, (std::vector<double>{1, 1, 1}));
  EXPECT_EQ(law_of<OneOf>("mission.estimation.deskew = { one_of = [true, false] }").values, (std::vector<double>{1, 0}));
}

TEST_F(CampaignReaderTest, LawsOfSeveralNumbers) {
  VERIFIES("LASSO-GND-045~1");
  const CampaignSource campaign =
      load(kPlainCampaign +
           "truth.attitude = 'any'\ntruth.spin_degps = { any_direction = 2 }\ntruth.offset_m = [{ uniform = [-1, 1] }, 0.25]\n");
  std::vector<std::string> columns;
  for (const Dispersion& dispersion : campaign.dispersions)
    columns.insert(columns.end(), dispersion.columns.begin(), dispersion.columns.end());
  EXPECT_EQ(columns, (std::vector<std::string>{"truth.roll_deg", "truth.tilt_deg", "truth.boresight_deg", "truth.offset_m.x",
                                               "truth.offset_m.y", "truth.spin_degps.x", "truth.spin_degps.y", "truth.spin_degps.z"}));
  EXPECT_EQ(std::get<Fixed>(std::get<NumberLaw>(campaign.dispersions[2].law)).value, 0.25);
  EXPECT_EQ(campaign.dispersions[2].key, "campaign.c.truth.offset_m[1]");
  const auto normal = law_of<Correlated>(
      "[[campaign.c.together]]\nkeys = ['truth.offset_m.x', 'truth.range_m']\nmean = [0, 5]\ncovariance = [[0.01, 0.002], [0.002, 0.04]]");
  EXPECT_EQ(normal.covariance, (std::vector<double>{0.01, 0.002, 0.002, 0.04}));
  EXPECT_EQ(normal.low, (std::vector<double>{-10000, 0.01})) << "ranges of the keys";
}

TEST_F(CampaignReaderTest, TablesOfAFile) {
  VERIFIES("LASSO-GND-045~1");
  folder_.write("t.csv", "case;seed;truth.range_m;mission.scan.points\r\n0;11;2,5;256\r\n\r\n1;12;3;512\r\n");
  const auto rows = law_of<Rows>("[[campaign.c.together]]\ntable = 't.csv'\nrows = 'drawn'");
  EXPECT_FALSE(rows.in_order);
  EXPECT_EQ(rows.values, (std::vector<double>{2.5, 256, 3, 512}));
  const std::string table = "[[campaign.c.together]]\ntable = 't.csv'";
  EXPECT_TRUE(law_of<Rows>(table).in_order);
  folder_.write("t.csv", "truth.range_m,truth.tilt_deg\n2,1\n3\n");
  refuses(table, {"m.toml:14:9: campaign.c.together[0].table", "t.csv:3", "1 fields"});
  folder_.write("t.csv", "truth.range_m,truth.tilt_deg\n2,1\n3,190\n");
  refuses(table, {"t.csv:3:3", "truth.tilt_deg is 190, expected -180 to 180 deg"});
  folder_.write("t.csv", "mission.scan.points\n256\n256.5\n");
  refuses(table, {"t.csv:3:1", "a whole number"});
  folder_.write("t.csv", "truth.rnage_m\n2\n");
  refuses(table, {"t.csv:1", "truth.rnage_m", "did you mean truth.range_m?"});
  folder_.write("t.csv", "truth.range_m\n");
  refuses(table, {"no row under its header"});
  folder_.write("t.csv", "case,seed\n0,1\n");
  refuses(table, {"no column to vary"});
  refuses("[[campaign.c.together]]\ntable = 'none.csv'", {"none.csv", "no such file in"});
}

TEST_F(CampaignReaderTest, CriteriaHaveBounds) {
  VERIFIES("LASSO-GND-045~1");
  const std::string head = "[campaign.c.criteria.good]\n";
  const Criterion criterion = load(kPlainCampaign + head + "figure = 'wrong'\nat_most = 0\nshare_min = 0.98\n").criteria.at(0);
  EXPECT_EQ(criterion.name, "good");
  EXPECT_EQ(criterion.figure, "wrong");
  EXPECT_EQ(criterion.at_most, 0);
  EXPECT_EQ(criterion.at_least, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(criterion.share_min, 0.98);
  EXPECT_EQ(criterion.confidence, 0.95);
  refuses(head + "figure = 'first_wrong'\nat_least = 9\nshare_min = 0.9", {"criteria.good.figure: first_wrong: has no number where no"});
  refuses(head + "figure = 'wrong'\nshare_min = 0.9", {"criteria.good.at_most", "a bound of the figure"});
  refuses(head + "figure = 'wrongs'\nat_most = 0\nshare_min = 0.9", {"did you mean \"wrong\"?"});
  refuses(head + "figure = 'wrong'\nat_most = 0", {"share_min", "is missing"});
  refuses(head + "figure = 'wrong'\nat_most = 0\nshare_min = 1", {"m.toml:16:13", "share_min: 1", "less than 1"});
  refuses(head + "figure = 'wrong'\nat_most = 0\nshare_min = 0", {"share_min: 0", "more than 0"});
  refuses(head + "figure = 'rms_mm'\nat_least = 2\nat_most = 1\nshare_min = 0.9", {"at_least: 2", "at_most, which is 1"});
  refuses(head + "figure = 'wrong'\nat_most = 0\nshare_min = 0.9\nconfidence = 0.5", {"confidence: 0.5", "more than 0.5"});
  refuses(head + "figure = 'wrong'\nat_most = 0\nshare_min = 0.9\nconfidence = 1", {"confidence: 1", "less than 1"});
  refuses("criteria.good = 3", {"expected a table [campaign.c.criteria.good]"});
}

TEST_F(CampaignReaderTest, WrongLawsAreNamedWithPlaceAndRemedy) {
  VERIFIES("LASSO-GND-045~1");
  refuses("truth.range_m = { uniform = [7, 2] }", {"m.toml:13:29: campaign.c.truth.range_m.uniform", "the lower end first"});
  refuses("truth.outlier_probability = { uniform = [0, 1.5] }", {"outlier_probability.uniform[1]: 1.5", "from 0 to 0.9"});
  refuses("truth.tilt_deg = { one_of = [10, 200] }", {"tilt_deg.one_of[1]: 200", "-180 to 180 deg"});
  refuses("truth.tilt_deg = 200", {"tilt_deg: 200", "-180 to 180 deg"});
  refuses("truth.sigma0_m = { log_uniform = [0, 1e-3] }", {"above 0"});
  refuses("truth.dropout_probability = { normal = [0.05, 0.03] }", {"reaches from -0.07 to 0.17", "within = [0, 0.17]"});
  refuses("truth.dropout_probability = { normal = [0.05, 0.03], within = [-0.1, 0.2] }", {"within[0]: -0.1", "from 0 to 0.9"});
  refuses("truth.tilt_deg = { normal = [0, 1], within = [10, 20] }", {"more than 6 sigma away"});
  refuses("truth.tilt_deg = { normal = [0, 0] }", {"a sigma above 0"});
  refuses("truth.tilt_deg = { uniform = [0, inf] }", {"not a finite number"});
  refuses("truth.tilt_deg = { uniform = [0, 1], normal = [0, 1] }", {"exactly one law, not 2"});
  refuses("truth.tilt_deg = {}", {"exactly one law, not 0"});
  refuses("truth.tilt_deg = { unifrom = [0, 1] }", {"unknown law", "did you mean uniform?"});
  refuses("truth.tilt_deg = { uniform = [0, 1], within = [0, 1] }", {"within", "goes with normal alone"});
  refuses("truth.tilt_deg = { uniform = [0, 1], weights = [1] }", {"weights", "goes with one_of alone"});
  refuses("truth.tilt_deg = { one_of = [] }", {"one value or more"});
  refuses("truth.tilt_deg = { one_of = [1, 2], weights = [1] }", {"a list of 2 numbers"});
  refuses("truth.tilt_deg = { one_of = [1, 2], weights = [1, 0] }", {"weights[1]"});
  refuses("truth.tilt_deg = 'steep'", {"a number or a law"});
  refuses("mission.scan.points = { uniform = [256, 512] }", {"no continuous law", "one_of"});
  refuses("truth.spin_degps = { any_direction = { uniform = [-1, 1] } }", {"from 0 to 360 deg/s"});
  refuses("truth.spin_degps = [1, 2]", {"a list of 3"});
  refuses("truth.offset_m = { any_direction = 1 }", {"three numbers"});
  refuses("truth.attitude = 'all'", {"expected \"any\""});
}

// Each law at either end of its key's range, and beyond it.
TEST_F(CampaignReaderTest, NoLawReachesOutOfTheRangeOfItsKey) {
  VERIFIES("LASSO-GND-045~1");
  const auto takes = [&](const std::string& law) { static_cast<void>(load(kPlainCampaign + "truth.tilt_deg = " + law + "\n")); };
  for (const char* within : {"-180", "180", "{ uniform = [-180, 180] }", "{ normal = [0, 45] }",
                             "{ normal = [0, 90], within = [-180, 180] }", "{ one_of = [-180, 180] }"})
    EXPECT_NO_THROW(takes(within)) << within;
  for (const char* beyond : {"-180.1", "180.1", "{ uniform = [-180.1, 180] }", "{ uniform = [-180, 180.1] }", "{ normal = [-0.1, 45] }",
                             "{ normal = [0.1, 45] }", "{ normal = [0, 90], within = [-180.1, 180] }",
                             "{ normal = [0, 90], within = [-180, 180.1] }", "{ one_of = [-180.1, 180] }", "{ one_of = [-180, 180.1] }"})
    refuses(std::string("truth.tilt_deg = ") + beyond, {"tilt_deg", "180"});
  refuses("truth.sigma0_m = { log_uniform = [1e-5, 1e9] }", {"sigma0_m.log_uniform[1]: 1000000000.0", "from "});
  for (const char* correlated : {"mean = [-179]", "mean = [179]"})
    refuses(std::string("[[campaign.c.together]]\nkeys = ['truth.tilt_deg']\n") + correlated + "\ncovariance = [[1]]", {"out of range"});
  for (const char* row : {"-180.1", "180.1"}) {
    folder_.write("t.csv", std::string("truth.tilt_deg\n0\n") + row + "\n");
    refuses("[[campaign.c.together]]\ntable = 't.csv'", {"t.csv:3:1", "-180 to 180 deg"});
  }
}

TEST_F(CampaignReaderTest, WrongNamesAreNamedWithWhatIsMeant) {
  VERIFIES("LASSO-GND-045~1");
  refuses("truth.rnage_m = 3", {"m.toml:13:7", "unknown key; did you mean range_m?"});
  refuses("mission.estimation.surface_sigma = 0", {"did you mean estimation.surface_sigma_m?"});
  refuses("mission.estimation = 3", {"unknown key"});
  refuses("truth.mission.id = 3", {"unknown key"});
  refuses("frmaes = 3", {"did you mean campaign.c.frames?"});
  for (const char* key : {"autonomous", "variants", "frames", "seed", "drawn", "paper_table", "ranges_m", "times_s"})
    refuses(std::string("truth.") + key + " = 1", {"does not vary from case to case: "});
  refuses("mission.sensor.range_max_m = 9", {"does not vary from case to case: "});
  refuses("truth.attitude = 'any'\ntruth.tilt_deg = 3",
          {"campaign.c.truth.tilt_deg: truth.tilt_deg: has a law already, of campaign.c.truth.attitude"});
  const std::string error =
      mission_error_of([&] { static_cast<void>(load("scenario = 'p'\ncases = 0\nseed = -1\nframes = 1.5\nsampling = 'lhs'\n")); });
  for (const char* word :
       {"scenario: \"p\": no such scenario; the mission has s", "cases: 0", "seed: -1", "frames: 1.5", "sampling: 'lhs'"})
    EXPECT_NE(error.find(word), std::string::npos) << error;
}

TEST_F(CampaignReaderTest, WrongCovariancesAreNamedWithFigures) {
  VERIFIES("LASSO-GND-045~1");
  const std::string head = "[[campaign.c.together]]\nkeys = ['truth.offset_m.x', 'truth.offset_m.y']\n";
  refuses(head + "mean = [0, 0]\ncovariance = [[1, 2], [2, 1]]",
          {"m.toml:16:14: campaign.c.together[0].covariance", "smallest eigenvalue is -1"});
  refuses(head + "mean = [0, 0]\ncovariance = [[1, 1], [1, 1]]", {"not positive definite"});
  refuses(head + "mean = [0, 0]\ncovariance = [[1, 0.5], [0.25, 1]]", {"not symmetric: row 2, column 1 is 0.25, row 1, column 2 is 0.5"});
  refuses(head + "mean = [0, 0]\ncovariance = [[1, 0]]", {"a square matrix, 2 lists of 2"});
  refuses(head + "mean = [0, 0]\ncovariance = [[1, 0], [0]]", {"covariance[1]", "a list of 2 numbers"});
  refuses(head + "mean = [0, 0]\ncovariance = [[1, 0], [0, 0]]", {"the variance of truth.offset_m.y is 0"});
  refuses(head + "mean = [0]\ncovariance = [[1, 0], [0, 1]]", {"as many numbers as keys: 2, not 1"});
  refuses(head + "mean = [0, 9999]\ncovariance = [[1, 0], [0, 1]]", {"truth.offset_m.y is out of range: reaches from 9995 to 10003"});
  refuses("[[campaign.c.together]]\nkeys = ['truth.outlier_probability']\nmean = [0.1]\ncovariance = [[0.01]]",
          {"reaches from -0.3 to 0.5 (mean and 4 sigma), expected 0 to 0.9: make its variance smaller"});
  refuses(head + "mean = [0, 0]", {"expected keys, mean and covariance"});
  refuses(head + "table = 't.csv'", {"expected keys, mean and covariance"});
  const std::string one = "mean = [0]\ncovariance = [[1]]";
  refuses("[[campaign.c.together]]\nkeys = ['truth.offset_m']\n" + one, {"no such column; did you mean truth.offset_m.x?"});
  refuses("[[campaign.c.together]]\nkeys = ['mission.scan.points']\n" + one, {"has no normal law"});
  refuses("together = 3", {"expected [[campaign.c.together]]"});
}

TEST_F(CampaignReaderTest, ThatIsNoTableIsRefused) {
  VERIFIES("LASSO-GND-045~1");
  refuses("truth = 3", {"expected a table [campaign.c.truth]"});
  const auto whole = [&](const std::string& line) {
    return mission_error_of(
        [&] { static_cast<void>(load_mission(folder_.write("n.toml", line + kReaderHead.substr(0, kReaderHead.find("[campaign"))))); });
  };
  EXPECT_NE(whole("campaign = 3\n").find("expected tables [campaign.NAME]"), std::string::npos);
  EXPECT_NE(whole("campaign.c = 3\n").find("expected a table [campaign.c]"), std::string::npos);
}

}  // namespace
}  // namespace lasso::mdat
