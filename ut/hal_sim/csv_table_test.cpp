#include "hal_sim/csv_table.hpp"

#include <gtest/gtest.h>

#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

// The same table as others write it.
TEST(CsvTable, ReadsWhatSpreadsheetsAndScriptsWrite) {
  VERIFIES("LASSO-SIM-039~1");
  const struct {
    const char* what;
    std::string text;
  } cases[] = {{"plain", "name,a,b\none,1.5,-2\ntwo,3,4e1\n"},
               {"byte order mark", "\xEF\xBB\xBFname,a,b\none,1.5,-2\ntwo,3,4e1\n"},
               {"blanks, signs", " name , a,\tb \n one , +1.5 , -2.0\ntwo,\t3 ,+40\n"},
               {"blank lines, CR LF", "\r\nname,a,b\r\n\r\none,1.5,-2\r\n,,\r\n  \r\ntwo,3,40\r\n\r\n\r\n"},
               {"quotes", "\"name\",\"a\",\"b\"\n\"one\",\"1.5\",\"-2\"\n\"two\",\" 3 \",\"40\"\n"},
               {"semicolons, decimal commas", "name;a;b\none;1,5;-2\ntwo;3;40,0\n"},
               {"tabs", "name\ta\tb\none\t1.5\t-2\ntwo\t3\t40\n"},
               {"marked header, remarks", "# made elsewhere\n# name,a,b\none,1.5,-2\n# half way\ntwo,3,40\n"},
               {"header marked as CloudCompare does", "//name,a,b\none,1.5,-2\ntwo,3,40\n"},
               {"other columns and case", "x,B,Name,A\n7,-2,one,1.5\n,40,two,3\n"},
               {"a comma at the end", "name,a,b,\none,1.5,-2,\ntwo,3,40,\n"},
               {"no line end", "name,a,b\none,1.5,-2\ntwo,3,40"}};
  for (const auto& c : cases) {
    CsvTable table("t.csv", c.text, "name,a,b");
    const std::size_t name = table.need({"name"}), a = table.need({"alpha", "a"}), b = table.need({"b"});
    ASSERT_TRUE(table.next()) << c.what;
    EXPECT_EQ(table.field(name), "one") << c.what;
    EXPECT_EQ(table.number(a), 1.5) << c.what;
    EXPECT_EQ(table.number(b), -2) << c.what;
    ASSERT_TRUE(table.next()) << c.what;
    EXPECT_EQ(table.field(name), "two") << c.what;
    EXPECT_EQ(table.number(a), 3) << c.what;
    EXPECT_EQ(table.number(b), 40) << c.what;
    EXPECT_FALSE(table.next()) << c.what;
  }
}

std::string refusal(const std::string& text) {
  try {
    CsvTable table("t.csv", text, "a,b");
    const std::size_t a = table.need({"a"}), b = table.need({"b"});
    while (table.next()) static_cast<void>(table.number(a) + table.number(b));
  } catch (const ScanFileError& error) {
    return error.what();
  }
  return "none";
}

TEST(CsvTable, RefusesWithThePlace) {
  VERIFIES("LASSO-SIM-021~1");
  EXPECT_EQ(refusal(""), "t.csv:1:1: the file is empty, expected the header \"a,b\"");
  EXPECT_EQ(refusal("\n\na,c\n1,2\n"), "t.csv:3:1: the header is \"a,c\", expected \"a,b\"");
  EXPECT_EQ(refusal("a,b\n1,2\n\n1,2,3\n").find("t.csv:4: the row has 3 fields, expected 2"), 0u);
  EXPECT_EQ(refusal("a,b\n1,  x1\n").find("t.csv:2:5: b is \"x1\""), 0u);
  EXPECT_EQ(refusal("a;b\n1;1,5,0\n").find("t.csv:2:3: b is \"1,5,0\""), 0u);
  EXPECT_EQ(refusal(std::string("\xFF\xFE"
                                "a\0,\0b\0",
                                8))
                .find("t.csv:1:1: the text is UTF-16; save it as CSV UTF-8"),
            0u);
}

TEST(CsvTable, ReadsYesAndNoAsOtherProgramsWriteThem) {
  VERIFIES("LASSO-SIM-039~1");
  CsvTable table("t.csv", "a,b,c,d,e,f,g\n1,1.0,True,0,0.0,FALSE,2\n", "a");
  ASSERT_TRUE(table.next());
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(table.yes_or_no(i), i < 3) << i;
  EXPECT_THROW(static_cast<void>(table.yes_or_no(6)), ScanFileError);
}

TEST(CsvTable, KnowsFieldsThatSayNothing) {
  VERIFIES("LASSO-SIM-036~1");
  CsvTable table("t.csv", "a,b,c,d,e,f\n,NaN,-inf,nan(ind),#N/A,0\n", "a");
  ASSERT_TRUE(table.next());
  for (std::size_t i = 0; i < 5; ++i) EXPECT_TRUE(table.says_nothing(i)) << i;
  EXPECT_FALSE(table.says_nothing(5));
}

}  // namespace
}  // namespace lasso::sim
