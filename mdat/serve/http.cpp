#include "mdat/serve/http.hpp"

#include <nlohmann/json.hpp>

namespace lasso::mdat::serve {

Response error_response(unsigned status, const std::string& what, const std::string& remedy) {
  const nlohmann::ordered_json json = {{"error", what}, {"remedy", remedy}};
  Response response = json_response(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  response.status = status;
  return response;
}

Response json_response(std::string json) { return {200, "application/json", std::move(json), {}}; }

Response binary_response(std::string bytes) { return {200, "application/octet-stream", std::move(bytes), {}}; }

}  // namespace lasso::mdat::serve
