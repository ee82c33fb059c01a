#include "mdat/serve/json_body.hpp"

namespace lasso::mdat::serve {

nlohmann::ordered_json json_body(const Request& request) {
  if (request.header("content-type").rfind("application/json", 0) != 0)
    throw Refusal{415, "the body has another type", "send JSON, as Content-Type: application/json"};
  nlohmann::ordered_json body = nlohmann::ordered_json::parse(request.body, nullptr, false);
  if (!body.is_object()) throw Refusal{400, "the body is no object of JSON", "see docs/serve.md"};
  return body;
}

std::string body_text(const nlohmann::ordered_json& body, const char* name) {
  const auto found = body.find(name);
  if (found == body.end() || !found->is_string()) throw Refusal{400, std::string(name) + ": a text was expected", "see docs/serve.md"};
  return found->get<std::string>();
}

}  // namespace lasso::mdat::serve
