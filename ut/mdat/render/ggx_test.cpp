#include "mdat/render/ggx.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/render/material.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

Vec3 direction(double polar_rad, double azimuth_rad) {
  return {std::sin(polar_rad) * std::cos(azimuth_rad), std::sin(polar_rad) * std::sin(azimuth_rad), std::cos(polar_rad)};
}

// What of evenly bright surroundings leaves towards the view: the integral over the hemisphere by the midpoint rule.
Rgb furnace(const Reflection& surface, const Vec3& view) {
  constexpr int kPolar = 240, kAzimuth = 240;
  Rgb sum = Rgb::Zero();
  for (int i = 0; i < kPolar; ++i) {
    const double polar = (i + 0.5) * kPi / 2 / kPolar;
    for (int j = 0; j < kAzimuth; ++j) {
      sum += reflected(surface, view, direction(polar, (j + 0.5) * 2 * kPi / kAzimuth)) * (std::sin(polar) * std::cos(polar));
    }
  }
  return sum * (kPi / 2 / kPolar) * (2 * kPi / kAzimuth);
}

// The same of the facets alone, by their sampling.
Rgb mirrored_furnace(const Reflection& surface, const Vec3& view) {
  constexpr int kCells = 60;
  Rgb sum = Rgb::Zero();
  for (int i = 0; i < kCells * kCells; ++i)
    sum += mirrored(surface, view, {(i % kCells + 0.5) / kCells, (i / kCells + 0.5) / kCells}).share;
  return sum / (kCells * kCells);
}

Reflection mirror(double roughness) { return {Rgb::Zero(), Rgb::Ones(), roughness}; }

TEST(Ggx, WithoutFacetsIsLambert) {
  VERIFIES("LASSO-PIC-006~1");
  const Reflection surface{Rgb(0.1, 0.5, 0.9), Rgb::Zero(), 0.3};
  const Rgb value = reflected(surface, direction(0.4, 1), direction(1.3, 2));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], surface.diffuse[c] / kPi, 1e-15);
}

TEST(Ggx, NothingBelowTheSurface) {
  VERIFIES("LASSO-PIC-006~1");
  EXPECT_EQ(reflected(mirror(0.3), direction(0.4, 0), direction(1.6, 1)).maxCoeff(), 0);
  EXPECT_EQ(reflected(mirror(0.3), direction(1.6, 0), direction(0.4, 1)).maxCoeff(), 0);
}

TEST(Ggx, ViewAndLightMayBeExchanged) {
  VERIFIES("LASSO-PIC-006~1");
  const Reflection surface{Rgb(0.3, 0.2, 0.1), Rgb(0.4, 0.5, 0.04), 0.25};
  for (int i = 0; i < 50; ++i) {
    const Vec3 a = direction(0.03 * i, 0.7 * i), b = direction(1.5 - 0.02 * i, 1.1 * i);
    const Rgb there = reflected(surface, a, b), back = reflected(surface, b, a);
    EXPECT_LT((there - back).abs().maxCoeff(), 1e-12 * (1 + there.maxCoeff()));
  }
}

// White furnace: facets that reflect all lose what they throw onto each other, and never give more. Of light from above it is an integral
// over the facet's angle alone: tan^2 of it is alpha^2 u / (1 - u), u uniform; the ray leaves at twice the angle, past Smith's masking.
double reflected_from_above(double alpha) {
  constexpr int kSteps = 100000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double u = (i + 0.5) / kSteps, angle = 2 * std::atan(alpha * std::sqrt(u / (1 - u)));
    if (angle < kPi / 2) sum += 2 / (1 + std::sqrt(1 + alpha * alpha * std::tan(angle) * std::tan(angle)));
  }
  return sum / kSteps;
}

TEST(Ggx, PerfectFacetsReflectAllButWhatTheyThrowOntoEachOther) {
  VERIFIES("LASSO-PIC-006~1");
  for (const double roughness : {0.2, 0.35, 0.5}) {
    EXPECT_NEAR(furnace(mirror(roughness), direction(0, 0))[0], reflected_from_above(roughness), 0.002) << roughness;
    for (const double polar : {0.6, 1.1, 1.4}) {
      const double share = furnace(mirror(roughness), direction(polar, 0.3))[0];
      EXPECT_LE(share, 1.002) << roughness << " " << polar;
      EXPECT_GE(share, 0.9 * reflected_from_above(roughness)) << roughness << " " << polar;
    }
  }
}

TEST(Ggx, SampledFacetsGiveTheSameIntegral) {
  VERIFIES("LASSO-PIC-006~1");
  const Reflection surface{Rgb::Zero(), Rgb(0.9, 0.5, 0.04), 0.35};
  for (const double polar : {0.0, 0.7, 1.2}) {
    const Vec3 view = direction(polar, 2.1);
    const Rgb sampled = mirrored_furnace(surface, view), integral = furnace(surface, view);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sampled[c], integral[c], 0.005) << polar << " " << c;
  }
}

TEST(Ggx, NoMaterialReflectsMoreThanArrives) {
  VERIFIES("LASSO-PIC-006~1");
  for (const Material& material : material_presets()) {
    Reflection surface = material.reflection;
    surface.roughness = std::max(0.2, surface.roughness);  // as fine as the rule resolves
    for (const double polar : {0.1, 0.9, 1.3})
      EXPECT_LE(furnace(surface, direction(polar, 1)).maxCoeff(), 1.002) << material.name << " " << polar;
  }
}

TEST(Ggx, DiffusePartIsWhatItSaysOfPerpendicularLight) {
  VERIFIES("LASSO-PIC-006~1");
  const Reflection with{Rgb::Constant(0.3), Rgb::Constant(0.5), 0.4}, facets{Rgb::Zero(), Rgb::Constant(0.5), 0.4};
  const Vec3 view = direction(0, 0);
  EXPECT_NEAR(furnace(with, view)[0] - furnace(facets, view)[0], 0.3, 1e-4);
  EXPECT_NEAR(kPi * diffusely_reflected(with, view)[0], 0.3, 1e-12);
}

TEST(Ggx, SmoothFacetsAreAMirror) {
  VERIFIES("LASSO-PIC-006~1");
  const Vec3 view = direction(0.8, 0.5);
  for (const double u : {0.1, 0.5, 0.9}) {
    EXPECT_LT((mirrored(mirror(1e-4), view, {u, 0.3}).light - Vec3(-view.x(), -view.y(), view.z())).norm(), 2e-3);
  }
}

}  // namespace
}  // namespace lasso::mdat
