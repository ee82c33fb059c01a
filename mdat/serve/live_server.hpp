// A run's messages, live, for viewers that speak the Foxglove WebSocket protocol: the same messages as a recording's. Viewers may
// control its pace where it has no clock of its own; nothing else.
#pragma once

#include <atomic>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "mdat/recording/message_tap.hpp"
#include "mdat/serve/application.hpp"
#include "mdat/serve/live_protocol.hpp"
#include "mdat/serve/network.hpp"
#include "mdat/serve/playback.hpp"

namespace lasso::mdat::serve {

constexpr std::size_t kKeptEvents = 1000;

// Who listens, and what was said. Safe for several threads; the run's thread never waits for a client.
class LiveHub final : public Application, public MessageTap {
 public:
  // `host`: what the server listens on, as the user named it. `run`: what is told, for the viewer's title. `playback`: how viewers control
  // it, and outlives this; null: they cannot.
  LiveHub(std::string host, std::string run, Playback* playback = nullptr);

  // Messages of /events and /scene are events to a socket (SocketSender), all others are frames. The scene, which is told once, and the
  // last kKeptEvents are kept for who comes later. What only replay needs (/sensor_scans) is not told.
  void on_message(std::size_t topic, std::uint64_t time_ns, std::string_view bytes) override;

  // That a WebSocket is wanted.
  Response answer(const Request& request) override;
  // Refused: another Host than this server's, an Origin of a page from elsewhere, no known subprotocol.
  SocketOpening open(const Request& request) override;

  // To everybody who listens, an event.
  void say(const std::string& message);
  // The run is over: says so.
  void end(const std::string& message);
  std::size_t clients() const;

 private:
  struct Client;
  class Session;
  struct Kept {
    std::uint64_t time_ns;
    std::string bytes;
  };
  std::optional<Response> refuse(const Request& request) const;
  void subscribe(Client& client, const std::vector<Subscription>& asked);
  void unsubscribe(Client& client, const std::vector<std::uint32_t>& ids);
  void control(const Client& client, const PlaybackRequest& request);
  void tell_playback(const Client* asked, const std::string& request);  // under the lock
  void leave();
  std::vector<std::shared_ptr<Client>> listening() const;

  const std::string host_, run_, session_;
  Playback* const playback_;
  const std::vector<MessageTopic> topics_;
  mutable std::mutex mutex_;
  std::vector<std::weak_ptr<Client>> clients_;
  std::map<std::size_t, std::deque<Kept>> kept_;  // by topic, the oldest first
  std::uint64_t told_ns_ = 0;                     // the time that clients know
  std::atomic<int> sessions_{0};
};

// The hub behind a port, for as long as it lives.
class LiveServer {
 public:
  // `playback` as for LiveHub. Throws InputError as Network.
  LiveServer(const NetworkOptions& options, const std::string& run, Playback* playback = nullptr);
  ~LiveServer();
  LiveServer(const LiveServer&) = delete;
  LiveServer& operator=(const LiveServer&) = delete;

  MessageTap& tap() { return hub_; }
  std::string address() const;
  // The run is over: says so, and gives who listens the time to take what is on its way.
  void end(const std::string& message);

 private:
  LiveHub hub_;
  Network network_;
  std::string host_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

// HOST:PORT, HOST or PORT, in place of what `options` have. Throws InputError.
void read_address(const std::string& text, NetworkOptions& options);

}  // namespace lasso::mdat::serve
