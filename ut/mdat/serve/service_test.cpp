#include "mdat/serve/service.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "hal_sim/random.hpp"
#include "ut/mdat/serve/small_recording.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::serve {
namespace {

using Json = nlohmann::json;
constexpr char kToken[] = "00112233445566778899aabbccddeeff";

class ServiceTest : public ::testing::Test {
 protected:
  ServiceTest() : folder_(prepared(place_)), gate_("127.0.0.1", 8080, kToken), service_(gate_, folder_, {"abc", {}}) {
    id_ = folder_.list().at(0).id;
  }

  static std::filesystem::path prepared(const TestFolder& place) {
    (void)SmallRecording{}.write(place.path() / "a.mcap");
    return place.path();
  }
  static Request request(const std::string& target) {
    Request request;
    request.target = target;
    request.headers["host"] = "127.0.0.1:8080";
    request.headers["cookie"] = std::string("lasso8080=") + kToken;
    return request;
  }
  Response get(const std::string& target) { return service_.answer(request(target)); }

  TestFolder place_;
  Folder folder_;
  Gate gate_;
  Service service_;
  std::string id_;
};

TEST_F(ServiceTest, EachPartOfTheInterfaceAnswers) {
  VERIFIES("LASSO-WEB-008~1");
  const std::string recording = "/api/recordings/" + id_;
  for (const std::string& target :
       {std::string("/"), std::string("/api/about"), std::string("/api/recordings"), recording, recording + "/frames",
        recording + "/frames/1", recording + "/frames/1/scan", recording + "/frames/1/scan?iteration=1",
        recording + "/series?value=error.position", recording + "/statistics?value=pose.inliers", recording + "/events",
        recording + "/model.glb", recording + "/csv?values=pose.inliers"})
    EXPECT_EQ(get(target).status, 200U) << target << get(target).body;
  EXPECT_EQ(Json::parse(get("/api/recordings").body).at(0)["name"], "a.mcap");
  EXPECT_EQ(Json::parse(get("/api/about").body)["commit"], "abc");
}

TEST_F(ServiceTest, ErrorsSayWhatAndWhatHelps) {
  VERIFIES("LASSO-WEB-004~1");
  const std::string recording = "/api/recordings/" + id_;
  const std::pair<std::string, unsigned> cases[] = {{"/api", 404},
                                                    {"/api/nothing", 404},
                                                    {"/api/recordings/0123456789abcdef", 404},
                                                    {"/api/recordings/..%2f", 400},
                                                    {"/nothing", 404},
                                                    {recording + "/nothing", 404},
                                                    {recording + "/frames/6", 404},
                                                    {recording + "/frames/-1", 404},
                                                    {recording + "/frames/1/nothing", 404},
                                                    {recording + "/frames/1e0", 404},
                                                    {recording + "/series", 400},
                                                    {recording + "/frames/1/scan/2", 404},
                                                    {"/api/jobs/job9", 404},
                                                    {"/../a", 400},
                                                    {"//", 404}};
  for (const auto& [target, status] : cases) {
    const Response response = get(target);
    EXPECT_EQ(response.status, status) << target << response.body;
    if (target == "//") continue;
    const Json json = Json::parse(response.body);
    EXPECT_FALSE(json["error"].get<std::string>().empty() || json["remedy"].get<std::string>().empty()) << target;
  }
}

TEST_F(ServiceTest, WithoutTheTokenNothingIsAnswered) {
  VERIFIES("LASSO-WEB-001~1");
  for (const std::string& target : {std::string("/"), std::string("/app.js"), std::string("/api/about"), "/api/recordings/" + id_,
                                    std::string("/nothing"), std::string("/?token=wrong"), std::string("/api/about?token=") + kToken}) {
    Request stranger = request(target);
    stranger.headers.erase("cookie");
    const Response response = service_.answer(stranger);
    EXPECT_EQ(response.status, 401U) << target;
    EXPECT_EQ(response.body.find("a.mcap"), std::string::npos);
    EXPECT_TRUE(response.headers.empty());
  }
  Request entering = request(std::string("/?token=") + kToken);
  entering.headers.erase("cookie");
  EXPECT_EQ(service_.answer(entering).status, 303U);
}

TEST_F(ServiceTest, NothingIsChangedByOtherMethods) {
  VERIFIES("LASSO-WEB-004~1");
  for (const Method method : {Method::kPost, Method::kOther}) {
    Request other = request("/api/recordings/" + id_);
    other.method = method;
    EXPECT_EQ(service_.answer(other).status, 405U);
    EXPECT_EQ(service_.answer(other).headers.at(0).second, "GET, HEAD");
  }
  Request foreign = request("/api/recordings/first");
  foreign.method = Method::kPost;
  foreign.headers["origin"] = "http://evil.example";
  EXPECT_EQ(service_.answer(foreign).status, 403U);
}

TEST_F(ServiceTest, SocketsAskForTheTokenToo) {
  VERIFIES("LASSO-WEB-001~1 LASSO-WEB-002~1");
  Request stranger = request("/live");
  EXPECT_EQ(service_.open(stranger).refusal.value().status, 404U);
  stranger.headers["origin"] = "http://evil.example";
  EXPECT_EQ(service_.open(stranger).refusal.value().status, 403U);
  stranger.headers.erase("origin");
  stranger.headers.erase("cookie");
  EXPECT_EQ(service_.open(stranger).refusal.value().status, 401U);
}

// Requests made of pieces of good ones: each is answered, and none with what a stranger may not see.
TEST_F(ServiceTest, AnyRequestIsAnswered) {
  VERIFIES("LASSO-WEB-004~1");
  const std::string pieces[] = {"/",
                                "api",
                                "recordings",
                                id_,
                                "frames",
                                "1",
                                "scan",
                                "series",
                                "?",
                                "value=",
                                "error.position",
                                "&",
                                "points=3",
                                "from_s=",
                                "nan",
                                "..",
                                "%2e",
                                "%00",
                                "csv",
                                "values=",
                                "pose.inliers,",
                                "token=",
                                "\xff",
                                "events",
                                "count=99999999999999999999",
                                "iteration=0"};
  sim::Random random(17);
  std::map<unsigned, int> statuses;
  for (int trial = 0; trial < 3000; ++trial) {
    std::string target = random.bits() % 8 != 0 ? "/api/recordings/" + id_ + "/" : "/";
    for (std::uint64_t i = random.bits() % 7; i > 0; --i) target += pieces[random.bits() % std::size(pieces)];
    Request any = request(target);
    if (random.bits() % 4 == 0) any.headers.erase("cookie");
    const bool known = any.headers.count("cookie") > 0;
    const Response response = service_.answer(any);
    ++statuses[response.status];
    EXPECT_NE(response.status, 500U) << target << response.body;
    EXPECT_TRUE(known || response.status >= 400) << target;
  }
  EXPECT_GT(statuses[200], 20);
  EXPECT_GT(statuses[400], 20);
  EXPECT_GT(statuses[401], 20);
  EXPECT_GT(statuses[404], 20);
}

}  // namespace
}  // namespace lasso::mdat::serve
