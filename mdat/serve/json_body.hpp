// The JSON of a request's body. Inside of serve's answers.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "mdat/serve/http.hpp"

namespace lasso::mdat::serve {

// The body of a request. A page from elsewhere cannot send this type without asking first. Throws Refusal: 415 another type, 400 no object.
nlohmann::ordered_json json_body(const Request& request);

// A text of it. Throws Refusal (400).
std::string body_text(const nlohmann::ordered_json& body, const char* name);

}  // namespace lasso::mdat::serve
