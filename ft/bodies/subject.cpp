#include "ft/bodies/subject.hpp"

#include "mdat/missiondb/new_mission.hpp"

namespace lasso::bodies {
namespace {

mdat::KnowableNoise noise_of(const MissionParameters& parameters) {
  return {parameters.sigma0_m, parameters.sigma_k_per_m, parameters.sigma_angle_rad, parameters.surface_sigma_m};
}

}  // namespace

Subject make_subject(std::uint64_t seed, std::optional<mdat::SensorKind> sensor, const std::vector<std::string>& settings,
                     const std::filesystem::path& folder) {
  Subject subject;
  subject.body = mdat::make_body(seed);
  subject.truth = mdat::truth_of(subject.body);
  mdat::ModelCache cache = mdat::ModelCache::of_user();
  mdat::NewMissionRequest request;
  request.out = folder / ("body_" + std::to_string(seed) + ".toml");
  request.model = folder / ("body_" + std::to_string(seed) + "_model.toml");
  request.model_text = mdat::commented_model_text(subject.body, subject.truth);
  request.sensor = sensor;
  request.replace = true;
  request.compile = [&](const mdat::Mesh& mesh, const mdat::ModelOptions& options, mdat::CompileReport& report) {
    return cache.compile(mesh, options, report);
  };
  (void)mdat::write_new_mission(request);
  subject.mission = mdat::compile_mission(mdat::load_mission_input(request.out, settings));
  subject.noise = noise_of(subject.mission.source.parameters);
  subject.target = std::make_unique<mdat::KnowableTarget>(subject.mission.mesh, subject.mission.source.target.crease_angle_rad,
                                                          subject.noise, subject.truth.size_m);
  subject.nearest_m = mdat::scenario_of(subject.mission.source, "paper").ranges_m.front();
  return subject;
}

bool is_determined(const Subject& subject, const Pose& T_sensor_target, std::span<const RangeSample> scan) {
  return subject.truth.determined() && subject.target->is_determined(T_sensor_target, scan);
}

}  // namespace lasso::bodies
