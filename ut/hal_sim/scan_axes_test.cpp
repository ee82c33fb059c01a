#include <gtest/gtest.h>

#include "hal_sim/raw_scan.hpp"
#include "hal_sim/scan_file.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

// A point 4 m ahead, 1 m to the right, 2 m up, as each convention writes it.
TEST(ScanAxes, ConventionsAreTurnedToRightDownForward) {
  VERIFIES("LASSO-SIM-037~1");
  const struct {
    const char* axes;
    Vec3 written;
  } cases[] = {{"right-down-forward", {1, -2, 4}},
               {"forward-right-down", {4, 1, -2}},
               {"forward-left-up", {4, -1, 2}},
               {"right-up-backward", {1, 2, -4}},
               {"right-forward-up", {1, 4, 2}},
               {"right-up-forward", {1, 2, 4}},
               {"y,z,x", {4, 1, -2}},
               {"-y,-z,x", {4, -1, 2}},
               {" x , -y , -z ", {1, 2, -4}}};
  for (const auto& c : cases) EXPECT_EQ(axes_of(c.axes) * c.written, Vec3(1, -2, 4)) << c.axes;
}

TEST(ScanAxes, OthersAreRefused) {
  VERIFIES("LASSO-SIM-021~1");
  for (const char* bad :
       {"", "x", "x,y", "x,y,z,x", "x,y,y", "forward-right-up-down", "forward-right-left", "forwards-right-down", "x-y-z"}) {
    try {
      static_cast<void>(axes_of(bad));
      ADD_FAILURE() << bad;
    } catch (const ScanFileError& error) {
      EXPECT_EQ(std::string(error.what()).find("--axes: is \"" + std::string(bad) + "\", expected"), 0u) << error.what();
    }
  }
}

}  // namespace
}  // namespace lasso::sim
