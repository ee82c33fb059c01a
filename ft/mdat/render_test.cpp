// Pictures of what a sensor sees.
#include <gtest/gtest.h>

#include <algorithm>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

constexpr char kSmall[] = " --size 96x64 --samples 2 ";

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
  return value;
}

// A PNG's header (ISO/IEC 15948): width, height, bit depth, colour type.
void expect_png(const std::string& bytes, std::uint32_t width, int bit_depth, int colour_type) {
  ASSERT_GT(bytes.size(), 33U);
  EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1A\n");
  EXPECT_EQ(number_at(bytes, 16), width);
  EXPECT_EQ(bytes[24], bit_depth);
  EXPECT_EQ(bytes[25], colour_type);
}

TEST(Render, WritesEachKindOfPicture) {
  VERIFIES("LASSO-PIC-001~1 LASSO-PIC-008~1 LASSO-PIC-013~1");
  const WorkFolder work;
  work.write_mission();
  for (const char* as : {"photo", "depth", "depth16", "normals", "parts"}) {
    const std::string name = as;
    const Answer answer = work.mdat("render missions/test.toml --as " + name + kSmall);
    ASSERT_EQ(answer.exit_code, 0) << answer.err;
    EXPECT_EQ(answer.err, "") << name;
    EXPECT_NE(answer.out.find("written: out/render/test_" + name + ".png"), std::string::npos) << answer.out;
    const std::string bytes = work.read("out/render/test_" + name + ".png");
    expect_png(bytes, 96, name == "depth16" ? 16 : 8, name == "depth16" ? 0 : 2);
    const std::uint32_t height = number_at(bytes, 20);
    EXPECT_EQ(height == 64, name == "photo" || name == "depth16") << name << ": a legend is added where there is one";
  }
  const Answer again = work.mdat(std::string("render missions/test.toml") + kSmall);
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_NE(again.err.find("--force replaces it"), std::string::npos) << again.err;
}

TEST(Render, TheSameBytesWithAnyNumberOfThreads) {
  VERIFIES("LASSO-PIC-002~1");
  const WorkFolder work;
  work.write_mission();
  for (const char* jobs : {"1", "2", "5"}) {
    const Answer answer =
        work.mdat(std::string("render missions/test.toml --scenario tumble --time 3.2 --lamp -o p") + jobs + ".png -j " + jobs + kSmall);
    ASSERT_EQ(answer.exit_code, 0) << answer.err;
  }
  EXPECT_EQ(work.read("p1.png"), work.read("p2.png"));
  EXPECT_EQ(work.read("p1.png"), work.read("p5.png"));
  ASSERT_EQ(work.mdat(std::string("render missions/test.toml --scenario tumble --time 3.4 --lamp -o later.png") + kSmall).exit_code, 0);
  EXPECT_NE(work.read("p1.png"), work.read("later.png"));
}

TEST(Render, LightIsAsItIsTold) {
  VERIFIES("LASSO-PIC-010~1 LASSO-PIC-005~1 LASSO-PIC-015~1");
  const WorkFolder work;
  work.write_mission();
  const Answer told = work.mdat(std::string("render missions/test.toml --exposure 250 -o a.png") + kSmall);
  EXPECT_NE(told.out.find("exposure: 250 W/m2/sr is white\n"), std::string::npos) << told.out;
  const Answer night = work.mdat(std::string("render missions/test.toml --orbit 400,0,180 --lamp -o n.png") + kSmall);
  EXPECT_NE(night.out.find("orbit: 0.0 % of the sun's disc is seen"), std::string::npos) << night.out << night.err;
  const Answer lamp = work.mdat(std::string("render missions/test.toml --sun none --lamp -o b.png") + kSmall);
  EXPECT_EQ(lamp.exit_code, 0);
  EXPECT_EQ(lamp.err, "");
  const Answer dark = work.mdat(std::string("render missions/test.toml --sun none -o c.png") + kSmall);
  EXPECT_EQ(dark.exit_code, 0);
  EXPECT_NE(dark.err.find("warning: nothing lit is in view"), std::string::npos) << dark.err;
  const Answer away = work.mdat(std::string("render missions/test.toml --as depth --set scenario.paper.offset_m=[9,9] -o d.png") + kSmall);
  EXPECT_EQ(away.exit_code, 0);
  EXPECT_NE(away.err.find("warning: the target is not in the field of view"), std::string::npos) << away.err;
}

