#include "mdat/serve/http.hpp"

#include <nlohmann/json.hpp>

namespace lasso::mdat::serve {

Response error_response(unsigned status, const std::string& what, const std::string& remedy) {
  const nlohmann::ordered_json json = {{"error", what}, {"remedy", remedy}};
  Response response = json_response(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  response.status = status;
  return response;
}

std::size_t body_limit_of(const Request& head) {
  const std::string_view path = std::string_view(head.target).substr(0, head.target.find('?'));
  return head.method == Method::kPost && path == "/api/mission/new" ? kMaxMeshBytes : kMaxBodyBytes;
}

Response too_large_response(std::size_t limit_bytes) {
  const bool mesh = limit_bytes > kMaxBodyBytes;
  const std::string most = mesh ? std::to_string(limit_bytes >> 20) + " MB" : std::to_string(limit_bytes >> 10) + " kB";
  return error_response(413, "the body is too large", "send less than " + most);
}

Response json_response(std::string json) { return {200, "application/json", std::move(json), {}}; }

Response binary_response(std::string bytes) { return {200, "application/octet-stream", std::move(bytes), {}}; }

}  // namespace lasso::mdat::serve
