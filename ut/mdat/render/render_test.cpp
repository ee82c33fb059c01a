#include "mdat/render/render.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/render/exposure.hpp"
#include "ut/mdat/render/shapes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

RenderSetup setup_of(int size, double half_rad, const Pose& pose) {
  RenderSetup setup;
  setup.camera = camera_of({size, size}, half_rad, half_rad);
  setup.T_sensor_target = pose;
  return setup;
}

// Of the ellipse that a cone of half angle `a` about a direction `b` off the boresight cuts out of the plane z = 1.
double silhouette_area(double a, double b) {
  const double rest = std::cos(b) * std::cos(b) - std::sin(a) * std::sin(a);
  return kPi * (std::sin(a) * std::cos(a) / rest) * (std::sin(a) / std::sqrt(rest));
}

TEST(Render, SilhouetteOfABallHasItsArea) {
  VERIFIES("LASSO-PIC-001~1");
  const ModelSurface surface = surface_of(ball(1, 5));
  for (const Vec3& place_m : {Vec3(0, 0, 6), Vec3(0.9, -1.1, 6)}) {
    const RenderSetup setup = setup_of(400, 0.4, {generic_attitude(), place_m});
    double pixels = 0;
    for (const SeenPoint& point : seen_points(surface, setup)) pixels += point.hit ? 1 : 0;
    const double area = silhouette_area(std::asin(1 / place_m.norm()), std::acos(place_m.z() / place_m.norm()));
    EXPECT_NEAR(pixels / (area * setup.camera.focal_px * setup.camera.focal_px), 1, 0.003);
  }
}

// Nearest of the triangles that a ray meets, by solving for its place in each of them.
struct Nearest {
  double range_m = std::numeric_limits<double>::infinity();
  Vec3 normal = Vec3::Zero();
};
Nearest nearest(const Mesh& mesh, const Vec3& origin, const Vec3& direction) {
  Nearest found;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]], ab = mesh.vertices[t[1]] - a, ac = mesh.vertices[t[2]] - a;
    Mat3 system;
    system << ab, ac, -direction;
    if (std::fabs(system.determinant()) < 1e-12) continue;
    const Vec3 x = system.inverse() * (origin - a);
    if (x[0] < 0 || x[1] < 0 || x[0] + x[1] > 1 || x[2] <= 0 || x[2] >= found.range_m) continue;
    found = {x[2], ab.cross(ac).normalized()};
  }
  return found;
}

TEST(Render, DepthsAndNormalsAreThoseOfTheMesh) {
  VERIFIES("LASSO-PIC-008~1");
  Mesh mesh = make_box({1, 0.6, 1.4});
  append(mesh, make_rod({0, 0, 0.7}, {0.3, 0.2, 1.5}, 0.2, 0.1, 7));
  const Pose pose{generic_attitude(), {0.2, -0.1, 5}};
  const RenderSetup setup = setup_of(61, 0.2, pose);
  const std::vector<SeenPoint> seen = seen_points(surface_of(mesh, 0.01), setup);
  const Pose T_target_sensor = inverse(pose);
  int hits = 0, differing = 0;
  for (int row = 0; row < 61; ++row) {
    for (int column = 0; column < 61; ++column) {
      const double scale = 2 * std::tan(0.2) / 61;  // of a pixel on the plane z = 1
      const Vec3 ray(scale * (column - 30), scale * (row - 30), 1);
      const Nearest truth = nearest(mesh, T_target_sensor.p, rotate(T_target_sensor.q, ray));
      const SeenPoint& point = seen[static_cast<std::size_t>(row * 61 + column)];
      if (std::isfinite(truth.range_m) != point.hit) ++differing;  // on the very edge
      if (!point.hit || !std::isfinite(truth.range_m)) continue;
      ++hits;
      EXPECT_NEAR(point.depth_m, truth.range_m, 1e-9);
      EXPECT_NEAR(point.range_m, truth.range_m * ray.norm(), 1e-9);
      EXPECT_LT((point.normal - rotate(pose.q, truth.normal)).norm(), 1e-9);
    }
  }
  EXPECT_GT(hits, 500);
  EXPECT_LE(differing, 2);
}

TEST(Render, DepthsAreTheRayCastersToTheLastDigit) {
  VERIFIES("LASSO-PIC-008~1");
  const Mesh mesh = ball(1, 3);
  const auto caster = sim::make_ray_caster(mesh.vertices, mesh.triangles);
  const ModelSurface surface = surface_of(mesh);
  for (int i = 0; i < 3; ++i) {
    const Pose pose{exp_so3(Vec3(0.3 + i, -0.8, 0.4 * i)), {0.1 * i, 0.2, 4}};
    const RenderSetup setup = setup_of(40, 0.3, pose);
    const std::vector<SeenPoint> seen = seen_points(surface, setup);
    const Pose T_target_sensor = inverse(pose);
    for (int pixel = 0; pixel < 1600; ++pixel) {
      const Vec3 direction = setup.camera.direction(pixel % 40, pixel / 40);
      const sim::RayHit hit = caster->cast(T_target_sensor.p, rotate(T_target_sensor.q, direction));
      const SeenPoint& point = seen[static_cast<std::size_t>(pixel)];
      ASSERT_EQ(point.hit, hit.hit);
      EXPECT_DOUBLE_EQ(point.range_m, hit.range_m);  // both 0 where nothing is hit
    }
  }
}

