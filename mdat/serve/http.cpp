#include "mdat/serve/http.hpp"

#include <nlohmann/json.hpp>

namespace lasso::mdat::serve {
namespace {

constexpr std::string_view kMissionPath = "/api/mission/";

std::string size_text(std::uint64_t bytes) {
  constexpr std::uint64_t kMega = 1 << 20;
  return bytes >= kMega ? std::to_string((bytes + kMega - 1) >> 20) + " MB" : std::to_string((bytes + 1023) >> 10) + " kB";
}

}  // namespace

Response error_response(unsigned status, const std::string& what, const std::string& remedy) {
  const nlohmann::ordered_json json = {{"error", what}, {"remedy", remedy}};
  Response response = json_response(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  response.status = status;
  return response;
}

std::size_t body_limit_of(const Request& head) {
  const std::string_view path = std::string_view(head.target).substr(0, head.target.find('?'));
  if (head.method != Method::kPost || path.substr(0, kMissionPath.size()) != kMissionPath) return kMaxBodyBytes;
  return path == "/api/mission/new" ? kMaxMeshBytes : kMaxTextBytes;
}

Response too_large_response(std::size_t limit_bytes, std::uint64_t sent_bytes) {
  const std::string sent = sent_bytes == 0 ? "" : ": " + size_text(sent_bytes);
  const std::string what = limit_bytes == kMaxTextBytes ? "; a mission's text has at most 1 MB" : "";
  return error_response(413, "the body is too large" + sent, "send at most " + size_text(limit_bytes) + what);
}

Response json_response(std::string json) { return {200, "application/json", std::move(json), {}}; }

Response binary_response(std::string bytes) { return {200, "application/octet-stream", std::move(bytes), {}}; }

}  // namespace lasso::mdat::serve
