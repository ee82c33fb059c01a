#include "mdat/trial/trial_light.hpp"

#include <algorithm>

#include "mdat/common/errors.hpp"
#include "mdat/render/light.hpp"
#include "mdat/source/nearest.hpp"

namespace lasso::mdat {
const std::vector<TrialLight>& trial_lights() {
  static const std::vector<double> no_light = {0, 0, 0};
  static const std::vector<TrialLight> lights = {
      {"sun_behind", {0.3, -0.2, -0.93}, {0, 0.9, -0.43}, 0}, {"over_shoulder", {0.5, -0.5, -0.7}, {0, 1, 0}, 0},
      {"side_on", {0.98, 0, -0.17}, {-0.6, 0.8, 0}, 0},       {"side_on_no_earth", {0.98, 0, -0.17}, no_light, 0},
      {"backlit", {-0.16, -0.5, 0.85}, {0, 1, 0}, 0},         {"lamp", no_light, no_light, kLamp_Wpsr},
      {"backlit_no_earth", {-0.16, -0.5, 0.85}, no_light, 0}};
  return lights;
}

std::vector<TrialLight> chosen_lights(const std::vector<std::string>& names) {
  std::vector<TrialLight> chosen;
  std::vector<std::string> known;
  for (const TrialLight& light : trial_lights()) {
    known.push_back(light.name);
    if (names.empty() || std::find(names.begin(), names.end(), light.name) != names.end()) chosen.push_back(light);
  }
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    std::string all;
    for (const std::string& light : known) all += (all.empty() ? "" : ", ") + light;
    throw InputError("--lights " + name + ": expected one of " + all + did_you_mean(name, known));
  }
  return chosen;
}

StereoSource lit_by(const TrialLight& light, StereoSource source) {
  source.sun = light.sun;
  source.earth = light.earth;
  source.earthshine = 1;
  source.lamp_Wpsr = light.lamp_Wpsr;
  return source;
}

}  // namespace lasso::mdat
