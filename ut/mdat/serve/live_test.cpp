// Runs of the shipped tenth-scale Hubble, as the page asks for them.
#include "mdat/serve/live.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "mdat/serve/live_answers.hpp"
#include "mdat/serve/service.hpp"
#include "ut/mdat/serve/small_recording.hpp"
#include "ut/support/places.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::serve {
namespace {

using LiveTestJson = nlohmann::json;
constexpr char kLiveToken[] = "00112233445566778899aabbccddeeff";

// The shipped missions are found from the sources' folder.
class InSources {
 public:
  InSources() : before_(std::filesystem::current_path()) { std::filesystem::current_path(test::source_folder()); }
  ~InSources() { std::filesystem::current_path(before_); }
  InSources(const InSources&) = delete;
  InSources& operator=(const InSources&) = delete;

 private:
  std::filesystem::path before_;
};

// A server's handlers on an empty folder.
class LiveTest : public ::testing::Test {
 protected:
  static LiveTestJson parsed(const Response& response) { return LiveTestJson::parse(response.body); }
  static Request request(const std::string& target) {
    Request request;
    request.target = target;
    request.headers["host"] = "127.0.0.1:8080";
    request.headers["cookie"] = std::string("lasso8080=") + kLiveToken;
    return request;
  }
  Response get(const std::string& target) { return service_.answer(request(target)); }
  Response post(const std::string& what, const LiveTestJson& body, const std::string& type = "application/json") {
    Request asked = request("/api/live/" + what);
    asked.method = Method::kPost;
    asked.headers["content-type"] = type;
    asked.body = body.dump();
    return service_.answer(asked);
  }
  LiveTestJson state_when(const std::function<bool(const LiveTestJson&)>& fits) {
    LiveTestJson state;
    do state = LiveTestJson::parse(live_.state());
    while (!fits(state) && state["phase"] != "failed");
    return state;
  }
  LiveTestJson state_at(const std::string& phase) {
    return state_when([&](const LiveTestJson& state) { return state["phase"] == phase; });
  }

  // Steps until the recording has a frame; its path.
  std::string stepped_to_a_frame() {
    state_at("running");
    const std::string recording = "/api/recordings/" + LiveTestJson::parse(live_.state())["id"].get<std::string>();
    while (parsed(get(recording))["frames"] == 0) {
      const std::uint64_t before = LiveTestJson::parse(live_.state())["boundaries"];
      live_.step();
      state_when([&](const LiveTestJson& state) { return state["boundaries"] == before + 1; });
    }
    return recording;
  }

  InSources in_sources_;
  TestFolder place_;
  Folder folder_{place_.path()};
  Gate gate_{"127.0.0.1", 8080, kLiveToken};
  Live live_{folder_, "abc"};
  Service service_{gate_, folder_, {"abc", {}, &live_}};
};

TEST_F(LiveTest, NothingFliesBeforeItIsAsked) {
  VERIFIES("LASSO-WEB-019~1");
  EXPECT_EQ(parsed(get("/api/live"))["phase"], "idle");
  for (const char* act : {"pause", "resume", "step", "stop"}) EXPECT_EQ(post(act, LiveTestJson::object()).status, 409U) << act;
  EXPECT_EQ(post("pace", {{"pace", 2}}).status, 409U);
}

// One run serves all that is asked of it: its model has to be compiled where it is not in the user's cache.
TEST_F(LiveTest, AFrameOfARunThatFliesIsThatOfItsRecordingAfterwards) {
  VERIFIES("LASSO-WEB-021~1");
  VERIFIES("LASSO-WEB-020~1");
  ASSERT_EQ(post("start", {{"mission", "hubble_tenth"}, {"scenario", "checked"}, {"seed", 7}}).status, 200U);
  ASSERT_EQ(post("pause", LiveTestJson::object()).status, 200U);
  const std::string recording = stepped_to_a_frame();
  const std::string frame = get(recording + "/frames/0").body, scan = get(recording + "/frames/0/scan").body;
  const LiveTestJson flying = LiveTestJson::parse(live_.state());
  EXPECT_TRUE(flying["paused"]);
  EXPECT_GT(flying["packets"], 0);
  EXPECT_EQ(flying["missing"], 0);
  EXPECT_EQ(post("start", {{"mission", "hubble_tenth"}, {"scenario", "spin"}}).status, 409U);
  ASSERT_EQ(post("stop", LiveTestJson::object()).status, 200U);
  ASSERT_EQ(state_at("over")["phase"], "over");
  EXPECT_EQ(get(recording + "/frames/0").body, frame);
  EXPECT_EQ(get(recording + "/frames/0/scan").body, scan);
  const LiveTestJson after = parsed(get(recording));
  EXPECT_TRUE(after["damage"].empty());
  EXPECT_EQ(after["seed"], 7);
}

TEST_F(LiveTest, WhatIsNoOrderIsRefusedWithWhatIsRight) {
  VERIFIES("LASSO-WEB-004~1");
  const LiveTestJson order = {{"mission", "none"}, {"scenario", "spin"}};
  EXPECT_EQ(post("start", order).status, 404U);
  EXPECT_EQ(post("start", {{"scenario", "spin"}}).status, 400U);
  for (const LiveTestJson& seed : {LiveTestJson(-1), LiveTestJson(0.5), LiveTestJson(4294967296.0), LiveTestJson("7")}) {
    LiveTestJson wrong = order;
    wrong["seed"] = seed;
    EXPECT_EQ(post("start", wrong).status, 400U) << seed;
  }
  for (const LiveTestJson& pace : {LiveTestJson(-1), LiveTestJson(1001), LiveTestJson("fast")})
    EXPECT_EQ(post("pace", {{"pace", pace}}).status, 400U) << pace;
  EXPECT_EQ(post("start", order, "text/plain").status, 415U);
  EXPECT_EQ(post("start", LiveTestJson::array()).status, 400U);
  EXPECT_EQ(post("nothing", LiveTestJson::object()).status, 404U);
}

TEST_F(LiveTest, ItsSocketNeedsTheToken) {
  VERIFIES("LASSO-WEB-001~1");
  Request asked = request("/api/live/socket");
  EXPECT_TRUE(service_.open(asked).begin);
  asked.headers.erase("cookie");
  EXPECT_EQ(service_.open(asked).refusal.value_or(Response{}).status, 401U);
  asked = request("/api/live/socket");
  asked.headers["origin"] = "http://elsewhere.example";
  EXPECT_EQ(service_.open(asked).refusal.value_or(Response{}).status, 403U);
}

}  // namespace
}  // namespace lasso::mdat::serve
