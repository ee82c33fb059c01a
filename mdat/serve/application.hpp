// What a server serves, as the network sees it: an answer to each request, and what talks over a WebSocket.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "mdat/serve/http.hpp"

namespace lasso::mdat::serve {

// Where a socket's messages go. Calls from any thread; none waits.
class SocketSender {
 public:
  virtual ~SocketSender() = default;
  // A message that may be lost: where the peer is slow, the oldest of these that wait are dropped.
  virtual void send_frame(std::string bytes, bool text) = 0;
  // A message that is never dropped: a peer that lets too many wait is cut off.
  virtual void send_event(std::string bytes, bool text) = 0;
  virtual void close() = 0;
};

// One open WebSocket. Calls come one at a time; the last one is the destructor, after the socket has closed.
class SocketSession {
 public:
  virtual ~SocketSession() = default;
  virtual void on_message(std::string_view bytes, bool text) = 0;
};

struct SocketOpening {
  std::string subprotocol;  // that is chosen; empty: none was offered
  // Makes the session, once the socket is open for messages; empty: refused, with `refusal`.
  std::function<std::unique_ptr<SocketSession>(const std::shared_ptr<SocketSender>&)> begin;
  std::optional<Response> refusal;
};

// Safe for several threads.
class Application {
 public:
  virtual ~Application() = default;
  // Throws nothing.
  virtual Response answer(const Request& request) = 0;
  // Bytes that this request's body may have, at most kMaxMeshBytes; asked before the body is read. Throws nothing.
  virtual std::size_t body_limit(const Request& /*head*/) { return kMaxBodyBytes; }
  // A request for a WebSocket: the same checks, then who talks. Throws nothing.
  virtual SocketOpening open(const Request& request) = 0;
};

}  // namespace lasso::mdat::serve
