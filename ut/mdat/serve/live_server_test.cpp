#include "mdat/serve/live_server.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "mdat/common/errors.hpp"
#include "mdat/recording/frame_recorder.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::serve {
namespace {

// A socket that keeps what it is to send.
struct LiveLine final : SocketSender {
  std::vector<std::string> frames, events;
  void send_frame(std::string bytes, bool) override { frames.push_back(std::move(bytes)); }
  void send_event(std::string bytes, bool) override { events.push_back(std::move(bytes)); }
  void close() override {}
};

Request upgrade(const std::string& host = "127.0.0.1:8765", const std::string& origin = "") {
  Request request;
  request.target = "/";
  request.headers = {{"host", host}, {"sec-websocket-protocol", "foxglove.websocket.v1"}};
  if (!origin.empty()) request.headers["origin"] = origin;
  return request;
}

std::size_t topic_number(const std::string& name) {
  const std::vector<MessageTopic> topics = recorded_topics();
  for (std::size_t i = 0; i < topics.size(); ++i) {
    if (topics[i].name == name) return i;
  }
  ADD_FAILURE() << name;
  return 0;
}

std::string subscribe_text(const std::string& topic, unsigned id) {
  return R"({"op":"subscribe","subscriptions":[{"id":)" + std::to_string(id) + R"(,"channelId":)" + std::to_string(topic_number(topic)) +
         "}]}";
}

// A hub, and clients that connect.
class LiveHubTest : public ::testing::Test {
 protected:
  std::unique_ptr<SocketSession> connect(const std::shared_ptr<LiveLine>& line) {
    const SocketOpening opening = hub_.open(upgrade());
    EXPECT_EQ(opening.subprotocol, "foxglove.websocket.v1");
    return opening.begin(line);
  }
  void tell(const std::string& topic, std::uint64_t time_ns, const std::string& text) {
    hub_.on_message(topic_number(topic), time_ns, text);
  }

  LiveHub hub_{"127.0.0.1", "a run"};
};

TEST_F(LiveHubTest, AClientIsToldWhatThereIsAndGetsWhatItAsksFor) {
  VERIFIES("LASSO-REC-040~1");
  const auto line = std::make_shared<LiveLine>();
  const auto session = connect(line);
  ASSERT_EQ(line->events.size(), 2U);
  EXPECT_EQ(nlohmann::json::parse(line->events[0]).at("op"), "serverInfo");
  EXPECT_EQ(nlohmann::json::parse(line->events[0]).at("name"), "a run");
  const auto channels = nlohmann::json::parse(line->events[1]).at("channels");
  EXPECT_EQ(channels.size() + 1, recorded_topics().size()) << "all but what only replay needs";
  tell("/pose", 5, "before");
  session->on_message(subscribe_text("/pose", 9), true);
  tell("/pose", 6, "one");
  tell("/tf", 6, "not asked for");
  tell("/sensor_scans", 6, "never told");
  EXPECT_EQ(line->frames, (std::vector<std::string>{time_data(5), time_data(6), message_data(9, 6, "one")}));
  session->on_message(R"({"op":"unsubscribe","subscriptionIds":[9]})", true);
  tell("/pose", 6, "two");
  EXPECT_EQ(line->frames.size(), 3U);
  EXPECT_EQ(hub_.clients(), 1U);
}

TEST_F(LiveHubTest, EventsAndTheSceneAreNeverDroppedAndKeptForWhoComesLater) {
  VERIFIES("LASSO-REC-040~1");
  tell("/scene", 1, "target");
  tell("/events", 2, "begun");
  tell("/events", 3, "tracking");
  const auto line = std::make_shared<LiveLine>();
  const auto session = connect(line);
  session->on_message(subscribe_text("/events", 1), true);
  session->on_message(subscribe_text("/scene", 2), true);
  tell("/events", 4, "lost");
  const std::vector<std::string> told(line->events.begin() + 2, line->events.end());
  EXPECT_EQ(told, (std::vector<std::string>{message_data(1, 2, "begun"), message_data(1, 3, "tracking"), message_data(2, 1, "target"),
                                            message_data(1, 4, "lost")}));
  EXPECT_EQ(line->frames, std::vector<std::string>{time_data(4)});
}

TEST_F(LiveHubTest, OfEventsTheLastThousandAreKept) {
  VERIFIES("LASSO-REC-040~1");
  for (std::size_t i = 0; i < kKeptEvents + 5; ++i) tell("/events", i, std::to_string(i));
  const auto line = std::make_shared<LiveLine>();
  const auto session = connect(line);
  session->on_message(subscribe_text("/events", 1), true);
  ASSERT_EQ(line->events.size(), 2 + kKeptEvents);
  EXPECT_EQ(line->events[2], message_data(1, 5, "5"));
}

TEST_F(LiveHubTest, WrongQuestionsAreAnsweredAndChangeNothing) {
  VERIFIES("LASSO-REC-041~1");
  const auto line = std::make_shared<LiveLine>();
  const auto session = connect(line);
  session->on_message(subscribe_text("/pose", 1), true);
  const auto complains = [&](const std::string& text, bool is_text = true) {
    const std::size_t before = line->events.size();
    session->on_message(text, is_text);
    return line->events.size() == before + 1 && nlohmann::json::parse(line->events.back()).at("level") == 2;
  };
  EXPECT_TRUE(complains(subscribe_text("/pose", 2))) << "subscribed already";
  EXPECT_TRUE(complains(subscribe_text("/truth", 1))) << "the id is in use";
  EXPECT_TRUE(complains(subscribe_text("/sensor_scans", 3)));
  EXPECT_TRUE(complains(R"({"op":"subscribe","subscriptions":[{"id":5,"channelId":9999}]})"));
  EXPECT_TRUE(complains("garbage"));
  EXPECT_TRUE(complains("\x01\x02", false));
  tell("/pose", 6, "one");
  EXPECT_EQ(line->frames.back(), message_data(1, 6, "one"));
}

std::string control_bytes(bool play, const std::string& speed, std::uint64_t seek_ns, const std::string& id) {
  std::string bytes = std::string("\x03") + (play ? '\0' : '\1') + speed + (seek_ns != 0 ? '\1' : '\0');
  for (int i = 0; i < 8; ++i) bytes += static_cast<char>(seek_ns >> (8 * i) & 0xFF);
  return bytes + static_cast<char>(id.size()) + std::string(3, '\0') + id;
}
const std::string kTwice("\x00\x00\x00\x40", 4), kNoSpeed(4, '\0'), kNotANumber("\x00\x00\xc0\x7f", 4);

// A run of the hub that can be paused, and two clients.
class PlaybackTest : public ::testing::Test {
 protected:
  std::unique_ptr<SocketSession> connect(const std::shared_ptr<LiveLine>& line) { return hub_.open(upgrade()).begin(line); }
  static std::string state(PlaybackStatus status, std::uint64_t time_ns, float speed, const std::string& id = "") {
    return playback_state_data({status, time_ns, speed}, id);
  }

