// The lights in which single stereo pairs are tried.
#pragma once

#include <string>
#include <vector>

#include "mdat/missiondb/stereo_source.hpp"

namespace lasso::mdat {

struct TrialLight {
  std::string name;                // as --lights has it
  std::vector<double> sun, earth;  // directions in the sensor frame; of length 0: none
  double lamp_Wpsr = 0;
};

// Sun behind the cameras, over the shoulder, from the side with and without the Earth, before the cameras with and without it, and a lamp
// alone.
const std::vector<TrialLight>& trial_lights();

// The named ones in the order of trial_lights; all, where none is named. Throws InputError for a name that is none.
std::vector<TrialLight> chosen_lights(const std::vector<std::string>& names);

// The head in that light, whatever light the mission says.
StereoSource lit_by(const TrialLight& light, StereoSource source);

}  // namespace lasso::mdat
