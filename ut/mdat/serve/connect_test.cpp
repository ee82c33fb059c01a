// A component elsewhere, to which the page connects: here its end of the link is the test's.
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <thread>

#include "bsp/posix/links.hpp"
#include "mdat/serve/live.hpp"
#include "mdat/serve/live_answers.hpp"
#include "mdat/serve/service.hpp"
#include "ut/mdat/link/some_telemetry.hpp"
#include "ut/mdat/serve/small_recording.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::serve {
namespace {

using ConnectJson = nlohmann::json;
constexpr char kConnectToken[] = "00112233445566778899aabbccddeeff";
constexpr TimeUs kConnectFrame_us = 200'000;

class ConnectTest : public ::testing::Test {
 protected:
  Response ask(const std::string& target, Method method = Method::kGet, const ConnectJson& body = nullptr) {
    Request request;
    request.target = target;
    request.method = method;
    request.headers["host"] = "127.0.0.1:8080";
    request.headers["cookie"] = std::string("lasso8080=") + kConnectToken;
    request.headers["content-type"] = "application/json";
    if (method == Method::kPost) request.body = body.dump();
    return service_.answer(request);
  }
  Response post(const std::string& what, const ConnectJson& body = ConnectJson::object()) {
    return ask("/api/live/" + what, Method::kPost, body);
  }
  ConnectJson state() { return ConnectJson::parse(live_->state()); }

