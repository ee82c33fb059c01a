#include "mdat/serve/gate.hpp"

#include <gtest/gtest.h>

#include <set>

#include "ut/support/verifies.hpp"

namespace lasso::mdat::serve {
namespace {

constexpr char kToken[] = "00112233445566778899aabbccddeeff";

Request from(const std::string& host, const std::string& origin = "") {
  Request request;
  request.target = "/";
  request.headers["host"] = host;
  if (!origin.empty()) request.headers["origin"] = origin;
  return request;
}

unsigned status_of(const Gate& gate, const Request& request) {
  const std::optional<Response> refusal = gate.refuse(request);
  return refusal ? refusal->status : 200;
}

TEST(Gate, OnlyTheServersOwnNamesAreTaken) {
  VERIFIES("LASSO-WEB-002~1");
  const Gate gate("bench.example", 8080, kToken);
  for (const char* host : {"localhost:8080", "127.0.0.1:8080", "[::1]:8080", "10.1.2.3:8080", "bench.example:8080"})
    EXPECT_EQ(status_of(gate, from(host)), 200U) << host;
  for (const char* host : {"", "localhost", "localhost:80", "localhost:8080x", "evil.example:8080", "127.0.0.1.evil.example:8080", ":8080",
                           "[::1:8080", "1.2.3:8080", "localhost:8080, evil.example:8080"})
    EXPECT_EQ(status_of(gate, from(host)), 421U) << host;
}

TEST(Gate, RequestsOfOtherPagesAreRefused) {
  VERIFIES("LASSO-WEB-002~1");
  const Gate gate("127.0.0.1", 8080, kToken);
  EXPECT_EQ(status_of(gate, from("127.0.0.1:8080", "http://127.0.0.1:8080")), 200U);
  for (const char* origin :
       {"null", "http://evil.example", "https://127.0.0.1:8080", "http://127.0.0.1:8081", "http://localhost:8080", "file://"})
    EXPECT_EQ(status_of(gate, from("127.0.0.1:8080", origin)), 403U) << origin;
}

TEST(Gate, OversizeAndTransferEncodingAreRefused) {
  VERIFIES("LASSO-WEB-004~1");
  const Gate gate("127.0.0.1", 8080, kToken);
  Request request = from("127.0.0.1:8080");
  request.body = std::string(kMaxBodyBytes + 1, 'x');
  EXPECT_EQ(status_of(gate, request), 413U);
  request.body.clear();
  request.headers["transfer-encoding"] = "chunked";
  EXPECT_EQ(status_of(gate, request), 501U);
  request.headers.erase("transfer-encoding");
  request.target = "/" + std::string(kMaxTargetBytes, 'a');
  EXPECT_EQ(status_of(gate, request), 414U);
}

TEST(Gate, OnlyTheTokenOpens) {
  VERIFIES("LASSO-WEB-001~1");
  const Gate gate("127.0.0.1", 8080, kToken);
  Request request = from("127.0.0.1:8080");
  EXPECT_FALSE(gate.knows(request));
  for (const std::string& cookie : {std::string("lasso8080=") + kToken, std::string("a=b; lasso8080=") + kToken + "; c=d"}) {
    request.headers["cookie"] = cookie;
    EXPECT_TRUE(gate.knows(request)) << cookie;
  }
  const std::string part(kToken, 31);
  for (const std::string& cookie :
       {std::string("lasso=") + kToken, "lasso8080=" + part, "lasso8080=" + part + "e", std::string("lasso8080=") + kToken + "0",
        std::string("lasso8080="), std::string("xlasso8080=") + kToken, std::string(kToken), std::string(";;;=;lasso8080")}) {
    request.headers["cookie"] = cookie;
    EXPECT_FALSE(gate.knows(request)) << cookie;
  }
  request.headers.erase("cookie");
  request.headers["authorization"] = std::string("Bearer ") + kToken;
  EXPECT_TRUE(gate.knows(request));
  request.headers["authorization"] = std::string("Basic ") + kToken;
  EXPECT_FALSE(gate.knows(request));
}

TEST(Gate, TheCookieStaysWithThisServersPages) {
  VERIFIES("LASSO-WEB-001~1");
  const Gate gate("::1", 8080, kToken);
  const Response welcome = gate.welcome();
  EXPECT_EQ(welcome.status, 303U);
  EXPECT_EQ(welcome.headers[0], (std::pair<std::string, std::string>{"Location", "/"}));
  EXPECT_EQ(welcome.headers[1].second, std::string("lasso8080=") + kToken + "; Path=/; HttpOnly; SameSite=Strict");
  EXPECT_EQ(gate.address(), std::string("http://[::1]:8080/?token=") + kToken);
}

TEST(Gate, TokensAreDrawnAnew) {
  VERIFIES("LASSO-WEB-001~1");
  std::set<std::string> tokens;
  for (int i = 0; i < 100; ++i) tokens.insert(random_token());
  EXPECT_EQ(tokens.size(), 100U);
  for (const std::string& token : tokens) EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_EQ(tokens.begin()->size(), 32U);
}

TEST(Gate, NothingIsLoadedFromElsewhereOrInline) {
  VERIFIES("LASSO-WEB-006~1");
  std::map<std::string, std::string> headers;
  for (const auto& [name, value] : safety_headers()) headers[name] = value;
  const std::string policy = headers.at("Content-Security-Policy");
  EXPECT_EQ(policy.rfind("default-src 'none'", 0), 0U);
  EXPECT_EQ(policy.find("unsafe"), std::string::npos);
  EXPECT_EQ(policy.find("http"), std::string::npos);
  EXPECT_EQ(policy.find('*'), std::string::npos);
  EXPECT_EQ(headers.at("X-Content-Type-Options"), "nosniff");
}

}  // namespace
}  // namespace lasso::mdat::serve
