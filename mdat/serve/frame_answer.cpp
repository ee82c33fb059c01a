#include <nlohmann/json.hpp>

#include "fsw/link/choices.hpp"
#include "mdat/run/case.hpp"
#include "mdat/serve/answers.hpp"
#include "mdat/serve/frame_facts.hpp"
#include "mdat/serve/iterations.hpp"

namespace lasso::mdat::serve {
namespace {

using Json = nlohmann::ordered_json;

Json pose_json(const Pose& pose) {
  return {{"position_m", {pose.p.x(), pose.p.y(), pose.p.z()}}, {"quaternion_xyzw", {pose.q.x(), pose.q.y(), pose.q.z(), pose.q.w()}}};
}

// T_world_sensor of /tf: where nothing says otherwise the sensor is the world.
Json world_of(const Recording& recording, std::size_t n) {
  const std::string bytes = recording.message(n, "/tf");
  for (const ros::FrameTransform& transform : read_transforms(bytes).value_or(std::vector<ros::FrameTransform>())) {
    if (transform.parent == "world" && transform.child == "sensor") return pose_json(transform.T_parent_child);
  }
  return pose_json(Pose{});
}

Json gates_json(const std::vector<ValidityGate>& gates) {
  Json list = Json::array();
  for (const ValidityGate& gate : gates) {
    list.push_back({{"name", gate.name},
                    {"value", gate.value},
                    {"limit", gate.limit},
                    {"kind", gate.at_least ? "at least" : "at most"},
                    {"unit", gate.unit},
                    {"pass", gate.pass}});
  }
  return list;
}

Json weak_json(const std::vector<WeakDirection>& weak) {
  Json list = Json::array();
  for (const WeakDirection& row : weak)
    list.push_back({{"direction", std::vector<double>(row.direction.begin(), row.direction.end())}, {"sigma", row.sigma_m}});
  return list;
}

template <std::size_t kCount>
std::string name_of(const Choice (&choices)[kCount], std::size_t at) {
  return at < kCount ? choices[at].name : std::to_string(at);
}

void put_scan(const PoseTelemetry& told, Json& json) {
  json["scan_id"] = told.scan_id;
  json["inliers"] = told.inliers;
  json["rays"] = told.rays;
  json["hits"] = told.returns;
  json["missed"] = told.rays - std::min(told.rays, told.returns);
  json["labels"] = told.labels;
  json["sensor"] = told.sensor;
  json["part"] = told.part;
}

void put_quality(const FrameFacts& facts, const LoadedImage* image, Json& json) {
  const std::vector<ValidityGate> gates =
      image != nullptr ? validity_gates(facts.told, image->mission().parameters) : std::vector<ValidityGate>();
  json["gates"] = gates_json(gates);
  json["stop"] = name_of(kStopReasons, facts.told.stop);
  json["iterations_used"] = facts.told.iterations;
  json["rms_mm"] = facts.registered ? Json(1e3 * static_cast<double>(facts.told.rms_m)) : Json();
  json["covariance"] = facts.registered && facts.covariance.allFinite() ? Json(ros::ros_covariance(facts.covariance)) : Json();
  json["weak"] = facts.registered && image != nullptr ? weak_json(weak_directions(facts.covariance, *image)) : Json::array();
  json["why"] = why_text(facts.told, gates);
}

Json error_json(const FrameFacts& facts) {
  if (!facts.registration) return nullptr;
  return {{"position_mm", 1e3 * facts.registration->translation_m.norm()},
          {"angle_deg", facts.registration->rotation_rad / kRadPerDeg},
          {"normalised_squared", facts.normalised_squared}};
}

Json iterations_json(const std::vector<RegistrationStep>& iterations) {
  if (iterations.empty()) return nullptr;
  Json list = Json::array();
  for (const RegistrationStep& row : iterations) {
    list.push_back({{"step_mm", 1e3 * row.step_m},
                    {"step_deg", row.step_rad / kRadPerDeg},
                    {"rms_mm", 1e3 * row.rms_m},
                    {"inliers", row.inliers},
                    {"pose", pose_json(row.T_sensor_target)}});
  }
  return list;
}

Json told_json(const Shown& shown, std::size_t n, const PoseTelemetry& told) {
  const FrameFacts facts(told, shown.recording->truth(n));
  Json json = {{"index", n},
               {"time_s", shown.recording->frames()[n].time_s},
               {"mode", name_of(kTrackingModes, told.mode)},
               {"valid", told.valid != 0},
               {"wrong", facts.wrong ? Json(*facts.wrong) : Json()},
               {"reason", name_of(kPoseReasons, told.reason)}};
  put_scan(told, json);
  put_quality(facts, shown.recording->image(), json);
  json["poses"] = {{"estimate", pose_json(registration_pose(told))},
                   {"filtered", pose_json(filtered_pose(told))},
                   {"truth", facts.truth ? pose_json(*facts.truth) : Json()}};
  json["T_world_sensor"] = world_of(*shown.recording, n);
  json["error"] = error_json(facts);
  json["iterations"] = iterations_json(iterations_of(*shown.recording, n));
  return json;
}

// Of a recording by another program: its time, and the pose that is told nearest to it.
Json bare_json(const Shown& shown, std::size_t n) {
  const std::optional<Pose> pose = shown.recording->other_pose(n);
  return {{"index", n},
          {"time_s", shown.recording->frames()[n].time_s},
          {"mode", nullptr},
          {"valid", nullptr},
          {"wrong", nullptr},
          {"reason", nullptr},
          {"gates", Json::array()},
          {"poses", {{"estimate", pose ? pose_json(*pose) : Json()}, {"filtered", nullptr}, {"truth", nullptr}}},
          {"T_world_sensor", world_of(*shown.recording, n)},
          {"covariance", nullptr},
          {"weak", Json::array()},
          {"error", nullptr},
          {"iterations", nullptr},
          {"why", "another program recorded this: nothing says how a pose was found"}};
}

}  // namespace

Response frame_answer(const Shown& shown, std::size_t n) {
  const std::optional<PoseTelemetry> told = shown.recording->told(n);
  const Json json = told ? told_json(shown, n, *told) : bare_json(shown, n);
  return json_response(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace lasso::mdat::serve
