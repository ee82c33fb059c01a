// HTTP/1.1 and WebSockets over TCP: one listener, a strand for each socket, limits on all that a client may take. The library behind it
// (Boost.Beast) is in network.cpp alone.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "mdat/serve/application.hpp"

namespace lasso::mdat::serve {

struct NetworkOptions {
  std::string host = "127.0.0.1";                // an address, or a name
  std::uint16_t port = 0;                        // 0: any that is free
  std::size_t sockets = 128;                     // at a time; who comes beyond is closed at once
  std::chrono::milliseconds header_time{10000};  // for a first request's headers and body
  std::chrono::milliseconds idle_time{60000};    // between requests
  std::chrono::milliseconds answer_time{60000};  // for an answer to be taken
  std::size_t waiting_frames = 8;                // of a WebSocket, before the oldest is dropped
  std::size_t waiting_events = 4096;             // before it is cut off
  std::size_t socket_message_bytes = 1 << 20;    // of a message from a client
};

class Network {
 public:
  // Binds and listens. Throws InputError where the address is in use, or is none of this machine.
  explicit Network(const NetworkOptions& options);
  ~Network();
  Network(const Network&) = delete;
  Network& operator=(const Network&) = delete;

  std::uint16_t port() const;
  // Serves until `stop`; answers that are being made are finished, and all threads are gone, when it returns.
  void serve(Application& application, const std::atomic<bool>& stop);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace lasso::mdat::serve
