// Each bad input gets one line with file and place, exit code 2, and leaves nothing behind.
#include <gtest/gtest.h>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

constexpr char kPoses[] = "scan,qx,qy,qz,qw,x_m,y_m,z_m\n";
constexpr char kScan[] = "t_s,x_m,y_m,z_m,valid\n0.0,0.01,0.02,4.0,1\n0.1,0.02,0.02,4.0,1\n";

// `place` must stand in the one line.
void expect_refused(const WorkFolder& work, const std::string& arguments, const std::string& place) {
  const std::vector<std::string> before = work.contents();
  const Answer answer = work.mdat(arguments);
  EXPECT_EQ(answer.exit_code, 2) << arguments << "\n" << answer.err;
  EXPECT_EQ(lines_of(answer.err).size(), 1U) << answer.err;
  EXPECT_NE(answer.err.find(place), std::string::npos) << "expected '" << place << "' in: " << answer.err;
  EXPECT_EQ(answer.out, "");
  EXPECT_EQ(work.contents(), before) << arguments;
}

// A line of a file, counted from 1, that holds `text`.
std::string line_with(const WorkFolder& work, const std::string& file, const std::string& text) {
  const std::vector<std::string> lines = lines_of(work.read(file));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].find(text) != std::string::npos) return std::to_string(i + 1);
  }
  return "no such line";
}

TEST(BadMission, MissingFile) {
  VERIFIES("LASSO-MDT-007~1");
  const WorkFolder work;
  expect_refused(work, "mission check missions/none.toml", "missions/none.toml");
  expect_refused(work, "run missions/none.toml --out result", "missions/none.toml");
  expect_refused(work, "mission compile missions/none.toml -o image.3dli", "missions/none.toml");
}

struct BadKey {
  const char* from;
  const char* to;
};

TEST(BadMission, KeysUnknownOutOfRangeOfTheWrongTypeOrNotANumber) {
  VERIFIES("LASSO-MDT-007~1");
  const BadKey cases[] = {{"points = 1024", "pionts = 1024"},
                          {"points = 1024", "points = 4097"},
                          {"points = 1024", "points = \"many\""},
                          {"points = 1024", "points = 1024.5"},
                          {"duration_s = 0.18", "duration_s = nan"},
                          {"duration_s = 0.18", "duration_s = inf"},
                          {"pattern = \"rosette\"", "pattern = \"spiral\""}};
  for (const BadKey& bad : cases) {
    const WorkFolder work;
    work.write_mission({{bad.from, bad.to}});
    expect_refused(work, "run missions/test.toml --out result",
                   "missions/test.toml:" + line_with(work, "missions/test.toml", bad.to) + ":");
  }
}

TEST(BadMission, TruncatedInTheMiddleOfATable) {
  VERIFIES("LASSO-MDT-007~1");
  const WorkFolder work;
  const std::string text = work.read("missions/test.toml");
  work.write("missions/cut.toml", text.substr(0, text.find("pattern = ") + 12));
  expect_refused(work, "mission check missions/cut.toml", "missions/cut.toml:");
}

TEST(BadMission, ScenarioThatDoesNotExist) {
  VERIFIES("LASSO-MDT-007~1");
  const WorkFolder work;
  expect_refused(work, "run missions/test.toml --scenario nowhere --out result", "nowhere");
}

// What a mission says of a part can be read, but the part has no model there.
TEST(BadMission, APartWithoutAModel) {
  VERIFIES("LASSO-MDT-007~1 LASSO-MOD-182~2");
  const std::string part = "\n[part.bay]\nrange_m = [1.0, 5.0]\nview = [0, 0, -2]\n";
  for (const char* model : {"model = \"gone.toml\"", "mesh = \"models\"", "mesh = \"empty.obj\"", "box_m = [80, 80, 80, 81, 81, 81]"}) {
    const WorkFolder work;
    work.write("missions/empty.obj", "");
    work.write("missions/test.toml", work.read("missions/test.toml") + part + model + "\n");
    const std::string place = "missions/test.toml:" + line_with(work, "missions/test.toml", model) + ":";
    expect_refused(work, "mission check missions/test.toml", place);
    const std::string told = work.mdat("mission check missions/test.toml").err;
    EXPECT_NE(told.find("part.bay."), std::string::npos) << told;
    EXPECT_NE(told.find("delete"), std::string::npos) << "the remedy: " << told;
  }
}

