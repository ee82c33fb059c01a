// Messages of the Foxglove WebSocket protocol, as far as a server needs them that tells of a run and lets viewers control its pace:
// foxglove.websocket.v1, and foxglove.sdk.v1, which has the same ones.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "mdat/recording/message_tap.hpp"

namespace lasso::mdat::serve {

// The one to speak of those that a client offers (Sec-WebSocket-Protocol); empty: none.
std::string live_subprotocol(std::string_view offered);

// When a run begins and ends, by the time of its messages.
struct PlaybackRange {
  std::uint64_t begin_ns, end_ns;
};

// Texts of JSON. A channel's number is that of its topic. `playback`: of a run that viewers may pause and pace.
std::string server_info_json(const std::string& name, const std::string& session, const std::optional<PlaybackRange>& playback = {});
std::string advertise_json(const std::vector<MessageTopic>& topics, const std::vector<std::size_t>& shown);
enum class StatusLevel : std::uint8_t { kInfo = 0, kWarning = 1, kError = 2 };
std::string status_json(StatusLevel level, const std::string& message);

// Binary.
std::string message_data(std::uint32_t subscription, std::uint64_t time_ns, std::string_view payload);
std::string time_data(std::uint64_t time_ns);
enum class PlaybackStatus : std::uint8_t { kPlaying = 0, kPaused = 1, kEnded = 3 };
struct PlaybackState {
  PlaybackStatus status;
  std::uint64_t time_ns;  // where the run is
  float speed;            // seconds of the run in one of the clock
};
// `request`: the one that it answers; empty: none. It never says that the run jumped.
std::string playback_state_data(const PlaybackState& state, std::string_view request);

// What a client asks for.
struct Subscription {
  std::uint32_t id, channel;
};
struct Subscribe {
  std::vector<Subscription> subscriptions;
};
struct Unsubscribe {
  std::vector<std::uint32_t> ids;
};
struct PlaybackRequest {
  bool play = false;
  float speed = 0;                       // any number, also none
  std::optional<std::uint64_t> seek_ns;  // where to go
  std::string id;
};
struct Misunderstood {
  std::string what;  // for the client
};
using ClientMessage = std::variant<Subscribe, Unsubscribe, PlaybackRequest, Misunderstood>;
// Throws nothing, whatever the bytes are.
ClientMessage client_message(std::string_view bytes, bool text);

}  // namespace lasso::mdat::serve
