#include "mdat/campaign/chunk_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <memory>
#include <thread>

#include "mdat/common/errors.hpp"
#include "ut/mdat/campaign/chunk_folder.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using test::ChunkFolder;
using test::kPlan;
using test::message_of;

TEST(ChunkFile, GoesOnAfterItsLastWholeRecord) {
  VERIFIES("LASSO-GND-090~1");
  const ChunkFolder folder;
  const std::string whole = chunk_heading(kPlan) + record_line(0, "ok,1");
  const std::string torn = record_line(1, "ok,22");
  for (std::size_t size = 0; size < torn.size(); ++size) {
    folder.write("1of1.part", whole + torn.substr(0, size));
    ChunkFile file(folder.path(), "1of1", kPlan);
    file.append(1, "ok,22");
    EXPECT_EQ(folder.read("1of1.part"), whole + torn);
    EXPECT_TRUE(file.notes().empty());
  }
}

TEST(ChunkFile, SetsADamagedRecordAside) {
  VERIFIES("LASSO-GND-090~1");
  const ChunkFolder folder;
  const std::string heading = chunk_heading(kPlan), first = record_line(0, "ok,1"), last = record_line(2, "ok,3");
  folder.write("1of1.part", heading + first + "00000000,1,ok,2\n" + last + "torn");
  ChunkFile file(folder.path(), "1of1", kPlan);
  ASSERT_EQ(file.notes().size(), 1U);
  EXPECT_NE(file.notes()[0].find("1of1.part:3: a damaged record, set aside in 1of1.damaged"), std::string::npos) << file.notes()[0];
  EXPECT_EQ(folder.read("1of1.damaged"), "00000000,1,ok,2\n");
  file.append(1, "ok,2");
  EXPECT_EQ(folder.read("1of1.part"), heading + first + last + record_line(1, "ok,2"));
}

TEST(ChunkFile, IsFlownByOneProcess) {
  VERIFIES("LASSO-GND-090~1");
  const ChunkFolder folder;
  folder.write("1of1.part", chunk_heading(kPlan) + "damaged\n");  // replaced when it is opened: the lock is on the new file
  auto first = std::make_unique<ChunkFile>(folder.path(), "1of1", kPlan);
  EXPECT_TRUE(in_flight(folder.chunk("1of1.part")));
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    first.reset();
  });
  const ChunkFile second(folder.path(), "1of1", kPlan);  // waits a moment for one that is just ending
  later.join();
  const std::string message = message_of<InputError>([&] { const ChunkFile third(folder.path(), "1of1", kPlan); });
  EXPECT_NE(message.find("1of1.part: another process flies this chunk: wait for it or stop it"), std::string::npos) << message;
}

TEST(ChunkFile, IsCompletedBesideEarlierOnes) {
  VERIFIES("LASSO-GND-090~1");
  const ChunkFolder folder;
  for (std::uint32_t number = 0; number < 2; ++number) {
    ChunkFile file(folder.path(), "1of1", kPlan);
    file.append(number, "ok");
    file.complete();
  }
  EXPECT_EQ(folder.read("1of1.done"), chunk_heading(kPlan) + record_line(0, "ok"));
  EXPECT_EQ(folder.read("1of1-2.done"), chunk_heading(kPlan) + record_line(1, "ok"));
  ChunkFile(folder.path(), "1of1", kPlan).complete();  // without a record
  EXPECT_EQ(chunk_files(folder.path()).size(), 2U);
}

TEST(ChunkFile, ThatIsFullKeepsItsRecords) {
  VERIFIES("LASSO-GND-090~1");
  const ChunkFolder folder;
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{130, before.rlim_max};
  const auto action = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  ChunkFile file(folder.path(), "1of1", kPlan);
  file.append(0, "ok,1");
  const std::string message = message_of<RunError>([&] { file.append(1, "ok," + std::string(40, '1')); });
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  (void)std::signal(SIGXFSZ, action);
  EXPECT_NE(message.find("1of1.part: cannot be written: File too large; the finished cases stay"), std::string::npos) << message;
  EXPECT_EQ(folder.read("1of1.part"), chunk_heading(kPlan) + record_line(0, "ok,1"));
}

TEST(ChunkFile, SaysWhyItCannotBeMade) {
  VERIFIES("LASSO-GND-090~1");
  const ChunkFolder folder;
  std::filesystem::remove(folder.path() / "chunks");
  std::ofstream(folder.path() / "chunks") << "a file";
  const std::string message = message_of<InputError>([&] { const ChunkFile file(folder.path(), "1of1", kPlan); });
  EXPECT_NE(message.find("chunks: cannot be opened for writing: Not a directory"), std::string::npos) << message;
}

// Where the file system has no locks.
TEST(ChunkFile, SaysThatAnotherProcessHasReplacedIt) {
  VERIFIES("LASSO-GND-090~1");
  const ChunkFolder folder;
  ChunkFile file(folder.path(), "1of1", kPlan);
  file.append(0, "ok");
  const auto path = folder.path() / "chunks/1of1.part";
  std::filesystem::copy_file(path, folder.path() / "copy");
  std::filesystem::rename(folder.path() / "copy", path);
  const std::string message = message_of<RunError>([&] { file.complete(); });
  EXPECT_NE(message.find("1of1.part: another process has replaced it"), std::string::npos) << message;
}

}  // namespace
}  // namespace lasso::mdat
