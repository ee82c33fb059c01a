#include "mdat/bodies/body.hpp"

#include <gtest/gtest.h>

#include "mdat/missiondb/model_file.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// A bar with a knob at one end, and a flap that turns.
Body bar() {
  Body body;
  body.seed = 9;
  body.what = "bar";
  body.parameters = {{"flap_angle_deg", "turn of the flap", 30, -90, 90}};
  body.parts = {{"bar", "bar", "kind = \"box\"\nsize = [4, 1, 1]\n"},
                {"knob", "knob", "kind = \"box\"\nsize = [0.5, 0.5, 0.5]\nplace = [{move = [1.5, 0, 0.7]}]\n"},
                {"flap", "flap",
                 "kind = \"box\"\nsize = [1, 2, 0.1]\nplace = [{turn = [0, 1, 0], angle_deg = \"flap_angle_deg\"}, {move = [0, 1, 0]}]\n"}};
  return body;
}

TEST(Body, TruthHasTheBoxOfEachAssembly) {
  VERIFIES("LASSO-GND-111~1");
  const BodyTruth truth = truth_of(bar());
  ASSERT_EQ(truth.assemblies.size(), 3u);
  EXPECT_EQ(truth.assemblies[1].assembly, "knob");
  EXPECT_LT((truth.assemblies[1].box_m.min() - Eigen::Vector3d(1.25, -0.25, 0.45)).norm(), 1e-12);
  EXPECT_LT((truth.assemblies[1].box_m.max() - Eigen::Vector3d(1.75, 0.25, 0.95)).norm(), 1e-12);
  EXPECT_DOUBLE_EQ(truth.size_m, 4);
  EXPECT_LT((truth.high_m - Eigen::Vector3d(2, 2, 0.95)).norm(), 1e-12);
}

TEST(Body, AssemblyCanBeTakenAway) {
  VERIFIES("LASSO-GND-111~1");
  const BodyTruth truth = truth_of(without(bar(), "knob"));
  EXPECT_EQ(truth.assemblies.size(), 2u);
  EXPECT_DOUBLE_EQ(truth.high_m.z(), 0.5);
}

TEST(Body, PresetOfAParameterIsTheModels) {
  VERIFIES("LASSO-GND-111~1");
  Body flat = bar();
  flat.parameters[0].preset_deg = 0;
  EXPECT_NEAR(truth_of(flat).assemblies[2].box_m.max().z(), 0.05, 1e-12);
  EXPECT_NEAR(truth_of(bar()).assemblies[2].box_m.max().z(), 0.5 * 0.5 + 0.05 * std::sqrt(0.75), 1e-12);
  EXPECT_EQ(build_model_text(model_text(flat), {{"flap_angle_deg", 30}}).vertices, mesh_of(bar()).vertices);
}

TEST(Body, CommentsTellAPersonTheTruth) {
  VERIFIES("LASSO-GND-111~1");
  const Body body = bar();
  const std::string text = commented_model_text(body, truth_of(body));
  EXPECT_NE(text.find("# body 9: plain: bar, 4 m\n# exact symmetry: none\n"), std::string::npos) << text;
  EXPECT_NE(text.find("#   knob: (1.25, -0.25, 0.45) (1.75, 0.25, 0.95)\n"), std::string::npos) << text;
  EXPECT_EQ(build_model_text(text, {}).vertices, mesh_of(body).vertices);
}

}  // namespace
}  // namespace lasso::mdat
