// Depth images, registered by the command line.
#include <algorithm>
#include <cstdio>

#include "ft/mdat/replay_fixture.hpp"
#include "ut/support/grey_png.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

std::string number_text(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.12g", value);
  return text;
}

// A depth image of two boxes, one on the other, by the equations of their faces.
struct Slabs {
  double low[3], high[3];
};
constexpr Slabs kBoxes[] = {{{-0.5, -0.3, -0.2}, {0.5, 0.3, 0.2}}, {{0.1, -0.2, 0.2}, {0.4, 0.1, 0.5}}};

double nearest(const Slabs& box, const double (&from)[3], const double (&along)[3]) {
  double enter = 0, leave = 1e9;
  for (int i = 0; i < 3; ++i) {
    const double a = (box.low[i] - from[i]) / along[i], b = (box.high[i] - from[i]) / along[i];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave ? enter : 1e9;
}

std::string boxes_obj() {
  std::string text;
  for (int box = 0; box < 2; ++box) {
    for (int corner = 0; corner < 8; ++corner) {
      text += "v";
      for (int i = 0; i < 3; ++i) text += " " + number_text((corner >> i) % 2 == 0 ? kBoxes[box].low[i] : kBoxes[box].high[i]);
      text += "\n";
    }
    for (const char* face : {"1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"}) {
      text += "f";
      for (const char* c = face; *c != 0; c += 2) {
        text += " " + std::to_string(*c - '0' + 8 * box);
        if (c[1] == 0) break;
      }
      text += "\n";
    }
  }
  return text;
}

// R of the quaternion (0.3, -0.5, 0.1, 0.8062...), target to sensor.
struct Turn {
  double q[4] = {0.3, -0.5, 0.1, std::sqrt(0.65)}, R[3][3];
  Turn() {
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    const double rows[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                               {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                               {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
    std::copy(&rows[0][0], &rows[0][0] + 9, &R[0][0]);
  }
};

TEST(DepthImages, OfABodyOfBoxesGiveItsPose) {
  VERIFIES("LASSO-SIM-041~1 LASSO-MDT-077~1");
  const WorkFolder work;
  const Turn turn;
  const double place[3] = {0.1, -0.05, 4}, focal = 240, middle[2] = {79.5, 59.5}, unit_m = 0.0005;
  std::vector<std::uint16_t> pixels;
  for (int v = 0; v < 120; ++v) {
    for (int u = 0; u < 160; ++u) {
      const double ray[3] = {(u - middle[0]) / focal, (v - middle[1]) / focal, 1};
      double from[3], along[3];
      for (int i = 0; i < 3; ++i) {
        from[i] = -(turn.R[0][i] * place[0] + turn.R[1][i] * place[1] + turn.R[2][i] * place[2]);
        along[i] = turn.R[0][i] * ray[0] + turn.R[1][i] * ray[1] + turn.R[2][i] * ray[2];
      }
      const double depth = std::min(nearest(kBoxes[0], from, along), nearest(kBoxes[1], from, along));
      pixels.push_back(depth < 1e8 ? static_cast<std::uint16_t>(std::lround(depth / unit_m)) : std::uint16_t{0});
    }
  }
  work.write("images/d1.png", test::grey_png(160, pixels));
  work.write("camera.toml", "fx = 240\nfy = 240.0\ncx = 79.5\ncy = 59.5\nscale_m = 0.0005\n");
  work.write("boxes.obj", boxes_obj());
  ASSERT_EQ(work.mdat("mission new --model boxes.obj --scale 1 --out boxes.toml").exit_code, 0);
  std::string pose = "scan,qx,qy,qz,qw,x_m,y_m,z_m\nd1";
  for (const double q : turn.q) pose += "," + number_text(q);
  work.write("truth.csv", pose + ",0.1,-0.05,4\n");
  work.write("start.csv", pose + ",0.11,-0.06,4.01\n");
  const Answer answer =
      work.mdat("replay boxes.toml --scans images --depth-camera camera.toml --initial start.csv --truth truth.csv -o out.csv");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_NE(answer.err.find("the scan thinned to 4096 rays"), std::string::npos) << answer.err;
  EXPECT_EQ(answer.err.find("in the camera's file"), std::string::npos) << answer.err;
  work.write("wrong.toml", work.read("camera.toml") + "values = 'range'\n");
  const Answer wrong = work.mdat("replay boxes.toml --scans images --depth-camera wrong.toml --initial start.csv -o wrong.csv");
  EXPECT_NE(wrong.err.find("with values = \"depth\" in the camera's file"), std::string::npos) << wrong.err;
  const Row row = table(work.read("out.csv")).at(0);
  EXPECT_EQ(row.at("valid"), "1") << row.at("reason") << answer.err;
  EXPECT_LT(value(row, "error_m"), 1e-3);
  EXPECT_LT(value(row, "error_deg"), 0.1);
}

TEST(DepthImages, ABadCalibrationIsToldWithEachProblem) {
  VERIFIES("LASSO-MDT-007~1");
  const WorkFolder work;
  work.write("images/d1.png", test::grey_png(1, {1000}));
  work.write("camera.toml", "fx = 0\nfy = 240.0\ncx = 79.5\nscale = 0.0005\n");
  work.write("start.csv", "scan,qx,qy,qz,qw,x_m,y_m,z_m\nd1,0,0,0,1,0,0,4\n");
  const Answer answer = work.mdat("replay missions/test.toml --scans images --depth-camera camera.toml --initial start.csv -o out.csv");
  EXPECT_EQ(answer.exit_code, 2);
  for (const char* part : {"camera.toml:1", "fx", "cy", "scale_m"}) EXPECT_NE(answer.err.find(part), std::string::npos) << answer.err;
  EXPECT_NE(answer.err.find("(length of one step of a pixel's value)"), std::string::npos) << answer.err;
}

}  // namespace
}  // namespace lasso::ft
