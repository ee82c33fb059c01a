// Who may ask: one who has the token of the printed address, from this page, by an address of this server.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "mdat/serve/http.hpp"
#include "mdat/serve/target.hpp"

namespace lasso::mdat::serve {

constexpr char kCookie[] = "lasso";  // and the port: servers of one machine share their cookies

// 128 bits of the system's random numbers, in hexadecimal digits.
std::string random_token();

class Gate {
 public:
  // `host`: what the server listens on, as the user named it; `port` that it got.
  Gate(std::string host, std::uint16_t port, std::string token);

  // What is wrong with the request, if anything: its size, its Host (another name would let a page of elsewhere in, by a name that it
  // controls), its Origin, a Transfer-Encoding.
  std::optional<Response> refuse(const Request& request) const;
  // Whether it has the token: in the cookie, or, for programs, as "Authorization: Bearer TOKEN".
  bool knows(const Request& request) const;
  // Whether `text` is the token; takes the same time whatever it is.
  bool is_token(std::string_view text) const;
  // The answer to GET /?token=T: the cookie, and the way to the page.
  Response welcome() const;

  std::string address() const;  // of the page, with the token

 private:
  bool is_own_host(std::string_view host) const;
  std::string host_, port_, token_;
};

// Headers that every answer has: nobody frames it, takes it for another type, keeps it, or lets it load anything from elsewhere.
Headers safety_headers();

}  // namespace lasso::mdat::serve
