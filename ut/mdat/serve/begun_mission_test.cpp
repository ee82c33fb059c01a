// Missions for meshes that are sent: by the handlers of mdat serve, against what mdat mission new writes for the same file.
#include "mdat/serve/begun_mission.hpp"

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "mdat/missiondb/new_mission.hpp"
#include "mdat/serve/service.hpp"
#include "ut/support/places.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::serve {
namespace {

using BegunJson = nlohmann::json;
constexpr char kBegunToken[] = "00112233445566778899aabbccddeeff";

// A closed box as OBJ, the corner at `low` and the sides in the file's lengths.
std::string box_obj(std::array<double, 3> low, std::array<double, 3> sides) {
  std::ostringstream text;
  for (int i = 0; i < 8; ++i)
    text << "v " << low[0] + (i & 1) * sides[0] << ' ' << low[1] + (i >> 1 & 1) * sides[1] << ' ' << low[2] + (i >> 2) * sides[2] << '\n';
  text << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  return text.str();
}

class BegunMissionTest : public ::testing::Test {
 protected:
  static Request asked(const std::string& query, std::string body) {
    Request request;
    request.method = Method::kPost;
    request.target = "/api/mission/new?" + query;
    request.headers = {
        {"host", "127.0.0.1:8080"}, {"cookie", std::string("lasso8080=") + kBegunToken}, {"content-type", "application/octet-stream"}};
    request.body = std::move(body);
    return request;
  }
  Response begin(const std::string& query, const std::string& body) { return service_.answer(asked(query, body)); }

  TestFolder place_;
  Folder folder_{place_.path()};
  Gate gate_{"127.0.0.1", 8080, kBegunToken};
  Live live_{folder_, "abc"};
  Service service_{gate_, folder_, {"abc", {}, &live_}};
};

TEST_F(BegunMissionTest, WritesWhatMissionNewWritesForTheSameFile) {
  VERIFIES("LASSO-WEB-031~1");
  const std::string box = box_obj({-350, -200, -100}, {700, 400, 250});
  const Response response = begin("name=box&file=my%20box.obj&scale=0.001", box);
  ASSERT_EQ(response.status, 200U) << response.body;
  const BegunJson begun = BegunJson::parse(response.body);
  EXPECT_EQ(begun["id"], "box/box.toml");
  EXPECT_EQ(bytes_of_file(place_.path() / "box/my_box.obj"), box);

  const std::filesystem::path other = place_.path() / "other";
  std::filesystem::create_directory(other);
  std::ofstream(other / "my_box.obj", std::ios::binary) << box;
  NewMissionRequest request;
  request.model = other / "my_box.obj";
  request.out = other / "box.toml";
  request.scale = 0.001;
  EXPECT_EQ(begun["remarks"], BegunJson(write_new_mission(request)));
  EXPECT_EQ(bytes_of_file(place_.path() / "box/box.toml"), bytes_of_file(other / "box.toml"));
  const std::string path = (place_.path() / "box").string();
  EXPECT_EQ(begun["command"], "mdat mission new --model " + path + "/my_box.obj --scale 0.001 --out " + path + "/box.toml");
}

TEST_F(BegunMissionTest, WhatIsRefusedIsSaidInItsWordsAndLeavesNothing) {
  VERIFIES("LASSO-WEB-031~1");
  const std::string box = box_obj({-3500, -2000, -1000}, {7000, 4000, 2500});
  const std::pair<std::string, std::string> cases[] = {
      {"name=large&file=box.obj", "box.obj: is 7000 m long after target.scale"},
      {"name=kind&file=box.step", "box.step: is of kind"},
      {"name=scale&file=box.obj&scale=-1", "box.obj: scale: -1"},
  };
  for (const auto& [query, words] : cases) {
    const Response response = begin(query, box);
    EXPECT_EQ(response.status, 422U) << response.body;
    EXPECT_NE(response.body.find(words), std::string::npos) << response.body;
    EXPECT_EQ(response.body.find(place_.path().string()), std::string::npos) << response.body;
  }
  EXPECT_TRUE(std::filesystem::is_empty(place_.path()));
  for (const char* query : {"name=..&file=box.obj", "name=a%2Fb&file=box.obj", "name=a&file=", "name=a&file=box",
                            "name=a&file=b.obj&scale=x", "name=a&file=b.obj&simplify=3", "name=a&file=b.obj&sensor=ear"})
    EXPECT_EQ(begin(query, box).status, 400U) << query;
  EXPECT_TRUE(std::filesystem::is_empty(place_.path()));
}

TEST_F(BegunMissionTest, ANameThatIsTakenIsLeftAsItIs) {
  VERIFIES("LASSO-WEB-031~1");
  std::filesystem::create_directory(place_.path() / "taken");
  std::ofstream(place_.path() / "taken/letter.txt") << "Dear reader";
  EXPECT_EQ(begin("name=taken&file=box.obj", box_obj({0, 0, 0}, {1, 1, 1})).status, 409U);
  EXPECT_EQ(bytes_of_file(place_.path() / "taken/letter.txt"), "Dear reader");
  EXPECT_FALSE(std::filesystem::exists(place_.path() / "taken/box.obj"));
}

TEST_F(BegunMissionTest, OnlyWhoMayAskSendsALargeBodyAndOnlyHere) {
  VERIFIES("LASSO-WEB-032~2");
  Request request = asked("name=a&file=b.stl", "");
  EXPECT_EQ(service_.body_limit(request), kMaxMeshBytes);
  request.headers.erase("cookie");
  EXPECT_EQ(service_.body_limit(request), kMaxBodyBytes);
  request = asked("name=a&file=b.stl", "");
  request.headers["host"] = "elsewhere.example:8080";
  EXPECT_EQ(service_.body_limit(request), kMaxBodyBytes);
  request = asked("name=a&file=b.stl", "");
  request.target = "/api/mission/save?id=a";
  EXPECT_EQ(service_.body_limit(request), kMaxTextBytes) << "of the largest mission's text, as JSON";
  request.target = "/api/live/start";
  EXPECT_EQ(service_.body_limit(request), kMaxBodyBytes);
  request = asked("name=a&file=b.stl", "solid");
  request.headers["content-type"] = "text/plain";
  EXPECT_EQ(service_.answer(request).status, 415U) << "a page from elsewhere can send this type unasked";
}

}  // namespace
}  // namespace lasso::mdat::serve
