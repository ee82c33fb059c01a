// The answers of POST /api/mission/preview and /surface (docs/serve.md): what a text's mission looks like.
#pragma once

#include <string>

#include "mdat/serve/http.hpp"
#include "mdat/serve/live.hpp"

namespace lasso::mdat::serve {

// JSON of the text's scan preview, or a `problem` in one line. `scenario` empty: the first one.
std::string preview_json(const LiveMission& mission, const std::string& text, const std::string& scenario, std::size_t run);

// The target's surface as binary glTF. Throws Refusal (422).
Response mission_surface(const LiveMission& mission, const std::string& text);

}  // namespace lasso::mdat::serve