// A mission whose target is a mesh file with this content.
void use_mesh(const WorkFolder& work, const std::string& name, const std::string& content, const std::string& scale = "1.0") {
  if (!content.empty()) work.write("missions/" + name, content);
  work.write_mission({{"model = \"models/hubble_tenth.toml\"", "mesh = \"" + name + "\""},
                      {"scale = 1.0", "scale = " + scale},
                      {"[target.parameters]\narray_angle_deg = 0.0\ndoor_angle_deg = 105.0\n", ""}});
}

constexpr char kTetrahedron[] =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

TEST(BadMesh, MissingTruncatedCorruptOrEmpty) {
  VERIFIES("LASSO-MDT-007~1");
  const std::string binary_stl(80, ' ');
  const WorkFolder work;
  use_mesh(work, "none.stl", "");
  expect_refused(work, "run missions/test.toml --out result", "none.stl");
  use_mesh(work, "cut.stl", binary_stl + std::string("\x10\0\0\0", 4) + std::string(60, '\1'));  // 16 triangles announced, one there
  expect_refused(work, "mission check missions/test.toml", "cut.stl");
  use_mesh(work, "noise.ply", "ply\nthis is not a mesh\n");
  expect_refused(work, "mission compile missions/test.toml -o image.3dli", "noise.ply");
  use_mesh(work, "empty.stl", binary_stl + std::string(4, '\0'));
  expect_refused(work, "mission check missions/test.toml", "empty.stl");
}

TEST(BadMesh, NotFiniteOrAMillionTimesTooLarge) {
  VERIFIES("LASSO-MDT-007~1");
  const WorkFolder work;
  std::string text = kTetrahedron;
  text.replace(text.find("v 1 0 0"), 7, "v nan 0 0");
  use_mesh(work, "nan.obj", text);
  expect_refused(work, "mission check missions/test.toml", "nan.obj");
  use_mesh(work, "large.obj", kTetrahedron, "1000000.0");
  expect_refused(work, "run missions/test.toml --out result", "large.obj");
}

TEST(BadMesh, WhatIsNoSurfaceIsTold) {
  VERIFIES("LASSO-GND-005~2");
  const WorkFolder work;
  use_mesh(work, "edges.obj", std::string(kTetrahedron) + "l 1 2\n");
  const Answer answer = work.mdat("mission check missions/test.toml");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_NE(answer.out.find("edges.obj: not read: 1 line element\n"), std::string::npos) << answer.out;
}

TEST(BadImage, MissingTruncatedOrCorrupt) {
  VERIFIES("LASSO-MDT-007~1");
  const WorkFolder work;
  ASSERT_EQ(work.mdat("mission compile missions/test.toml -o good.3dli").exit_code, 0);
  EXPECT_EQ(work.mdat("mission check good.3dli").exit_code, 0);
  const std::string image = work.read("good.3dli");
  work.write("cut.3dli", image.substr(0, image.size() / 2));
  std::string flipped = image;
  flipped[image.size() / 3] = static_cast<char>(flipped[image.size() / 3] ^ 4);
  work.write("flipped.3dli", flipped);
  work.write("scan.csv", "");
  work.write("scans/a.csv", kScan);
  work.write("poses.csv", std::string(kPoses) + "a,0,0,0,1,0,0,4\n");
  expect_refused(work, "mission check none.3dli", "none.3dli");
  expect_refused(work, "mission check cut.3dli", "cut.3dli");
  expect_refused(work, "mission info flipped.3dli", "flipped.3dli");
  expect_refused(work, "replay flipped.3dli --scans scans --initial poses.csv --out out.csv", "flipped.3dli");
}

// Replay needs an image once; the cases share it.
class BadReplay : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(work.mdat("mission compile missions/test.toml -o image.3dli").exit_code, 0); }
  void expect_bad(const std::string& scan, const std::string& poses, const std::string& place) const {
    work.write("scans/a.csv", scan);
    work.write("poses.csv", poses);
    expect_refused(work, "replay image.3dli --scans scans --initial poses.csv --out out.csv", place);
  }
  WorkFolder work;
};

