#include "mdat/campaign/case_table.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "mdat/common/errors.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

class CaseTableTest : public ::testing::Test {
 protected:
  ~CaseTableTest() override { std::filesystem::remove(file_); }
  void write(const std::string& text) { std::ofstream(file_, std::ios::binary) << text; }
  void write(const CaseDraws& draws, std::uint32_t cases) {
    std::ofstream out(file_, std::ios::binary);
    write_cases(draws, cases, out);
  }
  // The error of the first line that has one.
  std::string error_of(const std::string& text) {
    write(text);
    return error_of([&] {
      CaseTable table(file_);
      while (table.next()) {
      }
    });
  }
  template <class Action>
  static std::string error_of(const Action& action) {
    try {
      action();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  std::filesystem::path file_ = std::filesystem::temp_directory_path() / ("lasso_cases_" + std::to_string(::getpid()) + ".csv");
};

CampaignSource three_columns(std::uint32_t cases) {
  CampaignSource campaign;
  campaign.cases = cases;
  campaign.dispersions = {
      {{"truth.range_m"}, Uniform{2, 7}}, {{"truth.sigma0_m"}, LogUniform{1e-12, 1e12}}, {{"truth.tilt_deg"}, Normal{0, 30, -180, 180}}};
  return campaign;
}

// Doubles of every size come back to the bit.
TEST_F(CaseTableTest, NumbersReadBackAsTheyWere) {
  VERIFIES("LASSO-GND-049~1");
  constexpr std::uint32_t kCases = 500;
  const CaseDraws draws(three_columns(kCases));
  write(draws, kCases);
  CaseTable table(file_);
  EXPECT_EQ(table.columns(), draws.columns());
  for (std::uint32_t k = 0; k < kCases; ++k) {
    const auto read = table.next();
    ASSERT_TRUE(read.has_value());
    EXPECT_EQ(read->numbers, draws.values(k).numbers);
    EXPECT_EQ(read->seed, draws.values(k).seed);
  }
  EXPECT_FALSE(table.next().has_value());
  check_cases(file_, draws, kCases);
}

TEST_F(CaseTableTest, ExtremeNumbersReadBack) {
  VERIFIES("LASSO-GND-049~1");
  CampaignSource campaign;
  campaign.cases = 1;
  const std::vector<double> numbers{0.1, 1.0 / 3, 5e-324, 1.7976931348623157e308, -0.0, 1e22, 123456789012345680.0};
  for (const double number : numbers) campaign.dispersions.push_back({{"truth.x"}, Fixed{number}});
  write(CaseDraws(campaign), 1);
  const auto read = CaseTable(file_).next();
  EXPECT_EQ(read->numbers, numbers);
  EXPECT_TRUE(std::signbit(read->numbers[4]));
}

TEST_F(CaseTableTest, OneCaseIsReadWithoutTheOthers) {
  VERIFIES("LASSO-GND-049~1");
  const CaseDraws draws(three_columns(40));
  write(draws, 40);
  CaseTable table(file_);
  EXPECT_EQ(table.at(17).numbers, draws.values(17).numbers);
  EXPECT_EQ(table.at(39).numbers, draws.values(39).numbers);
  EXPECT_NE(error_of([&] { table.at(40); }).find("has no case 40, and 40 in all"), std::string::npos);
}

TEST_F(CaseTableTest, ADamagedLineIsNamed) {
  VERIFIES("LASSO-GND-049~1");
  const std::string head = "case,seed,truth.range_m\n0,7,2.5\n";
  const auto expect = [&](const std::string& text, const std::string& words) {
    const std::string error = error_of(text);
    EXPECT_NE(error.find(words), std::string::npos) << "got: " << error << "\nexpected: " << words;
  };
  EXPECT_EQ(error_of(head), "");
  expect(head + "1,8\n", ".csv:3: case 1 has 2 cells, expected 3; restore the file");
  expect(head + "1,8,2.5,3\n", ".csv:3: case 1 has 4 cells");
  expect(head + "1,8,2.5x\n", "has \"2.5x\" as its truth.range_m, expected a number");
  expect(head + "1,8,\n", "has \"\" as its truth.range_m");
  expect(head + "1,8,nan\n", "has \"nan\" as its truth.range_m");
  expect(head + "1,-8,2.5\n", "has the seed \"-8\"");
  expect(head + "2,8,2.5\n", ".csv:3: case 1 is expected here, not \"2\"");
  expect(head + "\n", ".csv:3: case 1 has 1 cells");
  expect(head + "1,8,2.", ".csv:3: case 1 ends in the middle of a line");
  expect("", ".csv:1: expected the header");
  expect("case,truth.range_m\n", ".csv:1: expected the header");
  std::filesystem::remove(file_);
  EXPECT_NE(error_of([&] { CaseTable table(file_); }).find("expand the campaign first"), std::string::npos);
}

TEST_F(CaseTableTest, AnEditedLineIsNamed) {
  VERIFIES("LASSO-GND-049~1");
  const CaseDraws draws(three_columns(5));
  std::ostringstream whole;
  write_cases(draws, 5, whole);
  const std::string text = whole.str();
  const auto error_with = [&](const std::string& edited) {
    write(edited);
    return error_of([&] { check_cases(file_, draws, 5); });
  };
  EXPECT_EQ(error_with(text), "");
  const std::string third = case_line(2, draws.values(2));
  std::string edited = text;
  CaseValues other = draws.values(2);
  other.numbers[1] = 3;
  edited.replace(text.find(third), third.size(), case_line(2, other));
  EXPECT_NE(error_with(edited).find(".csv:4: case 2 has 3 as its truth.sigma0_m, not "), std::string::npos) << error_with(edited);
  EXPECT_NE(error_with(text.substr(0, text.find(case_line(4, draws.values(4))))).find(":6: case 4 is missing"), std::string::npos);
  EXPECT_NE(error_with(text + case_line(5, draws.values(5)) + "\n").find(":7: case 5 is more than the campaign has"), std::string::npos);
  EXPECT_NE(error_with("case,seed,truth.range_m\n").find(":1: the columns are not those"), std::string::npos);
}

}  // namespace
}  // namespace lasso::mdat
