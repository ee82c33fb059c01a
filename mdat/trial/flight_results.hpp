// What flights by rendered pairs and by fitted errors say on the terminal, side by side, and leave for programs.
#pragma once

#include <string>

#include "mdat/trial/flight_trial.hpp"

namespace lasso::mdat {

std::string flights_text(const FlightTrialResult& result);
std::string flights_json(const FlightTrialResult& result);
std::string flights_csv(const FlightTrialResult& result);  // a line for each frame

}  // namespace lasso::mdat