TEST_F(BadReplay, Scans) {
  VERIFIES("LASSO-MDT-007~1");
  const std::string poses = std::string(kPoses) + "a,0,0,0,1,0,0,4\n";
  expect_bad(std::string(kScan) + "0.2,0.1,0.2\n", poses, "a.csv:4");  // ragged
  expect_bad(std::string(kScan) + "0.2,0.1,four,4,1\n", poses, "a.csv:4");
  expect_bad(std::string(kScan) + "0.05,0.1,0,4,1\n", poses, "a.csv:4");  // time goes back
  expect_bad("x,y,z\n", poses, "a.csv:1");
  expect_bad("", poses, "a.csv");
}

TEST_F(BadReplay, InitialPoses) {
  VERIFIES("LASSO-MDT-007~1");
  expect_bad(kScan, std::string(kPoses) + "a,0,0,0.1,1,0,0,4\n", "poses.csv:2:3: qx,qy,qz,qw: length");
  expect_bad(kScan, std::string(kPoses) + "a,0,0,0,1,nan,0,4\n", "poses.csv:2:11: x_m");
  expect_bad(kScan, std::string(kPoses) + "a,0,0,zero,1,0,0,4\n", "poses.csv:2:7: qz");
  expect_bad(kScan, std::string(kPoses) + "a,0,0,0,1,0,0\n", "poses.csv:2:");
  expect_bad(kScan, std::string(kPoses) + "b,0,0,0,1,0,0,4\n", "poses.csv: no row for the scan 'a'");
  expect_bad(kScan, std::string(kPoses) + "a,0,0,0,1,0,0,4\na,0,0,0,1,0,0,4\n", "poses.csv:3:1");
  expect_bad(kScan, kPoses, "poses.csv:");
  expect_bad(kScan, "a,0,0,0,1,0,0,4\n", "poses.csv:1:1");
  expect_refused(work, "replay image.3dli --scans scans --initial none.csv --out out.csv", "none.csv");
  expect_refused(work, "replay image.3dli --scans nowhere --initial scans/a.csv --out out.csv", "scans/a.csv:1:1");
}

TEST(BadOutput, AFolderThatCannotBeWritten) {
  VERIFIES("LASSO-MDT-007~1");
  const WorkFolder work;
  work.write("file", "not a folder");
  expect_refused(work, "run missions/test.toml --out file/deeper", "file/deeper");
  expect_refused(work, "run missions/test.toml --out /proc/mdat", "/proc/mdat");  // nobody may write there, not even root
  expect_refused(work, "mission compile missions/test.toml -o missing/image.3dli", "missing/image.3dli");
  expect_refused(work, "mission compile missions/test.toml -o missions", "missions");
  expect_refused(work, "mission new --model missions/models/hubble_tenth.toml -o missing/m.toml", "missing/m.toml");
  expect_refused(work, "replay missions/test.toml --scans s --initial p.csv --out missing/out.csv", "missing/out.csv");
}

TEST(BadOutput, WhatIsThereAndIsNotToBeReplaced) {
  VERIFIES("LASSO-MDT-007~1");
  const WorkFolder work;
  expect_refused(work, "mission compile missions/test.toml -o /dev/null", "/dev/null");
  expect_refused(work, "run /dev/full --out result", "/dev/full");
  expect_refused(work, "mission new --model models/probe.toml -o missions/test.toml", "missions/test.toml: is there since");
  work.write("poses.csv", std::string(kPoses) + "a,0,0,0,1,0,0,4\n");
  expect_refused(work, "replay missions/test.toml --scans . --initial poses.csv --out ./poses.csv", "./poses.csv");
}

TEST_F(BadReplay, ItsOutputIsNoneOfItsInputsNorBesideTheScans) {
  VERIFIES("LASSO-MDT-007~1");
  work.write("scans/a.csv", kScan);
  work.write("poses.csv", std::string(kPoses) + "a,0,0,0,1,0,0,4\n");
  for (const char* initial : {"poses.csv", "search"}) {
    const std::string replay = "replay image.3dli --scans scans --initial " + std::string(initial) + " --out ";
    for (const char* out : {"scans/a.csv", "scans/other.csv", "./scans/../scans/new.txt", "image.3dli"}) {
      expect_refused(work, replay + out, std::string(out) + ": ");
      EXPECT_EQ(work.read("scans/a.csv"), kScan) << out;
    }
    expect_refused(work, replay + "scans", "scans: ");
  }
  work.write("out_candidates.csv", std::string(kPoses) + "a,0,0,0,1,0,0,4\n");
  std::filesystem::create_directory_symlink("scans", work / "link");
  expect_refused(work, "replay image.3dli --scans scans --initial search --out link/new.csv",
                 "link/new.csv: lies in the folder of the scans");
}

