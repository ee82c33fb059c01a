#include "mdat/availability/pictures.hpp"

#include <cmath>

#include "mdat/common/text.hpp"
#include "mdat/render/exposure.hpp"
#include "mdat/render/scene.hpp"
#include "mdat/stereo/stereo_head.hpp"

namespace lasso::mdat {
namespace {

constexpr std::size_t kMostTimes = 6;
constexpr double kShown_px = 320, kShownSamples = 2;

std::string verdict_words(const FrameError& error) {
  if (error.wrong) return "a pose that says valid, and is wrong";
  if (!error.valid) return std::string("no pose: ") + to_string(error.reason);
  return format("%.2f mm, %.3f deg off", 1e3 * error.registration.translation_m.norm(), error.registration.rotation_rad / kRadPerDeg);
}

std::string light_words(const LightAt& light) {
  return format("%s, Sun %.0f%% and %.0f deg off the boresight", phase_name(phase_of(light)), 100 * light.sun_share,
                light.sun_off_rad / kRadPerDeg);
}

Scene scene_at(const MissionInput& mission, const std::string& scenario, double time_s) {
  SceneRequest request;
  request.scenario = scenario;
  request.time_s = time_s;
  return make_scene(mission, request);
}

Picture as_colours(const GreyPicture<std::uint8_t>& grey) {
  Picture picture(grey.width, grey.height);
  for (std::size_t i = 0; i < grey.codes.size(); ++i) picture.pixels[i] = {grey.codes[i], grey.codes[i], grey.codes[i]};
  return picture;
}

// The codes as the matcher gets them, of a coarser head with the same optics.
SeenPicture left_picture(const MissionInput& mission, const std::string& scenario, const HeadResult& head, std::size_t frame,
                         unsigned jobs) {
  const SeenFrame& seen = head.approach[frame];
  const Scene scene = scene_at(mission, scenario, seen.error.t_s);
  StereoSource source = mission.source.stereo;
  source.pixel_m *= source.pixels / kShown_px;  // the same focal length
  source.pixels = kShown_px;
  source.samples = kShownSamples;
  StereoCamera camera(make_head(source, scene.fov_half_x_rad, scene.fov_half_y_rad), scene.seed);
  const StereoPictures pictures = camera.take({*scene.surface, stereo_materials(source, scene.materials),
                                               stereo_lights(source, scene.orbit_lights, scene.lamps), scene.T_sensor_target},
                                              jobs);
  return {format("%.0f s, %.1f m, %s. %s: %s", seen.error.t_s, seen.error.range_m, light_words(seen.light).c_str(), head.head.title.c_str(),
                 verdict_words(seen.error).c_str()),
          png_bytes(as_colours(pictures.left))};
}

// Normals, as they need no light.
SeenPicture laser_picture(const CompiledMission& mission, const std::string& scenario, const HeadResult& head, std::size_t frame) {
  const SeenFrame& seen = head.approach[frame];
  const Scene scene = scene_at(mission, scenario, seen.error.t_s);
  RenderSetup setup;
  const auto longest = static_cast<int>(kShown_px);
  setup.camera = camera_of(size_of(longest, scene.fov_half_x_rad, scene.fov_half_y_rad), scene.fov_half_x_rad, scene.fov_half_y_rad);
  setup.T_sensor_target = scene.T_sensor_target;
  std::vector<ScanMark> marks;
  for (const KeptScan& scan : head.scans) {
    if (scan.frame == seen.error.frame) marks = scan_marks(mission, scene, scan);
  }
  const Picture view = normals_view(seen_points(*scene.surface, setup), setup.camera);
  return {
      format("%.0f s, laser camera, its scan on a picture of surface directions: %s", seen.error.t_s, verdict_words(seen.error).c_str()),
      png_bytes(scan_view(view, setup.camera, marks))};
}

}  // namespace

std::vector<std::size_t> shown_times(const std::vector<SeenFrame>& frames) {
  std::vector<std::size_t> times;
  std::size_t begin = 0;
  for (std::size_t i = 1; i <= frames.size() && times.size() < kMostTimes; ++i) {
    if (i < frames.size() && phase_of(frames[i].light) == phase_of(frames[begin].light)) continue;
    times.push_back((begin + i - 1) / 2);
    begin = i;
  }
  return times;
}

std::vector<SeenPicture> approach_pictures(const ComparisonOptions& options, const HeadComparison& comparison) {
  std::vector<SeenPicture> pictures;
  std::vector<std::unique_ptr<HeadFlights>> flights;
  for (const HeadResult& head : comparison.heads)
    flights.push_back(std::make_unique<HeadFlights>(options.mission, head.head, options.approach));
  for (const std::size_t frame : shown_times(comparison.heads.front().approach)) {
    for (std::size_t i = 1; i < comparison.heads.size(); ++i)
      pictures.push_back(left_picture(flights[i]->mission(), comparison.approach, comparison.heads[i], frame, options.jobs));
    pictures.push_back(laser_picture(flights[0]->mission(), comparison.approach, comparison.heads[0], frame));
  }
  return pictures;
}

}  // namespace lasso::mdat