// A box of side 1 whose middle is 1 m before a wall at 5 m; the sun stands 45 deg to the right behind the camera. Its shadow on the wall
// begins where light that passes the front edge at the left (x = -0.5, z = 3.5) arrives: x = -2.
TEST(Render, ShadowOfABoxFallsWhereItsEdgesAre) {
  VERIFIES("LASSO-PIC-003~1");
  Mesh mesh = square(20);
  for (Eigen::Vector3d& v : mesh.vertices) v.z() = 5;
  Mesh box = make_box({1, 1, 1});
  for (Eigen::Vector3d& v : box.vertices) v.z() += 4;
  append(mesh, box);
  Lights lights;
  lights.sun = Vec3(1, 0, -1).normalized();
  const RenderSetup setup = setup_of(301, 0.6, Pose{});
  const Camera& camera = setup.camera;
  const std::vector<Rgb> picture = rendered(surface_of(mesh), {matt(0.5)}, lights, setup);
  const auto at = [&](double x, double y) {  // of the wall
    const Eigen::Vector2d pixel = camera.pixel({x, y, 5});
    return picture[static_cast<std::size_t>(std::lround(pixel.y())) * 301 + static_cast<std::size_t>(std::lround(pixel.x()))][0];
  };
  const double lit = kSun_Wpm2 * std::sqrt(0.5) * 0.5 / kPi;
  const double clear = 0.05;  // two pixels, and the penumbra of 1.5 m times the sun's half angle
  EXPECT_NEAR(at(-2 - clear, 0.1), lit, 0.01 * lit);
  EXPECT_NEAR(at(-2 + clear, 0.1), 0, 1e-9);
  EXPECT_NEAR(at(-1.2, 0.5 - clear), 0, 1e-9);
  EXPECT_NEAR(at(-1.2, 0.5 + clear), lit, 0.01 * lit);
  EXPECT_NEAR(at(-1.2, -0.5 + clear), 0, 1e-9);
  EXPECT_NEAR(at(-1.2, -0.5 - clear), lit, 0.01 * lit);
  EXPECT_NEAR(at(1.5, 0.1), lit, 0.01 * lit);
}

// The penumbra of an edge 10 m above a plate is as wide as the sun there; across it, light grows as the part of a disc beyond a straight
// edge does: half of it where the edge cuts the middle, 0.8045 at half a radius from it.
TEST(Render, ShadowsHaveThePenumbraOfTheSunsDisc) {
  VERIFIES("LASSO-PIC-003~1");
  Mesh mesh = square(2);
  Mesh screen = square(2);
  for (Eigen::Vector3d& v : screen.vertices) v += Eigen::Vector3d(1, 0, -10);  // from x = 0 on, between the plate and the sun
  append(mesh, screen);
  Lights lights;
  lights.sun = Vec3(0, 0, -1);
  const ModelSurface surface = surface_of(mesh);
  RenderSetup setup = setup_of(1, 1e-4, {Quat(1, 0, 0, 0), Vec3(0, 0, 2)});
  setup.samples_per_axis = 40;
  const double radius_m = 10 * kSunHalfAngle_rad, lit = kSun_Wpm2 * 0.5 / kPi;
  for (const auto& [radii, share] : {std::pair{0.0, 0.5}, {-0.5, 0.8045}, {0.5, 0.1955}, {-1.1, 1.0}, {1.1, 0.0}}) {
    setup.T_sensor_target.p.x() = -radii * radius_m;
    EXPECT_NEAR(rendered(surface, {matt(0.5)}, lights, setup)[0][0] / lit, share, 0.012) << radii;
  }
}

TEST(Render, PicturesDoNotDependOnThreads) {
  VERIFIES("LASSO-PIC-002~1");
  Mesh mesh = make_box({1, 0.6, 1.4});
  append(mesh, make_rod({0, 0, 0.7}, {0.9, 0.2, 1.5}, 0.2, 0.1, 12));
  const ModelSurface surface = surface_of(mesh);
  Lights lights;
  lights.sun = Vec3(0.5, -0.5, -0.7).normalized();
  lights.earth = Vec3(0, 1, 0);
  lights.lamps = {lamp_at_camera(kLamp_Wpsr)};
  RenderSetup setup = setup_of(80, 0.2, {generic_attitude(), {0.1, 0, 5}});
  std::size_t last = 0;
  std::string bytes[2];
  for (const unsigned jobs : {1U, 2U}) {
    setup.jobs = jobs;
    setup.progress = [&](std::size_t rows) { last = rows; };
    bytes[jobs - 1] = png_bytes(photo(rendered(surface, {*material_preset("mli")}, lights, setup), setup.camera, 300));
  }
  EXPECT_EQ(bytes[0], bytes[1]);
  EXPECT_GT(last, 0U);
}

TEST(Render, LightsAreInTheSensorFrame) {
  VERIFIES("LASSO-PIC-003~1");
  const ModelSurface surface = surface_of(square(2));
  Lights lights;
  lights.sun = Vec3(0.6, 0, -0.8);
  // The plate faces the camera whichever way the target's axes stand about the boresight.
  for (const double turn : {0.3, 2.0}) {
    RenderSetup setup = setup_of(3, 0.05, {exp_so3(Vec3(0, 0, turn)), {0, 0, 3}});
    EXPECT_NEAR(rendered(surface, {matt(0.5)}, lights, setup)[4][0], 0.8 * kSun_Wpm2 * 0.5 / kPi, 0.5) << turn;
  }
}

}  // namespace
}  // namespace lasso::mdat
