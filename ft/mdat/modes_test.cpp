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
  EXPECT_EQ(answer.out, read_text(std::filesystem::path(MDAT_SOURCES) / "docs/modes.md")) << "make it anew: mdat modes > docs/modes.md";
}

TEST(Faults, TheDocumentedTableIsTheExecutedOne) {
  VERIFIES("LASSO-HLT-001~1");
  const WorkFolder work;
  const Answer answer = work.mdat("faults");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_EQ(answer.out, read_text(std::filesystem::path(MDAT_SOURCES) / "docs/faults.md")) << "make it anew: mdat faults > docs/faults.md";
}

}  // namespace
}  // namespace lasso::ft
