#include "mdat/serve/live_protocol.hpp"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "mdat/common/version.hpp"

namespace lasso::mdat::serve {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kSubprotocols[] = {"foxglove.sdk.v1", "foxglove.websocket.v1"};
constexpr char kMessageData = 1, kTime = 2, kPlaybackState = 5;  // of the server
constexpr char kPlaybackControl = 3;                             // of a client
constexpr std::size_t kControlHead = 19;                         // bytes: kind, command, speed, whether to seek, where to, the id's length
constexpr std::size_t kLongestId = 200;
constexpr std::uint64_t kSecond_ns = 1'000'000'000;
constexpr std::size_t kMostAsked = 1000;  // subscriptions in a message

template <class Number>
void put_number(Number number, std::string& bytes) {
  for (std::size_t i = 0; i < sizeof number; ++i) bytes += static_cast<char>(number >> (8 * i) & 0xFF);
}

// Little endian; the bytes are there.
template <class Number>
Number number_at(std::string_view bytes, std::size_t at) {
  Number number = 0;
  for (std::size_t i = 0; i < sizeof number; ++i)
    number |= static_cast<Number>(static_cast<Number>(static_cast<unsigned char>(bytes[at + i])) << (8 * i));
  return number;
}

std::uint32_t bits_of(float number) {
  std::uint32_t bits = 0;
  static_assert(sizeof bits == sizeof number);
  std::memcpy(&bits, &number, sizeof bits);
  return bits;
}

float float_of(std::uint32_t bits) {
  float number = 0;
  std::memcpy(&number, &bits, sizeof number);
  return number;
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

ClientMessage control_of(std::string_view bytes) {
  if (bytes.size() < kControlHead)
    return Misunderstood{"playback control: " + std::to_string(bytes.size()) + " bytes, expected " + std::to_string(kControlHead) +
                         " or more"};
  const auto command = number_at<std::uint8_t>(bytes, 1);
  const auto length = number_at<std::uint32_t>(bytes, kControlHead - 4);
  if (command > 1) return Misunderstood{"playback control: command " + std::to_string(command) + ", expected 0 (play) or 1 (pause)"};
  if (length > kLongestId || length > bytes.size() - kControlHead)
    return Misunderstood{"playback control: an id of " + std::to_string(length) + " bytes, which are not there or too many"};
  PlaybackRequest request;
  request.play = command == 0;
  request.speed = float_of(number_at<std::uint32_t>(bytes, 2));
  if (number_at<std::uint8_t>(bytes, 6) != 0) request.seek_ns = number_at<std::uint64_t>(bytes, 7);
  request.id = bytes.substr(kControlHead, length);
  return request;
}

Json timestamp(std::uint64_t time_ns) { return {{"sec", time_ns / kSecond_ns}, {"nsec", time_ns % kSecond_ns}}; }

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

std::string server_info_json(const std::string& name, const std::string& session, const std::optional<PlaybackRange>& playback) {
  Json info = {{"op", "serverInfo"},
               {"name", name},
               {"capabilities", {"time"}},
               {"metadata", {{"program", std::string("mdat ") + kVersion}}},
               {"sessionId", session}};
  if (!playback) return dumped(info);
  info["capabilities"].push_back("playbackControl");
  info["dataStartTime"] = timestamp(playback->begin_ns);
  info["dataEndTime"] = timestamp(playback->end_ns);
  return dumped(info);
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

std::string playback_state_data(const PlaybackState& state, std::string_view request) {
  std::string bytes(1, kPlaybackState);
  bytes += static_cast<char>(state.status);
  put_number(state.time_ns, bytes);
  put_number(bits_of(state.speed), bytes);
  bytes += '\0';
  put_number(static_cast<std::uint32_t>(request.size()), bytes);
  return bytes.append(request);
}

ClientMessage client_message(std::string_view bytes, bool text) {
  if (!text && !bytes.empty() && bytes.front() == kPlaybackControl) return control_of(bytes);
  if (!text) return Misunderstood{"this server takes no binary messages but playback control"};
  const Json message = Json::parse(bytes, nullptr, false);
  if (!message.is_object() || !message.contains("op") || !message["op"].is_string())
    return Misunderstood{"expected a JSON object with \"op\""};
  const auto operation = message["op"].get<std::string>();
  if (operation == "subscribe") return subscribe_of(message);
  if (operation == "unsubscribe") return unsubscribe_of(message);
  return Misunderstood{"this server only tells: \"" + operation.substr(0, 40) + "\" is not served"};
}

}  // namespace lasso::mdat::serve
