// What compile_model.cpp refuses: options beyond their limits, and models that the flight component has no room for.
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "cfg/capacities.hpp"
#include "mdat/modelc/model.hpp"
#include "ut/mdat/modelc/meshes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

std::string message_of(const Mesh& mesh, const ModelOptions& options) {
  CompileReport report;
  try {
    compile_model(mesh, options, report);
  } catch (const CompileError& error) {
    return error.what();
  }
  return "";
}

TEST(CompileModel, RefusesOptionsOutOfRangeByName) {
  VERIFIES("LASSO-MDL-008~1");
  const Mesh mesh = shapes::box({0, 0, 0}, {1, 1, 1});
  ModelOptions options;
  options.crease_angle_deg = 120;
  EXPECT_NE(message_of(mesh, options).find("crease_angle_deg is 120"), std::string::npos);
  options = {};
  options.cell_size_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message_of(mesh, options).find("cell_size_m"), std::string::npos);
}

TEST(CompileModel, RefusesEachOptionBeyondItsLimits) {
  VERIFIES("LASSO-MDL-008~1");
  struct Limits {
    const char* name;
    double ModelOptions::*option;
    double most;
  };
  const Limits limits[] = {{"cell_size_m", &ModelOptions::cell_size_m, 1000},
                           {"crease_angle_deg", &ModelOptions::crease_angle_deg, 90},
                           {"weld_tolerance_m", &ModelOptions::weld_tolerance_m, 0.1},
                           {"far_margin", &ModelOptions::far_margin, 5},
                           {"near_band_m", &ModelOptions::near_band_m, 1000}};
  for (const Limits& l : limits) {
    for (const double value : {-1e-3, 1.001 * l.most}) {
      ModelOptions options;
      options.*l.option = value;
      const std::string message = message_of({}, options);  // before the mesh, which is none
      EXPECT_EQ(message.find(std::string("model option ") + l.name + " is "), 0U) << message;
      EXPECT_NE(message.find("must lie between 0 and "), std::string::npos) << message;
    }
    ModelOptions options;
    options.*l.option = 0.999 * l.most;
    EXPECT_EQ(message_of({}, options).find("model option"), std::string::npos) << l.name;
  }
}

TEST(CompileModel, RefusesWhatExceedsTheFlightCapacityWithFigureAndLimit) {
  VERIFIES("LASSO-MDL-008~1");
  ModelOptions options;
  options.cell_size_m = 0.2;
  const std::string crowded = message_of(shapes::sphere(0.3, 40, 60), options);
  EXPECT_NE(crowded.find("the limit is " + std::to_string(kMaxElementsPerCell)), std::string::npos) << crowded;
  Mesh dense = shapes::box({0, 0, 0}, {1, 1, 1});
  dense.triangles.resize(2 * std::size_t{kMaxElements} + 1, dense.triangles[0]);
  const std::string many = message_of(dense, options);
  EXPECT_EQ(many.find("the mesh has 524289 triangles; an image has room for 524288 at most"), 0U) << many;
  options.cell_size_m = 0.0018;
  const std::string large = message_of(shapes::sphere(0.5, 30, 40), options);
  EXPECT_NE(large.find("the limit of an image is " + std::to_string(kMaxImageBytes)), std::string::npos) << large;
}

}  // namespace
}  // namespace lasso::mdat