// The scan of a frame is the one that a recording of the same run has, to the last return; without noise its ranges are the model's.
TEST(Render, DrawsTheScanThatARunTakes) {
  VERIFIES("LASSO-PIC-009~1");
  const WorkFolder work;
  work.write_mission();
  work.record_scans("run missions/test.toml --scenario spin --frames 3", "rec/4m");
  const std::vector<std::string> rows = lines_of(work.read("rec/4m/scans/f00002.csv"));
  const auto returns = std::count_if(rows.begin() + 1, rows.end(), [](const std::string& row) { return fields_of(row).at(4) == "1"; });
  const Answer noisy = work.mdat(std::string("render missions/test.toml --scenario spin --time 0.5 --scan -o a.png") + kSmall);
  ASSERT_EQ(noisy.exit_code, 0) << noisy.err;
  EXPECT_NE(noisy.out.find("scan: " + std::to_string(rows.size() - 1) + " rays, " + std::to_string(returns) + " returns"),
            std::string::npos)
      << noisy.out;
  EXPECT_EQ(noisy.out.find(" 0.000"), std::string::npos) << noisy.out;
  const Answer exact = work.mdat(
      std::string("render missions/test.toml --scenario spin --time 0.5 --as residual --set scenario.spin.noise=false -o b.png") + kSmall);
  ASSERT_EQ(exact.exit_code, 0) << exact.err;
  EXPECT_NE(exact.out.find("measured minus predicted range 0.0001 mm rms"), std::string::npos)
      << exact.out << "single precision of a range";
  expect_png(work.read("b.png"), 96, 8, 2);
}

TEST(Render, RefusesWhatItCannotDraw) {
  VERIFIES("LASSO-PIC-011~1");
  const WorkFolder work;
  work.write_mission();
  const std::vector<std::string> before = work.contents();
  for (const auto& [arguments, place] : std::vector<std::pair<std::string, std::string>>{
           {"--size 1024", "--size 1024: expected WIDTHxHEIGHT"},
           {"--size 0x10", "--size 0x10"},
           {"--size 5000x10", "1 to 4096"},
           {"--size 10x10cm", "--size 10x10cm"},
           {"--sun 0,0,0", "--sun 0,0,0: expected X,Y,Z"},
           {"--sun 1,2", "--sun 1,2"},
           {"--earth up", "--earth up"},
           {"--orbit 400,25", "--orbit 400,25: expected ALTITUDE,BETA,ANGLE"},
           {"--orbit 400,95,0", "--orbit 400,95,0"},
           {"--orbit 400,25,0 --sun 1,0,0", "--orbit"},
           {"--as phot", "--as"},
           {"--time -1", "--time"},
           {"--samples 0", "--samples"},
           {"--exposure 0", "--exposure"},
           {"--range 9", "--range 9: scenario paper has the ranges 2, 3, 4, 5, 6, 7 m"},
           {"--scenario papr", "papr"},
           {"--camera left", "--camera left: the mission's sensors and cameras are laser_camera"},
           {"--material body=gold", "--material body=gold: no such material"},
           {"--material wing=mli", "--material wing=mli: the target has no such part"},
           {"--as depth16 --scan", "--as depth16"},
           {"--scan --time 72", "--time 72: the scenario paper has scans for 72 s: choose an earlier time, or leave the scan out"},
           {"--scenario spin --time 3 --scan --set scenario.spin.eclipse_s=[0.5,20]", "--scan: in frame 15 nothing was tracked"},
           {"--set scenario.paper.nonsense=1", "nonsense"},
           {"-o no/such/folder/a.png", "no/such/folder/a.png"},
           {"-o missions", "missions"}}) {
    const Answer answer = work.mdat("render missions/test.toml " + arguments);
    EXPECT_EQ(answer.exit_code, 2) << arguments << answer.err;
    EXPECT_EQ(lines_of(answer.err).size(), 1U) << answer.err;
    EXPECT_NE(answer.err.find(place), std::string::npos) << "expected '" << place << "' in: " << answer.err;
    EXPECT_EQ(work.contents(), before) << arguments;
  }
}

}  // namespace
}  // namespace lasso::ft
