// The parts of a report that only scenes have.
#pragma once

#include <string>
#include <vector>

#include "mdat/run/simulation.hpp"

namespace lasso::mdat {

// What the sensors saw, where the caller has pictures of it.
struct SeenPicture {
  std::string caption, png;  // the picture's bytes
};

// Empty where there are none.
std::string seen_section(const std::vector<SeenPicture>& pictures);
std::string relative_section(const SimulationResult& result);  // figures of [relative.NAME]

}  // namespace lasso::mdat
