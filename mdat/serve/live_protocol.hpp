// Messages of the Foxglove WebSocket protocol, as far as a server that only tells needs them: foxglove.websocket.v1, and
// foxglove.sdk.v1, which has the same ones.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "mdat/recording/message_tap.hpp"

namespace lasso::mdat::serve {

// The one to speak of those that a client offers (Sec-WebSocket-Protocol); empty: none.
std::string live_subprotocol(std::string_view offered);

// Texts of JSON. A channel's number is that of its topic.
std::string server_info_json(const std::string& name, const std::string& session);
std::string advertise_json(const std::vector<MessageTopic>& topics, const std::vector<std::size_t>& shown);
enum class StatusLevel : std::uint8_t { kInfo = 0, kWarning = 1, kError = 2 };
std::string status_json(StatusLevel level, const std::string& message);

// Binary.
std::string message_data(std::uint32_t subscription, std::uint64_t time_ns, std::string_view payload);
std::string time_data(std::uint64_t time_ns);

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
struct Misunderstood {
  std::string what;  // for the client
};
using ClientMessage = std::variant<Subscribe, Unsubscribe, Misunderstood>;
// Throws nothing, whatever the bytes are.
ClientMessage client_message(std::string_view bytes, bool text);

}  // namespace lasso::mdat::serve