// What a run reads, with --force too.
TEST(BadOutput, NoFileThatARunReadsIsReplaced) {
  VERIFIES("LASSO-MDT-007~1");
  const WorkFolder work;
  const std::string run = "run missions/test.toml --scenario spin --force --no-report ";
  expect_refused(work, run + "--junit missions/test.toml", "missions/test.toml: is read as well");
  expect_refused(work, run + "--picture missions/../missions/test.toml", "is read as well");
  expect_refused(work, run + "--junit one.xml --picture one.xml", "one.xml: is named twice");
  ASSERT_EQ(work.mdat(run + "--frames 1 --record run.mcap").exit_code, 0);
  const std::string recorded = work.read("run.mcap");
  ASSERT_FALSE(recorded.empty());
  expect_refused(work, run + "--frames 1 --sensor replay:run.mcap --record run.mcap", "run.mcap: is read as well");
  expect_refused(work, "replay missions/test.toml --scans run.mcap --initial search --out run.mcap --force",
                 "run.mcap: is read by this replay");
  EXPECT_EQ(work.read("run.mcap"), recorded);
}

TEST(BadOutput, NothingStaysOfAFolderMadeForARunThatIsRefused) {
  VERIFIES("LASSO-MDT-007~1");
  const WorkFolder work;
  work.write_mission({{"points = 1024", "points = 1"}});
  expect_refused(work, "run missions/test.toml --out one/two/three", "missions/test.toml:");
}

TEST(BadUsage, AFileOfAnotherKindIsTold) {
  VERIFIES("LASSO-MDT-007~1");
  const WorkFolder work;
  ASSERT_EQ(work.mdat("mission compile missions/test.toml --out test.3dli").exit_code, 0);
  expect_refused(work, "run test.3dli", "flight image: give the mission file");
  work.write("cube.stl", "solid cube\nendsolid cube\n");
  expect_refused(work, "mission check cube.stl", "mission new --model cube.stl");
}

TEST(BadUsage, UnknownCommandsOptionsAndValues) {
  VERIFIES("LASSO-MDT-007~1");
  const WorkFolder work;
  expect_refused(work, "", "--help");
  expect_refused(work, "fly", "fly");
  expect_refused(work, "run", "MISSION");
  expect_refused(work, "run missions/test.toml --frames 0", "--frames");
  expect_refused(work, "run missions/test.toml --frames many", "--frames");
  expect_refused(work, "run missions/test.toml --seed -1", "--seed");
  expect_refused(work, "run missions/test.toml --colour", "--colour");
  expect_refused(work, "mission", "--help");
  expect_refused(work, "mission new --model x.stl --scale nan -o m.toml", "scale");
  expect_refused(work, "mission new --model none.stl --scale 0 -o m.toml", "1e-06 to 1000000");
  expect_refused(work, "render none.toml --time nan", "'nan' is no number from 0 to 1000000");
  expect_refused(work, "render m.toml --force -o m.toml", "m.toml: is read as well");
  expect_refused(work, "benchmark score none a.csv --csv z.csv --json z.csv", "z.csv: is named twice");
  expect_refused(work, "benchmark make none --seed 4294967295 --bodies 2", "above 4294967295");
  expect_refused(work, "mission new --model none.stl --scale 1 -o m.toml", "none.stl");
  expect_refused(work, "mission new --model x.stl --scale 1 --sensor stereo -o m.toml", "stereo");
}

TEST(Help, OnEachCommand) {
  VERIFIES("LASSO-MDT-008~1");
  const WorkFolder work;
  for (const char* command : {"", "mission ", "mission check ", "mission compile ", "mission info ", "mission new ", "run ", "replay "}) {
    const Answer answer = work.mdat(std::string(command) + "--help");
    EXPECT_EQ(answer.exit_code, 0) << command;
    EXPECT_NE(answer.out.find("Usage"), std::string::npos) << command;
    EXPECT_EQ(answer.err, "");
  }
  EXPECT_EQ(work.mdat("--version").out.find("mdat "), 0U);
}

}  // namespace
}  // namespace lasso::ft
