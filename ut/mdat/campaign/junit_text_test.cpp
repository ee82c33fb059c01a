#include "mdat/campaign/junit_text.hpp"

#include <gtest/gtest.h>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TEST(JunitText, IsWellFormedWhateverItSays) {
  VERIFIES("LASSO-GND-058~1");
  EXPECT_EQ(xml_text("<a\x01> & \"b\"\n"), "&lt;a &gt; &amp; &quot;b&quot;\n");
  EXPECT_EQ(junit_case("a.<b>", "c", ""), "    <testcase classname=\"a.&lt;b&gt;\" name=\"c\" time=\"0\"/>\n");
  EXPECT_EQ(junit_case("a", "b", junit_trouble("failure", "t\"", "1 < 2", "x\x02")),
            "    <testcase classname=\"a\" name=\"b\" time=\"0\">\n"
            "      <failure type=\"t&quot;\" message=\"1 &lt; 2\">x </failure>\n    </testcase>\n");
}

}  // namespace
}  // namespace lasso::mdat
