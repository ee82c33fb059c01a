#include "mdat/trial/flight_results.hpp"

#include <nlohmann/json.hpp>

#include "mdat/common/text.hpp"
#include "mdat/common/version.hpp"
#include "mdat/trial/trial_results.hpp"

namespace lasso::mdat {

std::string flights_text(const FlightTrialResult& result) {
  const std::string rendered = result.rendered.empty() ? "" : "\n" + pose_table("rendered pairs", result.lights, result.rendered);
  return rendered + "\n" + pose_table("fitted errors", result.lights, result.fitted) + "\n" +
         fitted_table(result.lights, result.rendered, result.fitted) + "\n";
}

std::string flights_json(const FlightTrialResult& result) {
  nlohmann::ordered_json json = {{"version", kVersion}, {"scenario", result.scenario}, {"frames", result.frames}};
  for (std::size_t light = 0; light < result.lights.size(); ++light)
    json["lights"][result.lights[light].name] = {{"rendered", pose_json(pose_figures(poses_in(result.rendered, light)))},
                                                 {"fitted", pose_json(pose_figures(poses_in(result.fitted, light)))}};
  json["rendered"] = pose_json(pose_figures(result.rendered));
  json["fitted"] = pose_json(pose_figures(result.fitted));
  return json.dump(2) + "\n";
}

std::string flights_csv(const FlightTrialResult& result) {
  return poses_csv(result.lights, result.rendered, result.fitted, "flight,draw,frame");
}

}  // namespace lasso::mdat
