#include "mdat/serve/folder.hpp"

#include <gtest/gtest.h>

#include "mdat/common/errors.hpp"
#include "mdat/serve/http.hpp"
#include "ut/mdat/serve/small_recording.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::serve {
namespace {

namespace fs = std::filesystem;

unsigned status_of(Folder& folder, const std::string& id) {
  try {
    (void)folder.recording(id);
    return 200;
  } catch (const Refusal& refusal) {
    return refusal.status;
  }
}

TEST(ServedFolder, ShowsRecordingsBelowIt) {
  VERIFIES("LASSO-WEB-005~2");
  const TestFolder place;
  fs::create_directories(place.path() / "b/c");
  (void)SmallRecording{}.write(place.path() / "b/c/two.mcap");
  (void)SmallRecording{}.write(place.path() / "one.mcap");
  std::ofstream(place.path() / "notes.txt") << "none";
  Folder folder(place.path());
  const std::vector<RecordingEntry> entries = folder.list();
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_EQ(entries[0].name, "b/c/two.mcap");
  EXPECT_EQ(entries[1].size_bytes, fs::file_size(place.path() / "one.mcap"));
  EXPECT_FALSE(entries[1].open);
  EXPECT_EQ(folder.recording(entries[1].id)->frames().size(), 6U);
  EXPECT_TRUE(folder.list()[1].open);
  EXPECT_EQ(status_of(folder, folder.id_of(place.path() / "notes.txt")), 404U);
}

TEST(ServedFolder, ReachesThreeFoldersDown) {
  VERIFIES("LASSO-WEB-005~2");
  const TestFolder place;
  fs::create_directories(place.path() / "a/b/c/d");
  for (const char* name : {"a/b/c/third.mcap", "a/b/c/d/fourth.mcap"}) (void)SmallRecording{}.write(place.path() / name);
  Folder folder(place.path());
  ASSERT_EQ(folder.list().size(), 1U);
  EXPECT_EQ(folder.list()[0].name, "a/b/c/third.mcap");
  EXPECT_EQ(status_of(folder, folder.id_of(place.path() / "a/b/c/third.mcap")), 200U);
  EXPECT_EQ(status_of(folder, folder.id_of(place.path() / "a/b/c/d/fourth.mcap")), 404U);
}

TEST(ServedFolder, NothingOutsideIsServed) {
  VERIFIES("LASSO-WEB-005~2");
  const TestFolder place;
  fs::create_directories(place.path() / "in");
  (void)SmallRecording{}.write(place.path() / "out.mcap");
  (void)SmallRecording{}.write(place.path() / "in/own.mcap");
  fs::create_symlink(place.path() / "out.mcap", place.path() / "in/link.mcap");
  fs::create_directory_symlink(place.path(), place.path() / "in/up");
  fs::create_symlink(place.path() / "in/own.mcap", place.path() / "in/other.mcap");
  Folder folder(place.path() / "in");
  std::vector<std::string> names;
  for (const RecordingEntry& entry : folder.list()) names.push_back(entry.name);
  EXPECT_EQ(names, (std::vector<std::string>{"other.mcap", "own.mcap"}));
  const Folder above(place.path());
  for (const std::string& id :
       {std::string("../out.mcap"), std::string("own.mcap"), std::string("0123456789abcdef"), std::string(), std::string(5000, 'a'),
        above.id_of(place.path() / "out.mcap"), folder.id_of(place.path() / "in/link.mcap"), folder.id_of(place.path() / "in/../out.mcap")})
    EXPECT_EQ(status_of(folder, id), 404U) << id.substr(0, 40);
}

// A link that is turned elsewhere after its recording was opened leads nowhere.
TEST(ServedFolder, ALinkThatIsTurnedOutwardsIsRefused) {
  VERIFIES("LASSO-WEB-005~2");
  const TestFolder place;
  fs::create_directories(place.path() / "in");
  (void)SmallRecording{}.write(place.path() / "out.mcap");
  (void)SmallRecording{}.write(place.path() / "in/own.mcap");
  Folder folder(place.path() / "in");
  const std::string id = folder.list().at(0).id;
  EXPECT_EQ(status_of(folder, id), 200U);
  fs::remove(place.path() / "in/own.mcap");
  fs::create_symlink(place.path() / "out.mcap", place.path() / "in/own.mcap");
  EXPECT_EQ(status_of(folder, id), 404U);
}

TEST(ServedFolder, AFileIsAFolderOfOne) {
  VERIFIES("LASSO-WEB-005~2");
  const TestFolder place;
  (void)SmallRecording{}.write(place.path() / "one.mcap");
  (void)SmallRecording{}.write(place.path() / "two.mcap");
  Folder folder(place.path() / "one.mcap");
  ASSERT_EQ(folder.list().size(), 1U);
  EXPECT_EQ(folder.list()[0].name, "one.mcap");
  EXPECT_EQ(status_of(folder, folder.id_of(place.path() / "two.mcap")), 404U);
  EXPECT_THROW((void)Folder(place.path() / "three.mcap"), InputError);
  std::ofstream(place.path() / "text.mcap") << "no recording";
  EXPECT_THROW((void)Folder(place.path() / "text.mcap"), InputError);
}

TEST(ServedFolder, AFileThatChangedIsReadAgain) {
  VERIFIES("LASSO-WEB-015~1");
  const TestFolder place;
  SmallRecording small;
  (void)small.write(place.path() / "one.mcap");
  Folder folder(place.path());
  const std::string id = folder.list().at(0).id;
  EXPECT_EQ(folder.recording(id)->frames().size(), 6U);
  small.frames = 4;
  (void)small.write(place.path() / "one.mcap");
  EXPECT_EQ(folder.recording(id)->frames().size(), 4U);
  std::ofstream(place.path() / "one.mcap") << "no recording any more";
  EXPECT_EQ(status_of(folder, id), 422U);
  EXPECT_NE(folder.list().at(0).error.find("one.mcap: is no MCAP file"), std::string::npos) << folder.list()[0].error;
}

TEST(ServedFolder, HoldsFewRecordingsOpen) {
  VERIFIES("LASSO-WEB-011~1");
  const TestFolder place;
  for (int i = 0; i < 5; ++i) (void)SmallRecording{}.write(place.path() / (std::to_string(i) + ".mcap"));
  Folder folder(place.path());
  for (const RecordingEntry& entry : folder.list()) EXPECT_EQ(status_of(folder, entry.id), 200U);
  std::size_t open = 0;
  for (const RecordingEntry& entry : folder.list()) open += entry.open ? 1 : 0;
  EXPECT_EQ(open, kMostOpen);
  EXPECT_TRUE(folder.list().back().open);
}

}  // namespace
}  // namespace lasso::mdat::serve
