#include "mdat/serve/live_protocol.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "ut/support/verifies.hpp"

namespace lasso::mdat::serve {
namespace {

std::string what_is_wrong(const std::string& text) {
  const ClientMessage message = client_message(text, true);
  const auto* wrong = std::get_if<Misunderstood>(&message);
  return wrong == nullptr ? "" : wrong->what;
}

TEST(LiveProtocol, TakesTheNewerOfTheSubprotocolsThatItKnows) {
  VERIFIES("LASSO-REC-040~1");
  EXPECT_EQ(live_subprotocol("foxglove.websocket.v1"), "foxglove.websocket.v1");
  EXPECT_EQ(live_subprotocol("foxglove.websocket.v1, foxglove.sdk.v1 "), "foxglove.sdk.v1");
  EXPECT_EQ(live_subprotocol("foxglove.websocket.v11,x"), "");
  EXPECT_EQ(live_subprotocol(""), "");
}

TEST(LiveProtocol, ChannelsAreTheTopicsThatAreShown) {
  VERIFIES("LASSO-REC-040~1");
  const std::vector<MessageTopic> topics = {{"/a", {"p/msg/A", "float64 x\n"}}, {"/b", {"p/msg/B", "string \"s\"\n"}}};
  const auto json = nlohmann::json::parse(advertise_json(topics, {1}));
  EXPECT_EQ(json.at("op"), "advertise");
  ASSERT_EQ(json.at("channels").size(), 1U);
  const auto& channel = json.at("channels").at(0);
  EXPECT_EQ(channel.at("id"), 1);
  EXPECT_EQ(channel.at("topic"), "/b");
  EXPECT_EQ(channel.at("encoding"), "cdr");
  EXPECT_EQ(channel.at("schemaName"), "p/msg/B");
  EXPECT_EQ(channel.at("schema"), "string \"s\"\n");
  EXPECT_EQ(channel.at("schemaEncoding"), "ros2msg");
  EXPECT_EQ(nlohmann::json::parse(server_info_json("run", "7")).at("capabilities").at(0), "time");
  EXPECT_EQ(nlohmann::json::parse(status_json(StatusLevel::kError, "no\x80")).at("level"), 2);
}

// Byte by byte as the specification has it, little endian.
TEST(LiveProtocol, MessagesHaveTheirHeads) {
  VERIFIES("LASSO-REC-040~1");
  EXPECT_EQ(message_data(0x01020304, 0x1122334455667788, "xy"), "\x01\x04\x03\x02\x01\x88\x77\x66\x55\x44\x33\x22\x11xy");
  EXPECT_EQ(time_data(0x1122334455667788), "\x02\x88\x77\x66\x55\x44\x33\x22\x11");
}

TEST(LiveProtocol, ReadsWhatClientsAskFor) {
  VERIFIES("LASSO-REC-040~1");
  const ClientMessage asked =
      client_message(R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":3},{"id":4294967295,"channelId":1}]})", true);
  const auto* subscribe = std::get_if<Subscribe>(&asked);
  ASSERT_NE(subscribe, nullptr);
  ASSERT_EQ(subscribe->subscriptions.size(), 2U);
  EXPECT_EQ(subscribe->subscriptions[1].id, 4294967295U);
  EXPECT_EQ(subscribe->subscriptions[1].channel, 1U);
  const ClientMessage ended = client_message(R"({"op":"unsubscribe","subscriptionIds":[4,5]})", true);
  const auto* unsubscribe = std::get_if<Unsubscribe>(&ended);
  ASSERT_NE(unsubscribe, nullptr);
  EXPECT_EQ(unsubscribe->ids, (std::vector<std::uint32_t>{4, 5}));
}

TEST(LiveProtocol, SaysWhatItDoesNotTake) {
  VERIFIES("LASSO-REC-041~1");
  EXPECT_EQ(what_is_wrong("{"), "expected a JSON object with \"op\"");
  EXPECT_EQ(what_is_wrong("[1]"), "expected a JSON object with \"op\"");
  EXPECT_EQ(what_is_wrong(R"({"op":7})"), "expected a JSON object with \"op\"");
  EXPECT_EQ(what_is_wrong(R"({"op":"advertise"})"), "this server only tells: \"advertise\" is not served");
  EXPECT_NE(what_is_wrong(R"({"op":"subscribe"})"), "");
  EXPECT_NE(what_is_wrong(R"({"op":"subscribe","subscriptions":[7]})"), "");
  EXPECT_NE(what_is_wrong(R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":1}]})"), "");
  EXPECT_NE(what_is_wrong(R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":4294967296}]})"), "");
  EXPECT_NE(what_is_wrong(R"({"op":"unsubscribe","subscriptionIds":["a"]})"), "");
  EXPECT_NE(what_is_wrong(std::string(100000, '[')), "") << "as deep as the bytes go";
  EXPECT_TRUE(std::holds_alternative<Misunderstood>(client_message("\x01", false)));
}

// As the specification has it: kind, command, speed, whether to seek, where to, the id's length, the id.
const std::string kStepRequest("\x03\x01\x00\x00\x20\x40\x01\x88\x77\x66\x55\x44\x33\x22\x11\x02\x00\x00\x00id", 21);

TEST(LiveProtocol, ReadsPlaybackControl) {
  VERIFIES("LASSO-REC-042~1");
  const ClientMessage message = client_message(kStepRequest, false);
  const auto* request = std::get_if<PlaybackRequest>(&message);
  ASSERT_NE(request, nullptr);
  EXPECT_FALSE(request->play);
  EXPECT_EQ(request->speed, 2.5F);
  EXPECT_EQ(request->seek_ns, 0x1122334455667788U);
  EXPECT_EQ(request->id, "id");
  std::string play = kStepRequest;
  play[1] = play[6] = '\0';
  const ClientMessage playing = client_message(play, false);
  ASSERT_NE(std::get_if<PlaybackRequest>(&playing), nullptr);
  EXPECT_TRUE(std::get<PlaybackRequest>(playing).play);
  EXPECT_FALSE(std::get<PlaybackRequest>(playing).seek_ns.has_value());
}

TEST(LiveProtocol, PlaybackControlThatIsCutOrUnknownIsRefused) {
  VERIFIES("LASSO-REC-041~1");
  for (std::size_t size = 1; size < kStepRequest.size(); ++size)
    EXPECT_TRUE(std::holds_alternative<Misunderstood>(client_message(kStepRequest.substr(0, size), false))) << size;
  std::string unknown = kStepRequest, long_id = kStepRequest;
  unknown[1] = 2;
  long_id[18] = 0x7F;
  EXPECT_TRUE(std::holds_alternative<Misunderstood>(client_message(unknown, false)));
  EXPECT_TRUE(std::holds_alternative<Misunderstood>(client_message(long_id, false)));
}

TEST(LiveProtocol, PlaybackStateHasItsBytesAndItsRange) {
  VERIFIES("LASSO-REC-042~1");
  EXPECT_EQ(playback_state_data({PlaybackStatus::kPaused, 0x1122334455667788, 2.5F}, "id"),
            std::string("\x05\x01\x88\x77\x66\x55\x44\x33\x22\x11\x00\x00\x20\x40\x00\x02\x00\x00\x00id", 21));
  const auto info = nlohmann::json::parse(server_info_json("run", "7", PlaybackRange{1'000'000'000, 61'200'000'000}));
  EXPECT_EQ(info.at("capabilities"), (nlohmann::json{"time", "playbackControl"}));
  EXPECT_EQ(info.at("dataStartTime"), (nlohmann::json{{"sec", 1}, {"nsec", 0}}));
  EXPECT_EQ(info.at("dataEndTime"), (nlohmann::json{{"sec", 61}, {"nsec", 200'000'000}}));
}

// Good messages with some bytes changed, cut or doubled: each is understood, or told to be none.
TEST(LiveProtocol, NoBytesBreakIt) {
  VERIFIES("LASSO-REC-041~1");
  const std::string good[] = {R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":3},{"id":42,"channelId":1}]})",
                              R"({"op":"unsubscribe","subscriptionIds":[4,5]})"};
  std::mt19937 random(11);
  std::size_t understood = 0, wrong = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text = good[i % 2];
    for (auto changes = random() % 4; changes > 0; --changes) {
      const std::size_t at = random() % text.size();
      const auto kind = random() % 3;
      if (kind == 0) text[at] = static_cast<char>(random() % 256);
      if (kind == 1) text.erase(at, 1 + random() % 3);
      if (kind == 2) text.insert(at, text.substr(at, 1 + random() % 20));
      if (text.empty()) text = "x";
    }
    const ClientMessage message = client_message(text, true);
    const auto* misunderstood = std::get_if<Misunderstood>(&message);
    if (misunderstood != nullptr) {
      EXPECT_NO_THROW((void)status_json(StatusLevel::kError, misunderstood->what));
    }
    ++(misunderstood != nullptr ? wrong : understood);
  }
  EXPECT_GT(understood, 5000U);
  EXPECT_GT(wrong, 5000U);
}

}  // namespace
}  // namespace lasso::mdat::serve
