#include "mdat/missiondb/part_reader.hpp"

#include <cmath>

#include "fsw/geometry/portable_math.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

const std::string kPartHead =
    "[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmodel = 'box.toml'\n";  // 6 lines; a part begins on line 7
const std::string kPlace = "range_m = [1, 5]\nview = [0, 0, -2]\n";
const std::string kBox = "box_m = [0, -1, -1, 1, 1, 1]\n";

class PartReaderTest : public ::testing::Test {
 protected:
  PartReaderTest() { folder_.write("box.toml", "[[part]]\nkind = 'box'\nsize = [1, 1, 1]\n"); }
  MissionSource load(const std::string& text) { return load_mission(folder_.write("m.toml", kPartHead + text)); }
  void expect_error(const std::string& text, const std::string& expected) {
    const std::string message = mission_error_of([&] { static_cast<void>(load(text)); });
    EXPECT_NE(message.find(expected), std::string::npos) << "got: " << message << "\nexpected: " << expected;
  }
  Folder folder_;
};

TEST_F(PartReaderTest, ReadsWhatAPartIsAndWhereItServes) {
  VERIFIES("LASSO-GND-001~1 LASSO-MDL-024~1");
  const MissionSource source =
      load("[part.wing]\n" + kBox + kPlace + "[part.bay]\nmodel = 'box.toml'\nscale = 0.5\n" + kPlace +
           "origin_m = [1, 2, 3]\nquaternion = [0, 0, 0.6, 0.8]\ncone_deg = 30\npriority = 2\ncell_size_m = 0.01\n");
  ASSERT_EQ(source.parts.size(), 2U);
  const PartSource& bay = source.parts[0];
  EXPECT_EQ(bay.name, "bay");
  EXPECT_TRUE(bay.parametric);
  EXPECT_EQ(bay.file, folder_.path() / "box.toml");
  EXPECT_EQ(bay.scale, 0.5);
  EXPECT_EQ(bay.origin_m, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(bay.quaternion, (std::vector<double>{0, 0, 0.6, 0.8}));
  EXPECT_NEAR(bay.cone_rad, 30 * kRadPerDeg, 1e-15);
  EXPECT_EQ(bay.priority, 2);
  EXPECT_EQ(bay.cell_size_m, 0.01);
  const PartSource& wing = source.parts[1];
  EXPECT_EQ(wing.box_m, (std::vector<double>{0, -1, -1, 1, 1, 1}));
  EXPECT_EQ(wing.range_m, (std::vector<double>{1, 5}));
  EXPECT_EQ(wing.view, (std::vector<double>{0, 0, -1}));
  EXPECT_EQ(wing.quaternion, (std::vector<double>{0, 0, 0, 1}));
  EXPECT_EQ(wing.priority, 1);
}

TEST_F(PartReaderTest, APartWithoutAModelIsNamedWithItsPlaceAndTheRemedy) {
  VERIFIES("LASSO-MOD-182~2");
  expect_error("[part.bay]\n" + kPlace, "m.toml:7:1: part.bay.box_m");
  expect_error("[part.bay]\n" + kPlace, "exactly one model: box_m (cut from the target), model or mesh; 0 are given");
  expect_error("[part.bay]\n" + kPlace + kBox + "mesh = 'x.stl'\n", "2 are given");
  expect_error("[part.bay]\n" + kPlace + "mesh = 'gone.stl'\n", "m.toml:10:8: part.bay.mesh: \"gone.stl\": no such file in");
  expect_error("[part.bay]\n" + kPlace + "mesh = '" + std::string(300, 'g') + ".stl'\n", "ggg.stl\": no such file in");
  std::filesystem::create_directory(folder_.path() / "dir.toml");
  expect_error("[part.bay]\n" + kPlace + "model = 'dir.toml'\n", "m.toml:10:9: part.bay.model: \"dir.toml\": no such file in");
}

TEST_F(PartReaderTest, RefusesValuesThatContradictEachOther) {
  VERIFIES("LASSO-GND-001~1");
  const std::string part = "[part.bay]\n" + kBox;
  expect_error(part + "range_m = [5, 1]\nview = [1, 0, 0]\n", "part.bay.range_m: [5, 1]: expected the nearest distance first");
  expect_error(part + "range_m = [1, 5]\nview = [0, 0, 0]\n", "part.bay.view: [0, 0, 0]: expected a direction");
  expect_error(part + kPlace + "quaternion = [1, 0, 0, 1]\n", "part.bay.quaternion: [1, 0, 0, 1]: expected x, y, z, w of unit length");
  expect_error("[part.bay]\nbox_m = [0, 0, 2, 1, 1, 1]\n" + kPlace, "expected the low x, y, z, and then higher ones");
  expect_error(part, "part.bay.range_m");
  const std::string number = mission_error_of([&] { static_cast<void>(load_mission(folder_.write("m.toml", "part = 3\n" + kPartHead))); });
  EXPECT_NE(number.find("expected tables [part.NAME]"), std::string::npos) << number;
  expect_error("[part]\nbay = 3\n", "expected a table [part.bay]");
  std::string many;
  for (const char* name : {"a", "b", "c", "d", "e", "f", "g"}) many += "[part." + std::string(name) + "]\n" + kBox + kPlace;
  expect_error(many, "expected at most 6 parts");
}

TEST_F(PartReaderTest, ShortRangeNeedsPartsAndAHysteresis) {
  VERIFIES("LASSO-MOD-171~3");
  expect_error("[short_range]\nenter_m = 5\nleave_m = 6\n", "m.toml:8:11: short_range.enter_m: 5: the mission has no parts to look at");
  expect_error("[short_range]\nenter_m = 5\nleave_m = 5\n[part.bay]\n" + kBox + kPlace,
               "expected more than short_range.enter_m, which is 5 m");
  EXPECT_EQ(load("[short_range]\nenter_m = 5\nleave_m = 6\n[part.bay]\n" + kBox + kPlace).parts.size(), 1U);
}

}  // namespace
}  // namespace lasso::mdat
