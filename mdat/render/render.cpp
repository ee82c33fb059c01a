#include "mdat/render/render.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

namespace lasso::mdat {
namespace {

// Runs `row` for each row on several threads; each row writes what is its own, and throws nothing.
void for_each_row(const RenderSetup& setup, const std::function<void(int)>& row) {
  std::atomic<int> next{0}, done{0};
  const auto work = [&] {
    for (int i = next++; i < setup.camera.height; i = next++, ++done) row(i);
  };
  std::vector<std::jthread> threads;
  for (unsigned i = 0; i < std::max(1U, setup.jobs); ++i) threads.emplace_back(work);
  while (setup.progress && done < setup.camera.height) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    setup.progress(static_cast<std::size_t>(done));
  }
}

std::size_t pixel_count(const Camera& camera) { return static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height); }
std::size_t pixel_index(const Camera& camera, int column, int row) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(camera.width) + static_cast<std::size_t>(column);
}

constexpr std::uint32_t kWithinPixel = 0;  // purpose of samples

}  // namespace

std::vector<SeenPoint> seen_points(const ModelSurface& surface, const RenderSetup& setup) {
  const Pose T_target_sensor = inverse(setup.T_sensor_target);
  std::vector<SeenPoint> points(pixel_count(setup.camera));
  for_each_row(setup, [&](int row) {
    for (int column = 0; column < setup.camera.width; ++column) {
      const Vec3 direction = setup.camera.direction(column, row);
      SurfacePoint found;
      if (!surface.find(T_target_sensor.p, rotate(T_target_sensor.q, direction), found)) continue;
      points[pixel_index(setup.camera, column, row)] = {true, found.range_m * direction.z(), found.range_m,
                                                        rotate(setup.T_sensor_target.q, found.smooth_normal), found.part};
    }
  });
  return points;
}

std::vector<Rgb> rendered(const ModelSurface& surface, const std::vector<Material>& materials, const Lights& lights,
                          const RenderSetup& setup) {
  const Pose T_target_sensor = inverse(setup.T_sensor_target);
  const Shader shader(surface, materials, lights_in_frame(lights, T_target_sensor));
  const Camera& camera = setup.camera;
  std::vector<Rgb> picture(pixel_count(camera), Rgb::Zero());
  const int n = setup.samples_per_axis;
  for_each_row(setup, [&](int row) {
    for (int column = 0; column < camera.width; ++column) {
      const std::size_t pixel = pixel_index(camera, column, row);
      PictureRay ray{T_target_sensor.p, Vec3::UnitZ(), 1 / camera.focal_px, PixelSamples(pixel, n), 0};
      Rgb sum = Rgb::Zero();
      for (ray.index = 0; ray.index < n * n; ++ray.index) {
        const UnitSquare at = n == 1 ? UnitSquare{} : ray.samples.at(ray.index, kWithinPixel);
        ray.direction = rotate(T_target_sensor.q, camera.direction(column + at.u - 0.5, row + at.v - 0.5));
        SurfacePoint found;
        Rgb radiance;
        if (shader.radiance(ray, found, radiance)) sum += radiance;
      }
      picture[pixel] = sum / (n * n);
    }
  });
  return picture;
}

}  // namespace lasso::mdat
