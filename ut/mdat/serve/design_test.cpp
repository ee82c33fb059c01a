// Missions as the page edits them: opened, changed, saved and copied, by the handlers of mdat serve.
#include "mdat/serve/design.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "mdat/serve/service.hpp"
#include "ut/mdat/serve/small_recording.hpp"
#include "ut/support/places.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::serve {
namespace {

using DesignTestJson = nlohmann::json;
constexpr char kDesignToken[] = "00112233445566778899aabbccddeeff";

// A server's handlers on a folder with a copy of the tenth-scale Hubble, which names its model.
class DesignTest : public ::testing::Test {
 protected:
  DesignTest() {
    const std::filesystem::path shipped = test::source_folder() / "cfg";
    std::filesystem::create_directories(place_.path() / "own/missions");
    std::filesystem::copy(shipped / "models", place_.path() / "own/models");
    std::filesystem::copy_file(shipped / "missions/hubble_tenth.toml", file());
  }
  std::filesystem::path file() const { return place_.path() / "own/missions/hubble_tenth.toml"; }
  static Request asked(const std::string& target) {
    Request request;
    request.target = target;
    request.headers["host"] = "127.0.0.1:8080";
    request.headers["cookie"] = std::string("lasso8080=") + kDesignToken;
    return request;
  }
  DesignTestJson opened() { return DesignTestJson::parse(service_.answer(asked("/api/mission?id=" + std::string(kOwn))).body); }
  Response act(const std::string& what, const DesignTestJson& body, const std::string& id = kOwn) {
    Request request = asked("/api/mission/" + what + "?id=" + id);
    request.method = Method::kPost;
    request.headers["content-type"] = "application/json";
    request.body = body.dump();
    return service_.answer(request);
  }
  static DesignTestJson json(const Response& response) { return DesignTestJson::parse(response.body); }

