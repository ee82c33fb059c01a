#include "mdat/scene/file_text.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <tuple>

#include "ut/mdat/scene/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::scene {
namespace {

TEST(FileText, ErrorsOfReadersKeepTheirPlaces) {
  VERIFIES("LASSO-SCN-017~1");
  for (const auto& [error, line, column, text] : {std::tuple{"a:b.csv:12:7: no number", 12, 7, "no number"},
                                                  {"a:b.csv:12: no number", 12, 1, "no number"},
                                                  {"a:b.csv: 9 rows", 0, 0, "9 rows"},
                                                  {"some: other", 0, 0, "some: other"},
                                                  {"a:b.csv:99999999999: x", 0, 0, "99999999999: x"}}) {
    Problems problems{Place{}};
    add_error(std::runtime_error(error), "a:b.csv", problems);
    const Problem& problem = problems.all().at(0);
    EXPECT_EQ(problem.file, "a:b.csv");
    EXPECT_EQ(problem.line, line);
    EXPECT_EQ(problem.column, column);
    EXPECT_EQ(problem.expected, text);
  }
}

TEST(FileText, AFolderIsNoText) {
  VERIFIES("LASSO-SCN-017~1");
  EXPECT_TRUE(problems_of([] { text_of_file("/nowhere"); }).starts_with("/nowhere: "));
  EXPECT_TRUE(problems_of([] { text_of_file("/"); }).starts_with("/: "));
}

}  // namespace
}  // namespace lasso::mdat::scene
