#include "mdat/render/shading.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fsw/geometry/portable_math.hpp"
#include "ut/mdat/render/shapes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// Mean radiance of a place that a ray from `from_m` along `direction` meets.
Rgb mean_radiance(const Shader& shader, const Vec3& from_m, const Vec3& direction, int per_axis = 8) {
  PictureRay ray{from_m, direction, 1e-3, PixelSamples(77, per_axis), 0};
  Rgb sum = Rgb::Zero();
  for (ray.index = 0; ray.index < per_axis * per_axis; ++ray.index) {
    SurfacePoint point;
    Rgb radiance;
    EXPECT_TRUE(shader.radiance(ray, point, radiance));
    sum += radiance / (per_axis * per_axis);
  }
  return sum;
}

TEST(Shading, MattPlateIsAsBrightAsTheCosineOfTheSun) {
  VERIFIES("LASSO-PIC-003~1");
  const ModelSurface plate = surface_of(square(2));
  for (const double angle : {0.0, 0.5, 1.0, 1.4}) {
    Lights lights;
    lights.sun = Vec3(std::sin(angle) * 0.6, std::sin(angle) * 0.8, std::cos(angle));
    const Shader shader(plate, {matt(0.5)}, lights);
    const Rgb seen = mean_radiance(shader, Vec3(0.3, 1, 2), Vec3(0, -0.4, -1).normalized());
    EXPECT_NEAR(seen[0], kSun_Wpm2 * std::cos(angle) * 0.5 / kPi, 1e-3 * kSun_Wpm2 / kPi) << angle;
  }
}

TEST(Shading, SunAndEarthAreAsTheOrbitHasThem) {
  VERIFIES("LASSO-PIC-015~1");
  const ModelSurface plate = surface_of(square(2));
  Lights lights;
  lights.sun = Vec3(0, 0, 1);
  lights.sun_share = 0.3;
  const Vec3 from(0.3, 0.1, 2);
  EXPECT_NEAR(mean_radiance(Shader(plate, {matt(0.5)}, lights), from, -Vec3::UnitZ())[0], 0.3 * kSun_Wpm2 * 0.5 / kPi, 0.01);
  lights.sun = Vec3(0, 0, -1);
  lights.sun_share = 0;
  lights.earth = Vec3(0, 0, 1);
  lights.earth_half_angle_rad = 0.4;
  const double sine = std::sin(0.4);
  EXPECT_NEAR(mean_radiance(Shader(plate, {matt(0.5)}, lights), from, -Vec3::UnitZ())[0], 0.5 * sine * sine * earth_radiance(lights), 1e-6);
}

TEST(Shading, TheBackOfAPlateIsDark) {
  VERIFIES("LASSO-PIC-003~1");
  Lights lights;
  lights.sun = Vec3(0.1, 0.2, -1).normalized();
  const ModelSurface plate = surface_of(square(2));
  EXPECT_EQ(mean_radiance(Shader(plate, {matt(0.5)}, lights), Vec3(0.3, 0.1, 2), -Vec3::UnitZ()).maxCoeff(), 0);
}

TEST(Shading, LampFallsWithTheSquareOfTheRange) {
  VERIFIES("LASSO-PIC-005~1");
  const ModelSurface plate = surface_of(square(2));
  for (const double range_m : {2.0, 5.0}) {
    Lights lights;
    lights.lamps.resize(1);
    lights.lamps[0].place_m = Vec3(0.3, 0.2, range_m);
    const Rgb seen = mean_radiance(Shader(plate, {matt(0.5)}, lights), lights.lamps[0].place_m, -Vec3::UnitZ());
    EXPECT_NEAR(seen[0], kLamp_Wpsr / (range_m * range_m) * 0.5 / kPi, 1e-5) << range_m;
  }
}

TEST(Shading, EarthLightsAPlateByItsViewFactor) {
  VERIFIES("LASSO-PIC-004~1");
  const ModelSurface plate = surface_of(square(2));
  for (const double angle : {0.0, 0.8, 1.5, 2.2}) {
    Lights lights;
    lights.earth = Vec3(std::sin(angle), 0, std::cos(angle));
    lights.sun = Vec3(0.8 * -lights.earth->x(), 0.6, 0.8 * -lights.earth->z()).normalized();
    const double by_sun = std::max(0.0, lights.sun->z()) * kSun_Wpm2 * 0.4 / kPi;
    const Rgb seen = mean_radiance(Shader(plate, {matt(0.4)}, lights), Vec3(0.1, 0.2, 3), -Vec3::UnitZ());
    EXPECT_NEAR(seen[0] - by_sun, 0.4 * disc_view_factor(std::cos(angle), kEarthHalfAngle_rad) * earth_radiance(lights), 0.7) << angle;
  }
}

