#include "mdat/render/run_pictures.hpp"

#include "mdat/common/text.hpp"
#include "mdat/render/exposure.hpp"
#include "mdat/render/scene.hpp"

namespace lasso::mdat {
namespace {

constexpr std::size_t kPictures = 6;
constexpr int kLongest_px = 440, kSamples = 2;

// `dark`: nothing that is lit is in view.
std::string png_of(const Scene& scene, const std::vector<ScanMark>& marks, unsigned jobs, bool& dark) {
  RenderSetup setup;
  setup.camera = camera_of(size_of(kLongest_px, scene.fov_half_x_rad, scene.fov_half_y_rad), scene.fov_half_x_rad, scene.fov_half_y_rad);
  setup.T_sensor_target = scene.T_sensor_target;
  setup.samples_per_axis = kSamples;
  setup.jobs = jobs;
  Lights lights = scene.orbit_lights.value_or(usual_lights());
  lights.lamps = scene.lamps;
  const std::vector<Rgb> radiance = rendered(*scene.surface, scene.materials, lights, setup);
  const double white = automatic_white(radiance, seen_points(*scene.surface, setup));
  dark = !(white > 0);
  return png_bytes(scan_view(photo(radiance, setup.camera, white), setup.camera, marks));
}

RunPicture picture_of(const CompiledMission& mission, const SimulationResult& result, const KeptScan& scan, unsigned jobs) {
  SceneRequest request;
  request.scenario = result.scenario;
  request.seed = result.seed;
  request.time_s = to_seconds(scan.telemetry.t_measurement_us - kEpochUs);
  request.camera = result.sensors.at(scan.telemetry.sensor);
  const Scene scene = make_scene(mission, request);
  const std::string caption =
      format("%.1f s, %.1f m, %s: %u of %zu rays return%s", request.time_s, scan.truth.p.norm(), request.camera.c_str(),
             scan.telemetry.returns, scan.samples.size(), scan.telemetry.valid != 0 ? "" : "; no valid pose");
  bool dark = false;
  std::string png = png_of(scene, scan_marks(mission, scene, scan), jobs, dark);
  return {caption + (dark ? "; dark: nothing in view is lit" : ""), std::move(png)};
}

}  // namespace

std::vector<RunPicture> run_pictures(const CompiledMission& mission, const SimulationResult& result, unsigned jobs) {
  std::vector<RunPicture> pictures;
  const TableResult& table = result.tables.front();
  const std::vector<KeptScan>& scans = table.variants.front().cases.front().scans;
  if (table.scenario.scene == nullptr || scans.empty()) return pictures;
  const std::size_t count = std::min(kPictures, scans.size());
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t scan = count == 1 ? 0 : i * (scans.size() - 1) / (count - 1);
    pictures.push_back(picture_of(mission, result, scans[scan], jobs));
  }
  return pictures;
}

}  // namespace lasso::mdat