  Pacing pacing_{1};
  Playback playback_{pacing_, {1'000'000'000, 9'000'000'000}};
  LiveHub hub_{"127.0.0.1", "a run", &playback_};
  std::shared_ptr<LiveLine> line_ = std::make_shared<LiveLine>(), other_ = std::make_shared<LiveLine>();
  std::unique_ptr<SocketSession> session_ = connect(line_), second_ = connect(other_);
};

TEST_F(PlaybackTest, AllAreToldWhatOneAsksFor) {
  VERIFIES("LASSO-REC-042~1");
  EXPECT_EQ(line_->events.back(), state(PlaybackStatus::kPlaying, 1'000'000'000, 1));
  session_->on_message(control_bytes(false, kTwice, 0, "a"), false);
  EXPECT_TRUE(pacing_.paused());
  EXPECT_EQ(pacing_.pace(), 2);
  EXPECT_EQ(line_->events.back(), state(PlaybackStatus::kPaused, 1'000'000'000, 2, "a"));
  EXPECT_EQ(other_->events.back(), state(PlaybackStatus::kPaused, 1'000'000'000, 2));
  second_->on_message(control_bytes(true, kTwice, 0, "b"), false);
  EXPECT_FALSE(pacing_.paused());
  EXPECT_EQ(line_->events.back(), state(PlaybackStatus::kPlaying, 1'000'000'000, 2));
  hub_.end("the run is over");
  EXPECT_EQ(other_->events.back(), state(PlaybackStatus::kEnded, 1'000'000'000, 2));
}

// Paused, a later time lets the run go so far; an earlier one is refused, and nothing moves.
TEST_F(PlaybackTest, ALaterTimeIsAStepAndAnEarlierOneIsRefused) {
  VERIFIES("LASSO-REC-042~1");
  hub_.on_message(topic_number("/pose"), 3'000'000'000, "x");
  session_->on_message(control_bytes(false, kTwice, 3'200'000'000, "on"), false);
  EXPECT_TRUE(pacing_.pass(3'200'000)) << "it would wait here for ever";
  EXPECT_EQ(line_->events.back(), state(PlaybackStatus::kPaused, 3'000'000'000, 2, "on"));
  session_->on_message(control_bytes(false, kTwice, 2'000'000'000, "back"), false);
  EXPECT_EQ(line_->events.back(), state(PlaybackStatus::kPaused, 3'000'000'000, 2, "back"));
  EXPECT_NE(line_->events.end()[-2].find("cannot go back"), std::string::npos);
}

TEST_F(PlaybackTest, SpeedsThatAreNoneChangeNothing) {
  VERIFIES("LASSO-REC-041~1");
  for (const std::string& speed : {kNoSpeed, kNotANumber}) {
    session_->on_message(control_bytes(false, speed, 0, "x"), false);
    EXPECT_FALSE(pacing_.paused());
    EXPECT_EQ(pacing_.pace(), 1);
    EXPECT_NE(line_->events.end()[-2].find("expected above 0"), std::string::npos);
  }
}

TEST_F(PlaybackTest, ARunThatTheLastOneLeftGoesOn) {
  VERIFIES("LASSO-REC-044~1");
  session_->on_message(control_bytes(false, kTwice, 0, "a"), false);
  session_.reset();
  EXPECT_TRUE(pacing_.paused()) << "the other one may resume it";
  second_.reset();
  EXPECT_FALSE(pacing_.paused());
}

TEST_F(LiveHubTest, WithoutAPaceOfItsOwnARunIsNotPaused) {
  VERIFIES("LASSO-REC-041~1");
  const auto line = std::make_shared<LiveLine>();
  const auto session = connect(line);
  session->on_message(control_bytes(false, kTwice, 0, "a"), false);
  EXPECT_NE(line->events.back().find("keeps the clock of its link"), std::string::npos);
}

TEST_F(LiveHubTest, PagesFromElsewhereAreRefused) {
  VERIFIES("LASSO-REC-041~1");
  const auto status = [&](const Request& request) {
    const SocketOpening opening = hub_.open(request);
    return opening.begin ? 101U : opening.refusal->status;
  };
  for (const char* host : {"127.0.0.1:8765", "localhost:8765", "localhost", "[::1]:8765"}) EXPECT_EQ(status(upgrade(host)), 101U) << host;
  for (const char* host : {"evil.example:8765", "localhost.evil.example", "127.evil.example", "", ":", "["})
    EXPECT_EQ(status(upgrade(host)), 403U) << host;
  for (const char* origin : {"http://localhost:8080", "http://127.0.0.1", "file://"})
    EXPECT_EQ(status(upgrade("localhost:8765", origin)), 101U) << origin;
  for (const char* origin : {"https://evil.example", "http://localhost.evil.example:80", "http://", "null"})
    EXPECT_EQ(status(upgrade("localhost:8765", origin)), 403U) << origin;
  Request other = upgrade();
  other.headers["sec-websocket-protocol"] = "chat";
  EXPECT_EQ(status(other), 400U);
  EXPECT_EQ(hub_.answer(upgrade()).status, 426U);
}

TEST_F(LiveHubTest, WhoHasGoneIsForgotten) {
  VERIFIES("LASSO-REC-041~1");
  auto line = std::make_shared<LiveLine>();
  auto session = connect(line);
  session->on_message(subscribe_text("/pose", 1), true);
  line.reset();
  tell("/pose", 1, "to nobody");
  session.reset();
  EXPECT_EQ(hub_.clients(), 0U);
  tell("/pose", 2, "to nobody");
}

TEST(LiveServer, AddressesAreAsPeopleWriteThem) {
  VERIFIES("LASSO-REC-040~1");
  const auto read = [](const std::string& text) {
    NetworkOptions options;
    options.port = 8765;
    read_address(text, options);
    return options.host + " " + std::to_string(options.port);
  };
  EXPECT_EQ(read("127.0.0.1:99"), "127.0.0.1 99");
  EXPECT_EQ(read("[::1]:99"), "[::1] 99");
  EXPECT_EQ(read("[::1]"), "[::1] 8765");
  EXPECT_EQ(read("host"), "host 8765");
  EXPECT_EQ(read("99"), "127.0.0.1 99");
  EXPECT_EQ(read(":99"), "127.0.0.1 99");
  EXPECT_EQ(read(""), "127.0.0.1 8765");
  for (const char* text : {"host:", "host:port", "host:99999", "host:-1", "99999", "mission.toml:1x"})
    EXPECT_THROW(read(text), InputError) << text;
}

TEST(LiveServer, AnAddressInUseIsRefused) {
  VERIFIES("LASSO-REC-041~1");
  NetworkOptions options;
  const LiveServer first(options, "one");
  const std::string address = first.address();
  EXPECT_EQ(address.rfind("ws://127.0.0.1:", 0), 0U) << address;
  read_address(address.substr(5), options);
  EXPECT_THROW(LiveServer(options, "two"), InputError);
}

}  // namespace
}  // namespace lasso::mdat::serve
