// body_sheet FILE FIRST COLUMNS ROWS [KIND]: draws COLUMNS x ROWS bodies, from seed FIRST on, as raw bytes (grey, row by row from the top),
// of which ft/bodies/picture makes a PNG. Prints the width and height.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "hal_sim/ray_caster.hpp"
#include "mdat/bodies/body.hpp"
#include "mdat/run/true_target.hpp"

namespace {

using namespace lasso;

constexpr int kTile = 220, kFine = 2;  // pixels; rays a pixel, each way
constexpr double kShown = 0.66;        // half of the tile's side, in sizes of the body

// Right, up and away from the body, as the viewer sees it.
Mat3 camera() {
  const Vec3 away = Vec3(0.75, 0.5, 0.6).normalized();
  const Vec3 right = Vec3::UnitZ().cross(away).normalized();
  Mat3 axes;
  axes << right, away.cross(right), away;
  return axes;
}

struct View {
  const sim::RayCaster& target;
  Vec3 center_m;
  double size_m;
  Mat3 axes = camera();

  // From 0 to 1 at a place of the tile, each from -1 to 1; white where nothing is.
  double brightness(double x, double y) const {
    const Vec3 away = axes.col(2);
    const Vec3 origin_m = center_m + size_m * (kShown * (x * axes.col(0) + y * axes.col(1)) + 3 * away);
    const sim::RayHit hit = target.cast(origin_m, -away);
    if (!hit.hit) return 1;
    const Vec3 light = (away + 0.7 * axes.col(1) - 0.5 * axes.col(0)).normalized();
    return 0.12 + 0.75 * std::max(0.0, std::copysign(1.0, hit.normal.dot(away)) * hit.normal.dot(light));
  }

  double pixel(int column, int row) const {
    double sum = 0;
    for (int i = 0; i < kFine; ++i) {
      for (int k = 0; k < kFine; ++k) {
        const double x = column + (i + 0.5) / kFine, y = row + (k + 0.5) / kFine;
        sum += brightness(2 * x / kTile - 1, 1 - 2 * y / kTile);
      }
    }
    return sum / (kFine * kFine);
  }
};

void draw(const mdat::Body& body, int left, int top, int width, std::vector<unsigned char>& picture) {
  const mdat::BodyTruth truth = mdat::truth_of(body);
  for (const std::string& line : mdat::body_lines(body, truth)) std::fprintf(stderr, "%s\n", line.c_str());
  const auto target = mdat::make_target(mdat::mesh_of(body));
  const View view{*target, 0.5 * (truth.low_m + truth.high_m), truth.size_m};
  for (int row = 0; row < kTile; ++row) {
    for (int column = 0; column < kTile; ++column)
      picture[static_cast<std::size_t>(top + row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(left + column)] =
          static_cast<unsigned char>(std::lround(255 * view.pixel(column, row)));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) return std::fprintf(stderr, "usage: body_sheet FILE FIRST COLUMNS ROWS [KIND]\n"), 2;
  const int columns = std::stoi(argv[3]), rows = std::stoi(argv[4]), width = columns * kTile;
  const std::optional<mdat::BodyKind> kind = argc > 5 ? mdat::body_kind_of(argv[5]) : std::nullopt;
  std::vector<unsigned char> picture(static_cast<std::size_t>(width) * static_cast<std::size_t>(rows * kTile));
  for (int i = 0; i < columns * rows; ++i)
    draw(mdat::make_body(std::stoul(argv[2]) + static_cast<unsigned long>(i), kind), i % columns * kTile, i / columns * kTile, width,
         picture);
  std::ofstream(argv[1], std::ios::binary)
      .write(reinterpret_cast<const char*>(picture.data()), static_cast<std::streamsize>(picture.size()));
  std::printf("%d %d\n", width, rows * kTile);
  return 0;
}