// Facets without roughness to speak of: a plate that faces Earth mirrors its disc, one that faces away the black sky.
TEST(Shading, FoilMirrorsEarthOrTheSky) {
  VERIFIES("LASSO-PIC-004~1");
  const ModelSurface plate = surface_of(square(2));
  const Material foil{"foil", "", {Rgb::Zero(), Rgb::Constant(0.8), 0.02}, 0, 0, 0, 0, 0.2};
  Lights lights;
  lights.sun = Vec3(0, 0, -1);
  lights.earth = Vec3(0, 0, 1);
  EXPECT_NEAR(mean_radiance(Shader(plate, {foil}, lights), Vec3(0, 0, 3), -Vec3::UnitZ())[0], 0.8 * earth_radiance(lights), 0.5);
  const Vec3 flat_view = Vec3(1, 0, -0.1).normalized();  // its mirror direction is 84 deg off Earth's middle
  EXPECT_LT(mean_radiance(Shader(plate, {foil}, lights), -3 * flat_view, flat_view)[0], 0.05 * earth_radiance(lights));
}

TEST(Shading, AMirrorShowsWhatIsLitBesideIt) {
  VERIFIES("LASSO-PIC-006~1");
  Mesh mesh = square(2);
  Mesh wall = square(2);
  for (Eigen::Vector3d& v : wall.vertices) v = Eigen::Vector3d(1, v.y(), v.x() + 1);  // stands at x = 1
  append(mesh, wall);
  const ModelSurface surface(mesh, {0, 0, 1, 1}, 0.5);
  const Material mirror{"mirror", "", {Rgb::Zero(), Rgb::Ones(), 0.005}, 0, 0, 0, 0, 0};
  Lights lights;
  lights.sun = Vec3(-0.8, 0, 0.6);
  const Vec3 view = Vec3(1, 0, -1).normalized();  // meets the mirror at x = 0.3, its reflection the wall
  const Rgb seen = mean_radiance(Shader(surface, {mirror, matt(0.5)}, lights), Vec3(0.3, 0, 0) - 2 * view, view);
  EXPECT_NEAR(seen[0], kSun_Wpm2 * 0.8 * 0.5 / kPi, 0.01 * kSun_Wpm2);
}

// What a surface looks like on the average does not depend on how far it is: relief that is too small to be seen makes it rougher.
TEST(Shading, ReliefThatIsNotSeenMakesTheSurfaceRougher) {
  VERIFIES("LASSO-PIC-012~1");
  const ModelSurface plate = surface_of(square(1000));
  Material foil{"foil", "", {Rgb::Zero(), Rgb::Constant(0.8), 0.10}, 0.10, 1e-5, 0, 0, 0.2};  // facets of 1 cm
  Lights lights;
  lights.sun = Vec3(0.1, 0, 1).normalized();
  const Shader shader(plate, {foil}, lights);
  double near = 0, far = 0;
  constexpr int kPlaces = 3000;
  for (int i = 0; i < kPlaces; ++i) {
    PictureRay ray{Vec3(0.0371 * i, 0.0193 * i, 3), -Vec3::UnitZ(), 1e-5, PixelSamples(static_cast<std::uint64_t>(i), 1), 0};
    SurfacePoint point;
    Rgb radiance;
    ASSERT_TRUE(shader.radiance(ray, point, radiance));
    near += radiance[0] / kPlaces;
    ray.pixel_rad = 1;
    ASSERT_TRUE(shader.radiance(ray, point, radiance));
    far += radiance[0] / kPlaces;
  }
  EXPECT_NEAR(near / far, 1, 0.25);
}

