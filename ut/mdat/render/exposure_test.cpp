#include "mdat/render/exposure.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// IEC 61966-2-1 with the library's power.
double reference_code(double linear) { return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055); }

TEST(Exposure, CodesAreThoseOfSrgb) {
  VERIFIES("LASSO-PIC-010~1");
  for (int i = 0; i <= 100000; ++i) {
    const double linear = i / 100000.0, reference = reference_code(linear);
    EXPECT_LE(std::fabs(srgb_code(linear) - reference), 0.5 + 2e-3) << linear;  // where its two pieces meet they differ by this
  }
  EXPECT_EQ(srgb_code(-1), 0);
  EXPECT_EQ(srgb_code(7), 255);
}

struct Scene {
  std::vector<Rgb> radiance;
  std::vector<SeenPoint> seen;
};

// 1001 pixels of the target from 1 to 1001 W/m2/sr, as many in the dark, and a sky that shines, which does not count.
Scene ramp() {
  Scene scene;
  for (int i = 0; i <= 1000; ++i) {
    SeenPoint hit;
    hit.hit = true;
    scene.radiance.insert(scene.radiance.end(), {Rgb::Constant(1 + i), Rgb::Zero(), Rgb::Constant(1e6)});
    scene.seen.insert(scene.seen.end(), {hit, hit, SeenPoint{}});
  }
  return scene;
}

TEST(Exposure, IsChosenByThePercentileOfTheLitTarget) {
  VERIFIES("LASSO-PIC-010~1");
  const Scene scene = ramp();
  EXPECT_NEAR(automatic_white(scene.radiance, scene.seen), 851 / 0.5, 1e-9);
}

TEST(Exposure, FollowsTheLight) {
  VERIFIES("LASSO-PIC-010~1");
  Scene scene = ramp();
  const double white = automatic_white(scene.radiance, scene.seen);
  for (Rgb& value : scene.radiance) value *= 1e-3;
  EXPECT_NEAR(automatic_white(scene.radiance, scene.seen), 1e-3 * white, 1e-9);
  for (Rgb& value : scene.radiance) value *= 0;
  EXPECT_EQ(automatic_white(scene.radiance, scene.seen), 0);
  EXPECT_EQ(automatic_white({}, {}), 0);
}

TEST(Exposure, ClipsEachChannel) {
  VERIFIES("LASSO-PIC-010~1");
  Camera camera;
  camera.width = 2;
  camera.height = 1;
  const std::vector<Rgb> radiance{Rgb(50, 500, 0), Rgb(21.404, 100, 100)};
  const Picture picture = photo(radiance, camera, 100);
  EXPECT_EQ(picture.pixels[0], (Pixel{188, 255, 0}));
  EXPECT_EQ(picture.pixels[1], (Pixel{127, 255, 255}));
  EXPECT_EQ(photo(radiance, camera, 0).pixels[0], (Pixel{0, 0, 0}));  // nothing is lit
}

}  // namespace
}  // namespace lasso::mdat
