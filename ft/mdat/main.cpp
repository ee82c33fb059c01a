// All tests of mdat's command line are one program, ft_mdat, as most of their build would be the same headers again. A link ft_mdat_NAME to
// it runs those of NAME_test.cpp alone: ctest runs these beside each other.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

// A filter for the tests whose source file ends in `file`. Empty where a test is in a file that no link is named by, and would never run.
std::string filter_for(const std::string& file) {
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  std::string filter;
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *all.GetTestSuite(i);
    for (int k = 0; k < suite.total_test_count(); ++k) {
      const testing::TestInfo& test = *suite.GetTestInfo(k);
      const std::string source = test.file();
      if (!source.ends_with("_test.cpp")) return "";
      if (source.ends_with(file)) filter += std::string(suite.name()) + "." + test.name() + ":";
    }
  }
  return filter;
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const std::string program(argv[0]);
  const std::string prefix = "/ft_mdat_";
  const std::size_t place = program.rfind(prefix);
  if (place != std::string::npos && GTEST_FLAG_GET(filter) == "*") {
    GTEST_FLAG_SET(filter, filter_for("/" + program.substr(place + prefix.size()) + ".cpp"));
    if (GTEST_FLAG_GET(filter).empty())
      return std::fprintf(stderr, "%s: no such test file, or a test that is in none *_test.cpp\n", argv[0]), EXIT_FAILURE;
  }
  return RUN_ALL_TESTS();
}
