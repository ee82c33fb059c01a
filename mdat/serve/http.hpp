// A request and its answer, as the handlers see them: no sockets.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lasso::mdat::serve {

constexpr std::size_t kMaxHeaderBytes = 8192;   // request line and headers
constexpr std::size_t kMaxBodyBytes = 1 << 16;  // of a request
constexpr std::size_t kMaxTextBytes = 1 << 22;  // of one with a mission's texts: two of the largest, as JSON writes them
constexpr std::size_t kMaxMeshBytes = 1 << 27;  // of a mesh that is sent: 500,000 triangles take some 125 MB as text
constexpr std::size_t kMaxTargetBytes = 4096;

enum class Method : std::uint8_t { kGet, kHead, kPost, kOther };

struct Request {
  Method method = Method::kGet;
  std::string target;                          // as it was sent: path and query
  std::map<std::string, std::string> headers;  // names in lower case; of one that is there twice, both, joined by ", "
  std::string body;

  // Empty where there is none.
  std::string_view header(const std::string& name) const {
    const auto found = headers.find(name);
    return found != headers.end() ? std::string_view(found->second) : std::string_view();
  }
};

// Bytes that the body of a request may have: kMaxMeshBytes of POST /api/mission/new, kMaxTextBytes of other posts below /api/mission,
// kMaxBodyBytes of all others.
std::size_t body_limit_of(const Request& head);

using Headers = std::vector<std::pair<std::string, std::string>>;

struct Response {
  unsigned status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string body;
  Headers headers;
};

// {"error": what, "remedy": what helps}
Response error_response(unsigned status, const std::string& what, const std::string& remedy);
// 413, with the size that was sent where it is known (0: it is not), and the limit.
Response too_large_response(std::size_t limit_bytes, std::uint64_t sent_bytes = 0);
Response json_response(std::string json);
Response binary_response(std::string bytes);

// What an answer ends with, instead of going on: thrown by handlers.
struct Refusal {
  unsigned status;
  std::string what, remedy;
};

}  // namespace lasso::mdat::serve