  static constexpr const char* kOwn = "own/missions/hubble_tenth.toml";
  TestFolder place_;
  Folder folder_{place_.path()};
  Gate gate_{"127.0.0.1", 8080, kDesignToken};
  Live live_{folder_, "abc"};
  Service service_{gate_, folder_, {"abc", {}, &live_}};
};

DesignTestJson value_of(const DesignTestJson& view, const std::string& key) {
  for (const DesignTestJson& value : view["values"]) {
    if (value["key"] == key) return value;
  }
  return {};
}

TEST_F(DesignTest, AMissionOpensAsItsTextAndWhatItSays) {
  VERIFIES("LASSO-WEB-026~2");
  const DesignTestJson view = opened();
  EXPECT_EQ(view["text"], bytes_of_file(file()));
  EXPECT_TRUE(view["problems"].empty());
  EXPECT_FALSE(view["shipped"]);
  const DesignTestJson points = value_of(view, "scan.points");
  EXPECT_EQ(points["value"], "1024");
  std::istringstream lines(bytes_of_file(file()));
  std::string line;
  for (int i = 0; i < points["line"].get<int>(); ++i) std::getline(lines, line);
  EXPECT_EQ(line.rfind("points = 1024", 0), 0U) << line;
  EXPECT_EQ(value_of(view, "scenario.paper.override.estimation.deskew")["value"], "false");
  EXPECT_EQ(service_.answer(asked("/api/mission?id=none")).status, 404U);
  EXPECT_TRUE(json(service_.answer(asked("/api/schema")))["properties"].contains("scan"));
}

// By no path, and by no link: of each part of the interface that takes a mission's name.
TEST_F(DesignTest, NoFileButAMissionBelowTheFolderIsOne) {
  VERIFIES("LASSO-WEB-005~2");
  const TestFolder elsewhere;
  std::filesystem::copy_file(file(), elsewhere.path() / "other.toml");
  std::filesystem::create_directories(place_.path() / "own/b/c/d");
  std::filesystem::copy_file(file(), place_.path() / "own/b/c/third.toml");
  for (const char* name : {"own/b/c/d/fourth.toml", "own/notes.txt"}) std::filesystem::copy_file(file(), place_.path() / name);
  std::filesystem::create_symlink(elsewhere.path() / "other.toml", place_.path() / "own/link.toml");
  std::filesystem::create_directory_symlink(elsewhere.path(), place_.path() / "own/folder");
  EXPECT_EQ(service_.answer(asked("/api/mission?id=own/b/c/third.toml")).status, 200U);
  const std::string text = bytes_of_file(file());
  const DesignTestJson body = {{"text", text}, {"digest", "00"}, {"name", "copy"}, {"scenario", "paper"}, {"set", {"scan.points=512"}}};
  for (const std::string& id :
       {std::string("own/link.toml"), std::string("own/folder/other.toml"), std::string("own/notes.txt"),
        std::string("own/b/c/d/fourth.toml"), std::string("../other.toml"), std::string("/etc/passwd"), std::string(),
        std::string("own/missions/../missions/hubble_tenth.toml"), (elsewhere.path() / "other.toml").string()}) {
    EXPECT_EQ(service_.answer(asked("/api/mission?id=" + id)).status, 404U) << id;
    for (const char* what : {"look", "set", "save", "copy", "preview", "surface"})
      EXPECT_EQ(act(what, body, id).status, 404U) << what << " " << id;
  }
  EXPECT_FALSE(std::filesystem::exists(place_.path() / "copy"));
}

TEST_F(DesignTest, ARecordingThatIsServedAloneComesWithoutItsNeighboursMissions) {
  VERIFIES("LASSO-WEB-005~2");
  (void)SmallRecording{}.write(place_.path() / "one.mcap");
  Folder single(place_.path() / "one.mcap");
  const Live live(single, "abc");
  for (const LiveMission& mission : live.missions()) EXPECT_TRUE(mission.shipped) << mission.id;
  EXPECT_THROW((void)live.mission(kOwn), Refusal);
  EXPECT_EQ(std::filesystem::canonical(live_.mission(kOwn).file), std::filesystem::canonical(file())) << "of the folder it is one";
}

TEST_F(DesignTest, AValueIsSetInTheTextAndAProblemSaysWhere) {
  VERIFIES("LASSO-WEB-026~2");
  const std::string text = opened()["text"];
  const DesignTestJson changed = json(act("set", {{"text", text}, {"set", {"scan.points=512"}}}));
  EXPECT_EQ(value_of(changed, "scan.points")["value"], "512");
  EXPECT_EQ(changed["text"].get<std::string>().size(), text.size() - 1);
  const DesignTestJson wrong = json(act("set", {{"text", text}, {"set", {"scan.points=5"}}}));
  ASSERT_EQ(wrong["problems"].size(), 1U);
  EXPECT_EQ(wrong["problems"][0]["key"], "scan.points");
  EXPECT_EQ(wrong["problems"][0]["line"], value_of(changed, "scan.points")["line"]);
  EXPECT_EQ(json(act("look", {{"text", "[scan\n"}}))["problems"].size(), 1U);
  EXPECT_EQ(act("set", {{"text", text}, {"set", {"scan=5"}}}).status, 422U);
  EXPECT_EQ(act("set", {{"text", text}, {"set", "scan.points=5"}}).status, 400U);
  EXPECT_EQ(act("set", {{"text", text}, {"set", {5}}}).status, 400U);
  EXPECT_EQ(bytes_of_file(file()), text) << "nothing is written before it is saved";
}

TEST_F(DesignTest, TheSettingsSayWhatMissionSetWouldHaveToDo) {
  VERIFIES("LASSO-WEB-026~2");
  const std::string text = opened()["text"];
  const DesignTestJson changed = json(act("set", {{"text", text}, {"saved", text}, {"set", {"scan.points=512", "scan.pattern=raster"}}}));
  EXPECT_EQ(changed["settings"], (std::vector<std::string>{"scan.pattern=raster", "scan.points=512"}));
  const DesignTestJson again = json(act("set", {{"text", text}, {"set", changed["settings"]}}));
  EXPECT_EQ(again["text"], changed["text"]);
  EXPECT_FALSE(again.contains("settings")) << "of no saved text";
  EXPECT_TRUE(json(act("look", {{"text", text + "# a remark\n"}, {"saved", text}}))["settings"].empty());
  EXPECT_TRUE(json(act("look", {{"text", "[scan]\n"}, {"saved", text}}))["settings"].is_null()) << "values are gone";
  EXPECT_TRUE(json(act("look", {{"text", "[scan\n"}, {"saved", text}}))["settings"].is_null());
  EXPECT_EQ(act("look", {{"text", text}, {"saved", 5}}).status, 400U);
}

TEST_F(DesignTest, CampaignsAndMaterialsAreToldAsTheyAreWritten) {
  VERIFIES("LASSO-WEB-026~2");
  const std::string more =
      "\n[campaign.far]\nscenario = \"spin\"\ncases = 20\ntruth = { range_m = { uniform = [3, 6] } }\n"
      "\n[material.shell]\nparts = [\"*\"]\npreset = \"mli\"\n";
  const DesignTestJson view = json(act("look", {{"text", opened()["text"].get<std::string>() + more}}));
  ASSERT_TRUE(view["problems"].empty()) << view["problems"];
  EXPECT_EQ(value_of(view, "campaign.far.cases")["value"], "20");
  EXPECT_EQ(value_of(view, "campaign.far.truth.range_m")["value"], "{ uniform = [3, 6] }");
  EXPECT_EQ(value_of(view, "material.shell.preset")["value"], "\"mli\"");
  EXPECT_EQ(value_of(view, "material.shell.parts")["line"].get<int>() + 1, value_of(view, "material.shell.preset")["line"].get<int>());
}

// The body of 64 kB that other requests may have would hold half of it.
TEST_F(DesignTest, AMissionAsLargeAsItsFileMayBeIsEdited) {
  VERIFIES("LASSO-WEB-032~2");
  std::string text = opened()["text"];
  while (text.size() < (std::size_t{1} << 20) - 100) text += "# one of many remarks\n";
  EXPECT_EQ(act("set", {{"text", text}, {"saved", text}, {"set", {"scan.points=512"}}}).status, 200U);
  const Response larger = act("look", {{"text", std::string(kMaxTextBytes, '#')}});
  EXPECT_EQ(larger.status, 413U);
  EXPECT_NE(json(larger)["remedy"].get<std::string>().find("a mission's text has at most 1 MB"), std::string::npos);
}

TEST_F(DesignTest, SavesWhatIsValidOverTheFileThatWasOpened) {
  VERIFIES("LASSO-WEB-027~1");
  const DesignTestJson view = opened();
  const std::string text = view["text"], comment = "# a remark\n" + text;
  EXPECT_EQ(act("save", {{"text", "[scan]\npoints = 5\n"}, {"digest", view["digest"]}}).status, 422U);
  EXPECT_EQ(act("save", {{"text", comment}, {"digest", "00"}}).status, 409U);
  EXPECT_EQ(bytes_of_file(file()), text);
  const Response saved = act("save", {{"text", comment}, {"digest", view["digest"]}});
  ASSERT_EQ(saved.status, 200U) << saved.body;
  EXPECT_EQ(bytes_of_file(file()), comment);
  EXPECT_EQ(act("save", {{"text", text}, {"digest", view["digest"]}}).status, 409U) << "the file is another one now";
  EXPECT_EQ(act("save", {{"text", text}, {"digest", json(saved)["digest"]}}).status, 200U);
}

TEST_F(DesignTest, ACopyHasAllFilesAndIsAMissionOfItsOwn) {
  VERIFIES("LASSO-WEB-028~1");
  for (const char* name : {"", "..", "a/b", "own"}) EXPECT_GE(act("copy", {{"name", name}}).status, 400U) << name;
  const Response copied = act("copy", {{"name", "second"}});
  ASSERT_EQ(copied.status, 200U) << copied.body;
  const std::string id = json(copied)["id"];
  EXPECT_EQ(id.rfind("second/", 0), 0U) << id;
  EXPECT_EQ(bytes_of_file(place_.path() / id), bytes_of_file(file()));
  const DesignTestJson view = json(service_.answer(asked("/api/mission?id=" + id)));
  EXPECT_TRUE(view["problems"].empty()) << view["problems"];
  EXPECT_EQ(act("copy", {{"name", "second"}}).status, 409U);
}

}  // namespace
}  // namespace lasso::mdat::serve
