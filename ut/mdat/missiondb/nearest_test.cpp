#include "mdat/source/nearest.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "mdat/missiondb/value_row.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TEST(Nearest, NamesWhatIsProbablyMeant) {
  VERIFIES("LASSO-GND-061~1");
  EXPECT_EQ(did_you_mean("stanby", {"standby", "bearing", "safe"}), "; did you mean standby?");
  EXPECT_EQ(did_you_mean("xyz", {"standby", "bearing", "safe"}), "");
  EXPECT_EQ(did_you_mean("", {"standby"}), "");
  EXPECT_EQ(did_you_mean("fast", {"lost"}), "");
}

TEST(Nearest, FindsWhatAPersonMeant) {
  VERIFIES("LASSO-GND-003~1");
  std::vector<std::string> keys;
  for (const ValueRow& row : flight_rows()) keys.push_back(row.key);
  EXPECT_EQ(nearest("scan.ponts", keys), "scan.points");
  EXPECT_EQ(nearest("sensor.fov_half_x", keys), "sensor.fov_half_x_deg");  // the unit forgotten
  EXPECT_EQ(nearest("filter.duration_s", keys), "scan.duration_s");        // the wrong section
  EXPECT_EQ(nearest("scan.something_else_altogether", keys), "");
}

}  // namespace
}  // namespace lasso::mdat
