#include "mdat/serve/live_protocol.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "mdat/common/version.hpp"

namespace lasso::mdat::serve {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kSubprotocols[] = {"foxglove.sdk.v1", "foxglove.websocket.v1"};
constexpr char kMessageData = 1, kTime = 2;
constexpr std::size_t kMostAsked = 1000;  // subscriptions in a message

template <class Number>
void put_number(Number number, std::string& bytes) {
  for (std::size_t i = 0; i < sizeof number; ++i) bytes += static_cast<char>(number >> (8 * i) & 0xFF);
}

std::string dumped(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

bool is_number32(const Json& json) { return json.is_number_unsigned() && json.get<std::uint64_t>() <= 0xFFFFFFFFU; }

ClientMessage subscribe_of(const Json& message) {
  const auto list = message.find("subscriptions");
  if (list == message.end() || !list->is_array() || list->size() > kMostAsked)
    return Misunderstood{"subscribe: expected an array \"subscriptions\""};
  Subscribe asked;
  for (const Json& one : *list) {
    if (!one.is_object() || !one.contains("id") || !one.contains("channelId") || !is_number32(one["id"]) || !is_number32(one["channelId"]))
      return Misunderstood{"subscribe: expected numbers \"id\" and \"channelId\" in each subscription"};
    asked.subscriptions.push_back({one["id"].get<std::uint32_t>(), one["channelId"].get<std::uint32_t>()});
  }
  return asked;
}

ClientMessage unsubscribe_of(const Json& message) {
  const auto list = message.find("subscriptionIds");
  if (list == message.end() || !list->is_array() || list->size() > kMostAsked || !std::all_of(list->begin(), list->end(), is_number32))
    return Misunderstood{"unsubscribe: expected an array of numbers \"subscriptionIds\""};
  return Unsubscribe{list->get<std::vector<std::uint32_t>>()};
}

}  // namespace

std::string live_subprotocol(std::string_view offered) {
  for (const std::string_view known : kSubprotocols) {
    for (std::size_t at = 0; at < offered.size();) {
      const std::size_t end = std::min(offered.find(',', at), offered.size());
      std::string_view word = offered.substr(at, end - at);
      while (!word.empty() && word.front() == ' ') word.remove_prefix(1);
      while (!word.empty() && word.back() == ' ') word.remove_suffix(1);
      if (word == known) return std::string(known);
      at = end + 1;
    }
  }
  return "";
}

std::string server_info_json(const std::string& name, const std::string& session) {
  return dumped({{"op", "serverInfo"},
                 {"name", name},
                 {"capabilities", {"time"}},
                 {"metadata", {{"program", std::string("mdat ") + kVersion}}},
                 {"sessionId", session}});
}

std::string advertise_json(const std::vector<MessageTopic>& topics, const std::vector<std::size_t>& shown) {
  Json channels = Json::array();
  for (const std::size_t i : shown) {
    channels.push_back({{"id", i},
                        {"topic", topics[i].name},
                        {"encoding", "cdr"},
                        {"schemaName", topics[i].schema.name},
                        {"schema", topics[i].schema.text},
                        {"schemaEncoding", "ros2msg"}});
  }
  return dumped({{"op", "advertise"}, {"channels", channels}});
}

std::string status_json(StatusLevel level, const std::string& message) {
  return dumped({{"op", "status"}, {"level", static_cast<int>(level)}, {"message", message}});
}

std::string message_data(std::uint32_t subscription, std::uint64_t time_ns, std::string_view payload) {
  std::string bytes(1, kMessageData);
  bytes.reserve(13 + payload.size());
  put_number(subscription, bytes);
  put_number(time_ns, bytes);
  return bytes.append(payload);
}

std::string time_data(std::uint64_t time_ns) {
  std::string bytes(1, kTime);
  put_number(time_ns, bytes);
  return bytes;
}

ClientMessage client_message(std::string_view bytes, bool text) {
  if (!text) return Misunderstood{"this server only tells: it takes no binary messages"};
  const Json message = Json::parse(bytes, nullptr, false);
  if (!message.is_object() || !message.contains("op") || !message["op"].is_string())
    return Misunderstood{"expected a JSON object with \"op\""};
  const auto operation = message["op"].get<std::string>();
  if (operation == "subscribe") return subscribe_of(message);
  if (operation == "unsubscribe") return unsubscribe_of(message);
  return Misunderstood{"this server only tells: \"" + operation.substr(0, 40) + "\" is not served"};
}

}  // namespace lasso::mdat::serve
