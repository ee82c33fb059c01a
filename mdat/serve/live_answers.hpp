// The answers about what is live (docs/serve.md), below /api/live.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "mdat/serve/live.hpp"
#include "mdat/serve/target.hpp"

namespace lasso::mdat::serve {

// What is asked for begins with /api/live. Throws Refusal.
Response live_answer(Live& live, const Request& request, const Target& target);

// The body of a command. Throws Refusal (400).
CommandOrder command_order(const nlohmann::ordered_json& body);

// The socket of /api/live/socket: it gets each state, and what it says is not heard.
SocketOpening live_opening(Live& live);

}  // namespace lasso::mdat::serve
