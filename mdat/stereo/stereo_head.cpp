#include "mdat/stereo/stereo_head.hpp"

#include <cmath>

#include "fsw/geometry/so3.hpp"
#include "mdat/stereo/exposure_control.hpp"

namespace lasso::mdat {
namespace {

PairCamera stated_camera(const Camera& camera) {
  return {camera.width, camera.height, camera.focal_px, camera.focal_px, camera.center_x, camera.center_y, {}};
}

std::optional<Vec3> direction_of(const std::vector<double>& xyz) {
  const Vec3 direction(xyz.data());
  return direction.norm() > 0 ? std::optional<Vec3>(direction.normalized()) : std::nullopt;
}

}  // namespace

StereoHead make_head(const StereoSource& source, double fov_half_x_rad, double fov_half_y_rad) {
  StereoHead head;
  head.source = source;
  head.camera = camera_of(size_of(static_cast<int>(source.pixels), fov_half_x_rad, fov_half_y_rad), fov_half_x_rad, fov_half_y_rad);
  head.imager.f_number = source.f_number;
  head.imager.pixel_m = source.pixel_m;
  head.imager.full_well_e = source.full_well_e;
  head.imager.read_noise_e = source.read_noise_e;
  head.T_left_right.p = source.baseline_m * (1 + source.baseline_error) * Vec3::UnitX();
  head.T_left_right.q = exp_so3(Vec3(source.turn_error_rad.data()));
  head.stated.left = head.stated.right = stated_camera(head.camera);
  head.stated.T_left_right.p = source.baseline_m * Vec3::UnitX();
  head.stated.codes = {true, source.full_well_e, source.read_noise_e};
  return head;
}

Lights stereo_lights(const StereoSource& source, const std::optional<Lights>& of_orbit, const std::vector<Lamp>& lamps) {
  Lights lights;
  lights.sun = direction_of(source.sun);
  lights.earth = direction_of(source.earth);
  if (of_orbit) lights = *of_orbit;
  if (source.earthshine == 0) lights.earth.reset();
  lights.lamps = lamps;
  if (source.lamp_Wpsr > 0) lights.lamps.push_back(lamp_at_camera(source.lamp_Wpsr / kBandShare));  // all of its light is in the band
  return lights;
}

std::vector<Material> stereo_materials(const StereoSource& source, std::vector<Material> materials) {
  if (source.plain == 0) return materials;
  for (Material& material : materials) material.tilt_rad = material.contrast = material.grid_pitch = 0;
  return materials;
}

GreyImage StereoCamera::seen_by(const StereoView& view, bool right, unsigned jobs, const std::function<void(std::size_t)>& progress) const {
  const Pose T_camera_sensor = right ? inverse(head_.T_left_right) : Pose{};
  RenderSetup setup;
  setup.camera = head_.camera;
  setup.T_sensor_target = T_camera_sensor * view.T_sensor_target;
  setup.samples_per_axis = static_cast<int>(head_.source.samples);
  setup.jobs = jobs;
  const auto rows = static_cast<std::size_t>(right ? head_.camera.height : 0);
  if (progress) setup.progress = [&](std::size_t done) { progress(rows + done); };
  const std::vector<Rgb> radiance = rendered(view.surface, view.materials, lights_in_frame(view.lights, T_camera_sensor), setup);
  GreyImage image{head_.camera.width, head_.camera.height, {}};
  image.values.reserve(radiance.size());
  for (const Rgb& colour : radiance) image.values.push_back(kBandShare * colour.mean());  // the detector sees all colours alike
  return through_lens(image, head_.imager);
}

StereoPictures StereoCamera::take(const StereoView& view, unsigned jobs, const std::function<void(std::size_t)>& progress) {
  const GreyImage left = seen_by(view, false, jobs, progress), right = seen_by(view, true, jobs, progress);
  const ImagerSeeds left_seeds{2 * seed_, 1 + frame_}, right_seeds{2 * seed_ + 1, 1 + frame_};
  double exposure_s = head_.source.exposure_s;
  if (exposure_s == 0) exposure_s = next_exposure_s_ > 0 ? next_exposure_s_ : settled_exposure_s(left, head_.imager, left_seeds);
  const RawFrame raw = exposed(left, head_.imager, exposure_s, left_seeds);
  next_exposure_s_ = next_exposure_s(raw, head_.imager);
  ++frame_;
  const int width = head_.camera.width, height = head_.camera.height, greatest = greatest_number(head_.imager);
  return {{width, height, square_root_codes(raw, greatest)},
          {width, height, square_root_codes(exposed(right, head_.imager, exposure_s, right_seeds), greatest)},
          exposure_s,
          saturated_share(raw, head_.imager)};
}

}  // namespace lasso::mdat
