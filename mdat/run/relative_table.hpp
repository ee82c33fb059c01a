// What a run says of poses between named frames: a table of all, figures of each.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "mdat/run/relative_poses.hpp"

namespace lasso::mdat {

// One row for each pose; columns as in docs/scenes.md. What is not known is an empty cell.
std::string relative_csv(const std::vector<RelativeRun>& runs);

nlohmann::ordered_json relative_json(const std::vector<RelativeRun>& runs);  // by name
std::string relative_text(const std::vector<RelativeRun>& runs);             // a line each

}  // namespace lasso::mdat
