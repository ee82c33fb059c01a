#include "mdat/campaign/conclusion_text.hpp"

#include <gtest/gtest.h>

#include "ut/mdat/campaign/tables.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using test::at_most;
using test::campaign_of;
using test::kInfinite;

std::string text_of(const Criterion& criterion, const ResultTable& table) {
  return conclusion_text(conclude(campaign_of({criterion}), table).at(0));
}

TEST(ConclusionText, HasTheBoundsThatAreThere) {
  VERIFIES("LASSO-GND-054~1");
  EXPECT_EQ(bounds_text({"", "found_s", 2, 5, 1, 0.95}), "2 <= found_s <= 5");
  EXPECT_EQ(bounds_text({"", "found_s", 2, kInfinite, 1, 0.95}), "found_s >= 2");
  EXPECT_EQ(criterion_text(at_most("", "wrong", 0, 0.98)), "wrong <= 0 in at least 98 %");
}

TEST(ConclusionText, SaysWhatWouldDecide) {
  VERIFIES("LASSO-GND-054~1");
  EXPECT_EQ(text_of(at_most("", "rms_mm", 1, 0.98), test::table_with(497, 500)),
            "497 of 500 cases are within rms_mm <= 1. With a confidence of 95 % that shows 98.2 % to 99.88 % of all cases that could be "
            "drawn; at least 98 % is asked for.");
  const std::string undecided = text_of(at_most("", "rms_mm", 1, 0.99), test::table_with(497, 500));
  EXPECT_NE(undecided.find("a campaign of about 2400 cases would decide it"), std::string::npos) << undecided;
  CampaignSource sequential = campaign_of({at_most("", "rms_mm", 1, 0.99)});
  sequential.look_every = 50;
  EXPECT_NE(conclusion_text(conclude(sequential, test::table_with(497, 500))[0]).find(" It needs about "), std::string::npos);
  EXPECT_NE(text_of(at_most("", "rms_mm", 1, 1), test::table_with(10, 10)).find("No number of cases shows 100 %; these show 69.1 %"),
            std::string::npos);
  EXPECT_NE(text_of(at_most("", "rms_mm", 1, 0.5), test::table_with(5, 10)).find("no number of cases tells"), std::string::npos);
  EXPECT_NE(text_of(at_most("", "rms_mm", 1, 0.5), test::table_of({})).find("No case was flown."), std::string::npos);
}

TEST(ConclusionText, NamesCasesThatCountAsOutside) {
  VERIFIES("LASSO-GND-054~1");
  ResultTable table = test::table_of({0.5, test::kNoNumber, 0.5});
  table.rows[2].status = "failed:refused";
  const std::string text = text_of(at_most("", "rms_mm", 1, 0.5), table);
  EXPECT_NE(text.find("Cases that failed to run count as outside: 1."), std::string::npos) << text;
  EXPECT_NE(text.find("Cases without rms_mm (such as those without a valid pose) count as outside: 1."), std::string::npos) << text;
}

}  // namespace
}  // namespace lasso::mdat
