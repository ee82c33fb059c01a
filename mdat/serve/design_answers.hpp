// The answers below /api/mission (docs/serve.md).
#pragma once

#include "mdat/serve/design.hpp"
#include "mdat/serve/http.hpp"
#include "mdat/serve/target.hpp"

namespace lasso::mdat::serve {

// What only asks, though its text is sent as a POST's body, is answered as well. Throws Refusal.
Response design_answer(Design& design, const Request& request, const Target& target);

}  // namespace lasso::mdat::serve