TEST(Shading, LinesBetweenCellsCoverTheirShare) {
  VERIFIES("LASSO-PIC-007~1");
  const ModelSurface plate = surface_of(square(1));
  Material cells = matt(0.1);
  cells.grid_pitch = 0.1;
  Lights lights;
  lights.sun = Vec3(0, 0, 1);
  const Shader shader(plate, {cells}, lights);
  double sum = 0, brightest = 0;
  constexpr int kSide = 97;
  for (int i = 0; i < kSide * kSide; ++i) {
    const Vec3 from((i % kSide + 0.5) / kSide - 0.5, (i / kSide + 0.5) / kSide - 0.5, 1);
    PictureRay ray{from, -Vec3::UnitZ(), 1e-3, PixelSamples(0, 1), 0};
    SurfacePoint point;
    Rgb radiance;
    ASSERT_TRUE(shader.radiance(ray, point, radiance));
    const double reflectance = radiance[0] * kPi / kSun_Wpm2;
    sum += reflectance / (kSide * kSide);
    brightest = std::max(brightest, reflectance);
  }
  const double share = 1 - (1 - kGridLine) * (1 - kGridLine);
  EXPECT_NEAR(sum, 0.1 + share * (kGridReflectance - 0.1), 0.01);
  EXPECT_NEAR(brightest, kGridReflectance, 1e-3);
}

// The inverse square and the cosine on a matt plate, within the cone and nowhere else.
TEST(Shading, ALampLightsItsConeByTheInverseSquare) {
  VERIFIES("LASSO-SCN-035~1");
  const ModelSurface plate = surface_of(square(8));
  Lights lights;
  lights.lamps.resize(2);
  lights.lamps[0].place_m = Vec3(1, 0.5, 3);
  lights.lamps[0].axis = Vec3(-0.2, 0.1, -1).normalized();
  lights.lamps[0].half_angle_rad = 0.25;
  lights.lamps[0].intensity_Wpsr = 40;
  lights.lamps[1].place_m = Vec3(-2, 0, 4);
  lights.lamps[1].intensity_Wpsr = 7;
  const Shader shader(plate, {matt(0.5)}, lights);
  const auto expected = [&](const Lamp& lamp, const Vec3& at) {
    const Vec3 way = lamp.place_m - at;
    const double off_rad = std::acos(-way.normalized().dot(lamp.axis));
    return off_rad < lamp.half_angle_rad ? lamp.intensity_Wpsr * way.normalized().z() / way.squaredNorm() * 0.5 / kPi : 0;
  };
  int in_cone = 0;
  for (double x = -1.5; x < 2; x += 0.31) {
    const Vec3 at(x, 0.4, 0);
    in_cone += expected(lights.lamps[0], at) > 0 ? 1 : 0;
    EXPECT_NEAR(mean_radiance(shader, at + Vec3(0, 0, 2), -Vec3::UnitZ())[0], expected(lights.lamps[0], at) + expected(lights.lamps[1], at),
                1e-4)
        << x;
  }
  EXPECT_GT(in_cone, 2);
  EXPECT_LT(in_cone, 8);
}

// A plate of 0.4 m, half-way to a lamp 2 m above the ground, shades 0.8 m of it; one that is behind the lamp shades nothing.
TEST(Shading, ALampCastsShadowsOfWhatIsBeforeIt) {
  VERIFIES("LASSO-SCN-035~1");
  Mesh mesh = square(8), plate = square(0.4);
  for (Eigen::Vector3d& v : plate.vertices) v += Eigen::Vector3d(0, 0, 1);
  append(mesh, plate);
  for (const auto& [height_m, half_m] : {std::pair{2.0, 0.4}, std::pair{0.5, 0.0}}) {
    Lights lights;
    lights.lamps.resize(1);
    lights.lamps[0].place_m = Vec3(0, 0, height_m);
    const ModelSurface surface(mesh, std::vector<std::uint32_t>(mesh.triangles.size(), 0), 0.5);
    const Shader shader(surface, {matt(0.5)}, lights);
    for (const double x : {0.1, 0.35, 0.45, 0.9}) {
      const Vec3 slanted = Vec3(-0.1, 0.02, -0.3).normalized();  // from below the plate
      const Rgb seen = mean_radiance(shader, Vec3(x, 0, 0) - 0.5 * slanted, slanted);
      EXPECT_EQ(seen.maxCoeff() > 0, x > half_m) << x << " " << height_m;
    }
    lights.lamps[0].casts_shadows = false;
    EXPECT_GT(mean_radiance(Shader(surface, {matt(0.5)}, lights), Vec3(0.1, 0, 0.5), -Vec3::UnitZ()).maxCoeff(), 0);
  }
}

}  // namespace
}  // namespace lasso::mdat
