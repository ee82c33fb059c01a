// The answers about what is live (docs/serve.md), below /api/live.
#pragma once

#include <string>

#include "mdat/serve/live.hpp"
#include "mdat/serve/target.hpp"

namespace lasso::mdat::serve {

// What is asked for begins with /api/live. Throws Refusal.
Response live_answer(Live& live, const Request& request, const Target& target);

// The socket of /api/live/socket: it gets each state, and what it says is not heard.
SocketOpening live_opening(Live& live);

}  // namespace lasso::mdat::serve
