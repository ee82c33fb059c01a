// The laws of what a campaign draws, in words.
#pragma once

#include <string>

#include "mdat/missiondb/campaign_source.hpp"

namespace lasso::mdat {

// "uniform, 2 to 7", "normal, mean 0, sigma 0.05, within -0.1 to 0.1".
std::string law_text(const Law& law);

}  // namespace lasso::mdat
