#include "mdat/campaign/kept_mission.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "mdat/common/errors.hpp"
#include "ut/mdat/campaign/chunk_folder.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;

constexpr char kAbc_sha256[] = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";  // of FIPS 180-2, appendix B.1

class KeptMissionFiles : public testing::Test {
 protected:
  KeptMissionFiles() {
    write("cfg/missions/a.toml", "# a mission\n");
    write("cfg/models/body.gltf", R"({"asset":{"version":"2.0"},"buffers":[{"uri":"my%20body.bin","byteLength":3}]})");
    write("cfg/models/my body.bin", "abc");
    source.file = file("cfg/missions/a.toml");
    source.named_files = {file("cfg/models/body.gltf"), file("cfg/models/body.gltf")};
  }
  fs::path file(const std::string& name) const { return folder.path() / name; }
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories(file(name).parent_path());
    std::ofstream(file(name), std::ios::binary) << text;
  }
  std::string read(const std::string& name) const {
    std::ifstream in(file(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  test::ChunkFolder folder;
  MissionSource source;
};

TEST_F(KeptMissionFiles, AreAsFarApartAsTheyWere) {
  VERIFIES("LASSO-GND-068~1");
  const KeptMission kept = kept_mission(source);
  EXPECT_EQ(kept.mission, "mission/missions/a.toml");
  const std::map<std::string, std::string> digests = kept.digests();
  ASSERT_EQ(digests.size(), 3u) << "a mesh's buffers are of the mission, too";
  EXPECT_EQ(digests.at("mission/models/my body.bin"), kAbc_sha256);
  write("c/mission/old", "of an earlier campaign");
  keep_mission(kept, file("c"));
  EXPECT_EQ(read("c/mission/missions/a.toml"), "# a mission\n");
  EXPECT_EQ(read("c/mission/models/my body.bin"), "abc");
  EXPECT_EQ(read("c/mission/models/body.gltf"), read("cfg/models/body.gltf"));
  EXPECT_FALSE(fs::exists(file("c/mission/old")));
}

TEST_F(KeptMissionFiles, OfOneFolderStandSideBySide) {
  VERIFIES("LASSO-GND-068~1");
  source.named_files.clear();
  EXPECT_EQ(kept_mission(source).mission, "mission/a.toml");
}

TEST_F(KeptMissionFiles, ThatAreGoneAreNamed) {
  VERIFIES("LASSO-GND-068~1");
  const KeptMission kept = kept_mission(source);
  fs::remove(file("cfg/models/my body.bin"));
  EXPECT_NE(test::message_of<InputError>([&] { static_cast<void>(kept.digests()); }).find("my body.bin: cannot be read"),
            std::string::npos);
  EXPECT_THROW(keep_mission(kept, file("c")), InputError);
  EXPECT_FALSE(fs::exists(file("c/mission")));
}

}  // namespace
}  // namespace lasso::mdat