  // Sends frames until the state fits, for some seconds; whether it does.
  bool told_until(const std::function<bool(const ConnectJson&)>& fits) {
    for (int i = 0; i < 200; ++i) {
      if (fits(state())) return true;
      PoseTelemetry pose;
      pose.t_measurement_us = frame_ * kConnectFrame_us + kConnectFrame_us / 2;
      pose.t_publication_us = (frame_ + 1) * kConnectFrame_us;
      pose.valid = 1;
      PacketHeader header;
      header.sequence_count = static_cast<std::uint16_t>(frame_++ & kSequenceCountMask);
      header.t_us = pose.t_publication_us;
      const TelemetryBytes packet = pose_packet(pose, header);
      TelemetryBytes heard(2000);
      if (component_->read(Bytes(heard.data(), heard.size())) > 0) component_->peer_spoke();
      (void)component_->write({packet.data(), packet.size()});
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return false;
  }

  TestFolder place_;
  Folder folder_{place_.path()};
  Gate gate_{"127.0.0.1", 8080, kConnectToken};
  LinkRights rights_;
  std::unique_ptr<Live> live_ = std::make_unique<Live>(folder_, "abc", rights_);
  Service service_{gate_, folder_, {"abc", {}, live_.get()}};
  std::unique_ptr<posix::PosixLink> component_ = posix::open_link("udp://:0");
  std::int64_t frame_ = 0;
};

TEST_F(ConnectTest, ItsFramesAreThoseOfTheRecordingAfterwards) {
  VERIFIES("LASSO-WEB-022~1");
  ASSERT_EQ(post("connect", {{"address", component_->address()}}).status, 200U);
  ASSERT_TRUE(told_until([](const ConnectJson& state) { return state["boundaries"] >= 5; })) << state();
  const ConnectJson connected = state();
  EXPECT_EQ(connected["phase"], "running");
  EXPECT_EQ(connected["address"], component_->address());
  EXPECT_EQ(connected["missing"], 0);
  EXPECT_EQ(connected["name"], "component-link.mcap");
  EXPECT_NE(connected["command"].get<std::string>().find("mdat monitor " + component_->address()), std::string::npos) << connected;
  const std::string recording = "/api/recordings/" + connected["id"].get<std::string>();
  const std::string frame = ask(recording + "/frames/1").body;
  EXPECT_EQ(ConnectJson::parse(ask(recording).body)["has_truth"], false);
  for (const char* act : {"pause", "resume", "step"}) EXPECT_EQ(post(act).status, 409U) << act;
  EXPECT_EQ(post("pace", {{"pace", 2}}).status, 409U);
  EXPECT_EQ(post("connect", {{"address", component_->address()}}).status, 409U);
  ASSERT_EQ(post("stop").status, 200U);
  while (state()["phase"] == "running") std::this_thread::yield();
  EXPECT_EQ(state()["phase"], "over");
  EXPECT_EQ(ask(recording + "/frames/1").body, frame);
  const ConnectJson after = ConnectJson::parse(ask(recording).body);
  EXPECT_TRUE(after["damage"].empty());
  EXPECT_GE(after["frames"], 5);
  EXPECT_NE(after["command"].get<std::string>().find("mdat recording info"), std::string::npos) << "it cannot be flown again";
}

TEST_F(ConnectTest, AClockThatBeginsAnewGoesOnInAFurtherRecording) {
  VERIFIES("LASSO-WEB-022~1");
  frame_ = 1000;
  ASSERT_EQ(post("connect", {{"address", component_->address()}}).status, 200U);
  ASSERT_TRUE(told_until([](const ConnectJson& state) { return state["bytes"] > 0; }));
  const ConnectJson before = state();
  frame_ = 0;
  ASSERT_TRUE(told_until([&](const ConnectJson& state) { return state["id"] != before["id"] && state["bytes"] > 0; })) << state();
  EXPECT_EQ(state()["name"], "component-link-2.mcap");
  EXPECT_EQ(state()["missing"], 0) << "a restart is no gap";
}

TEST_F(ConnectTest, NothingIsSentUnlessItIsAllowed) {
  VERIFIES("LASSO-WEB-024~1");
  const ConnectJson ping = {{"name", "ping"}, {"values", ConnectJson::object()}};
  EXPECT_EQ(post("command", ping).status, 409U) << "nobody is connected";
  ASSERT_EQ(post("connect", {{"address", component_->address()}}).status, 200U);
  ASSERT_TRUE(told_until([](const ConnectJson& state) { return state["boundaries"] > 0; }));
  EXPECT_FALSE(state()["may_command"]);
  const Response refused = post("command", ping);
  EXPECT_EQ(refused.status, 403U);
  EXPECT_NE(refused.body.find("--allow-commands"), std::string::npos) << refused.body;
  EXPECT_TRUE(state()["commands"].empty());
}

TEST_F(ConnectTest, ALinkThatEndsSaysSoAndTakesNoCommands) {
  VERIFIES("LASSO-WEB-022~1");
  component_ = posix::open_link("tcp://:0");
  ASSERT_EQ(post("connect", {{"address", component_->address()}}).status, 200U);
  ASSERT_TRUE(told_until([](const ConnectJson& state) { return state["boundaries"] > 0; })) << state();
  component_.reset();
  while (state()["trouble"].is_null()) std::this_thread::yield();
  EXPECT_EQ(state()["phase"], "running") << "it is tried again";
  const Response refused = post("command", {{"name", "ping"}});
  EXPECT_EQ(refused.status, 409U);
  EXPECT_NE(refused.body.find("the link has ended"), std::string::npos) << refused.body;
  EXPECT_TRUE(state()["commands"].empty());
}

TEST_F(ConnectTest, WhereNobodyIsTheStateSaysSo) {
  VERIFIES("LASSO-WEB-022~1");
  const std::string nobody = [] { return posix::open_link("tcp://:0")->address(); }();
  ASSERT_EQ(post("connect", {{"address", nobody}}).status, 200U);
  while (state()["phase"] == "preparing" || state()["phase"] == "running") std::this_thread::yield();
  EXPECT_EQ(state()["phase"], "failed");
  EXPECT_NE(state()["error"].get<std::string>().find("nobody answers"), std::string::npos) << state();
  EXPECT_TRUE(folder_.list().empty()) << "nothing is left";
}

TEST_F(ConnectTest, OnlyNetworksAndSerialDevicesAreReached) {
  VERIFIES("LASSO-WEB-022~1");
  for (const char* address :
       {"", "udp://", "unix:/run/some.sock", "file:///etc/passwd", "serial:/etc/passwd", "serial:/dev/../etc/passwd", "/dev/ttyS0"})
    EXPECT_EQ(post("connect", {{"address", address}}).status, 400U) << address;
  EXPECT_EQ(post("connect", {{"address", "udp://:1"}, {"mission", "none"}}).status, 404U);
  EXPECT_EQ(post("connect").status, 400U);
}

}  // namespace
}  // namespace lasso::mdat::serve
