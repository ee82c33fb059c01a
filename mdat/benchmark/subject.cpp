#include "mdat/benchmark/subject.hpp"

#include "mdat/common/output.hpp"
#include "mdat/missiondb/new_mission.hpp"
#include "mdat/missiondb/simplify.hpp"

namespace lasso::mdat {
namespace {

KnowableNoise noise_of(const MissionParameters& parameters) {
  return {parameters.sigma0_m, parameters.sigma_k_per_m, parameters.sigma_angle_rad, parameters.surface_sigma_m};
}

void write_mission(const SubjectRequest& request, const Subject& subject, ModelCache& cache) {
  NewMissionRequest mission;
  mission.out = request.mission;
  mission.model = request.model;
  mission.name = request.name;
  mission.sensor = request.sensor;
  mission.replace = true;
  mission.compile = [&](const Mesh& mesh, const ModelOptions& options, CompileReport& report) {
    return cache.compile(mesh, options, report);
  };
  if (request.model.extension() == ".stl") {
    write_file(request.model, stl_bytes(mesh_of(subject.body)));
  } else {
    mission.model_text = commented_model_text(subject.body, subject.truth);
  }
  (void)write_new_mission(mission);
}

}  // namespace

Subject make_subject(const SubjectRequest& request) {
  Subject subject;
  subject.body = make_body(request.seed);
  subject.truth = truth_of(subject.body);
  ModelCache cache = ModelCache::of_user_if(request.cached);
  write_mission(request, subject, cache);
  subject.mission = compile_mission(load_mission_input(request.mission, request.settings), cache);
  subject.noise = noise_of(subject.mission.source.parameters);
  subject.target = std::make_unique<KnowableTarget>(subject.mission.mesh, subject.mission.source.target.crease_angle_rad, subject.noise,
                                                    subject.truth.size_m);
  subject.nearest_m = scenario_of(subject.mission.source, "paper").ranges_m.front();
  return subject;
}

bool is_determined(const Subject& subject, const Pose& T_sensor_target, std::span<const RangeSample> scan) {
  return subject.truth.determined() && subject.target->is_determined(T_sensor_target, scan);
}

}  // namespace lasso::mdat
