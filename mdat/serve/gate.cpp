#include "mdat/serve/gate.hpp"

#include <arpa/inet.h>
#include <sys/random.h>

#include <array>

#include "mdat/common/errors.hpp"

namespace lasso::mdat::serve {
namespace {

constexpr std::size_t kTokenBytes = 16;

bool is_address(const std::string& host) {
  std::array<unsigned char, sizeof(in6_addr)> bytes{};
  if (host.size() > 2 && host.front() == '[' && host.back() == ']')
    return inet_pton(AF_INET6, host.substr(1, host.size() - 2).c_str(), bytes.data()) == 1;
  return inet_pton(AF_INET, host.c_str(), bytes.data()) == 1;
}

// Of a header "a=1; b=2".
std::string_view cookie_in(std::string_view header, std::string_view name) {
  while (!header.empty()) {
    std::string_view pair = header.substr(0, header.find(';'));
    header.remove_prefix(std::min(pair.size() + 1, header.size()));
    pair.remove_prefix(std::min(pair.find_first_not_of(' '), pair.size()));
    const std::size_t equals = pair.find('=');
    if (equals != std::string_view::npos && pair.substr(0, equals) == name) return pair.substr(equals + 1);
  }
  return {};
}

}  // namespace

std::string random_token() {
  std::array<unsigned char, kTokenBytes> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw RunError("the system gives no random numbers, and without a token nobody is served");
  std::string token;
  for (const unsigned char byte : bytes) {
    token += "0123456789abcdef"[byte >> 4];
    token += "0123456789abcdef"[byte & 15];
  }
  return token;
}

Gate::Gate(std::string host, std::uint16_t port, std::string token)
    : host_(std::move(host)), port_(std::to_string(port)), token_(std::move(token)) {}

// Loopback's names, the one that was given, and addresses in numbers, which no foreign name server can give out.
bool Gate::is_own_host(std::string_view header) const {
  const std::string suffix = ":" + port_;
  if (header.size() <= suffix.size() || header.substr(header.size() - suffix.size()) != suffix) return false;
  const std::string host(header.substr(0, header.size() - suffix.size()));
  return host == "localhost" || host == host_ || is_address(host);
}

std::optional<Response> Gate::refuse(const Request& request) const {
  if (request.target.size() > kMaxTargetBytes) return error_response(414, "the address is too long", "ask for less at a time");
  if (const std::size_t limit = body_limit_of(request); request.body.size() > limit) return too_large_response(limit, request.body.size());
  if (!request.header("transfer-encoding").empty())
    return error_response(501, "Transfer-Encoding is not taken", "send the body with its Content-Length");
  if (!is_own_host(request.header("host")))
    return error_response(421, "the Host is none of this server's", "use the address that mdat serve printed");
  const std::string_view origin = request.header("origin");
  if (!origin.empty() && origin != "http://" + std::string(request.header("host")))
    return error_response(403, "the request is from another page", "use the address that mdat serve printed");
  return std::nullopt;
}

bool Gate::is_token(std::string_view text) const {
  unsigned difference = text.size() != token_.size() ? 1 : 0;
  for (std::size_t i = 0; i < token_.size(); ++i) {
    const char c = i < text.size() ? text[i] : '\0';
    difference |= static_cast<unsigned>(static_cast<unsigned char>(c ^ token_[i]));
  }
  return difference == 0;
}

bool Gate::knows(const Request& request) const {
  constexpr std::string_view kBearer = "Bearer ";
  const std::string_view authorization = request.header("authorization");
  if (authorization.substr(0, kBearer.size()) == kBearer && is_token(authorization.substr(kBearer.size()))) return true;
  return is_token(cookie_in(request.header("cookie"), kCookie + port_));
}

Response Gate::welcome() const {
  Response response;
  response.status = 303;
  response.headers = {{"Location", "/"}, {"Set-Cookie", kCookie + port_ + "=" + token_ + "; Path=/; HttpOnly; SameSite=Strict"}};
  return response;
}

std::string Gate::address() const {
  const bool v6 = host_.find(':') != std::string::npos && host_.front() != '[';
  return "http://" + (v6 ? "[" + host_ + "]" : host_) + ":" + port_ + "/?token=" + token_;
}

Headers safety_headers() {
  return {
      {"Content-Security-Policy",
       "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self' blob:; font-src 'self'; "
       "worker-src 'self' blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
      {"X-Content-Type-Options", "nosniff"},
      {"X-Frame-Options", "DENY"},
      {"Referrer-Policy", "no-referrer"},
      {"Cross-Origin-Resource-Policy", "same-origin"},
      {"Cross-Origin-Opener-Policy", "same-origin"},
      {"Cache-Control", "no-store"}};
}

}  // namespace lasso::mdat::serve
