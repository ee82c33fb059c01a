#include "mdat/missiondb/value_row.hpp"

#include <cmath>

#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TEST(ValueRow, FollowsTheFlightRows) {
  VERIFIES("LASSO-GND-001~1");
  ASSERT_EQ(flight_rows().size(), parameter_rows().size());
  const ValueRow& pattern = *find_row(flight_rows(), "scan.pattern");
  EXPECT_EQ(pattern.kind, ValueKind::kChoice);
  EXPECT_EQ(pattern.choices, (std::vector<std::string>{"rosette", "lissajous", "raster"}));
  EXPECT_EQ(find_row(flight_rows(), "scan.no_such"), nullptr);
}

TEST(ValueRow, NumbersReadBackToTheSameDouble) {
  VERIFIES("LASSO-GND-002~1");
  for (const double value : {1.0 / 9000, 0.3819660112501051, -1e-7, 4294967295.0, 1e6, 1e300, 0.1}) {
    EXPECT_EQ(std::stod(number_text(value)), value);
  }
  EXPECT_EQ(number_text(1e6), "1000000");  // whole numbers stay whole in TOML
}

TEST(ValueRow, WritesToml) {
  VERIFIES("LASSO-GND-002~1");
  EXPECT_EQ(toml_text(*find_row(flight_rows(), "scan.pattern"), {1}), "\"lissajous\"");
  EXPECT_EQ(toml_text(*find_row(flight_rows(), "estimation.deskew"), {1}), "true");
  EXPECT_EQ(toml_text(*find_row(flight_rows(), "scan.points"), {1024}), "1024");
}

}  // namespace
}  // namespace lasso::mdat
