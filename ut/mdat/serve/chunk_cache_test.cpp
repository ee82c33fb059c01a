#include "mdat/serve/chunk_cache.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "ut/mdat/serve/small_recording.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::serve {
namespace {

TEST(ChunkCache, MessagesAreFoundByTopicAndTime) {
  VERIFIES("LASSO-WEB-011~1");
  const TestFolder folder;
  const mcap::IndexedFile file(SmallRecording{}.write(folder.path() / "a.mcap"));
  ChunkCache cache(file);
  const std::uint16_t truth = file.channel_of("/truth").value(), scan = file.channel_of("/scan").value();
  for (const std::size_t n : {std::size_t{5}, std::size_t{0}, std::size_t{3}, std::size_t{3}}) {
    const auto ns = static_cast<std::uint64_t>(SmallRecording::time_us(n)) * 1000;
    EXPECT_EQ(read_pose(cache.message(truth, ns)).value().pose.p, SmallRecording::truth(n).p);
    EXPECT_EQ(cache.message(truth, ns + 1), "");
    EXPECT_FALSE(cache.message(scan, ns).empty());
  }
  EXPECT_EQ(cache.message(scan, static_cast<std::uint64_t>(SmallRecording::time_us(4)) * 1000), "");  // its scan is lost
  EXPECT_EQ(read_pose(cache.first_message(truth)).value().pose.p, SmallRecording::truth(0).p);
}

TEST(ChunkCache, SeveralThreadsGetTheSame) {
  VERIFIES("LASSO-WEB-011~1");
  const TestFolder folder;
  const mcap::IndexedFile file(SmallRecording{}.write(folder.path() / "a.mcap"));
  ChunkCache cache(file);
  const std::uint16_t truth = file.channel_of("/truth").value();
  std::vector<std::thread> threads;
  std::atomic<int> right{0};
  for (std::size_t i = 0; i < 4; ++i) {
    threads.emplace_back([&, i] {
      for (std::size_t k = 0; k < 60; ++k) {
        const std::size_t n = (k + i) % 6;
        const auto pose = read_pose(cache.message(truth, static_cast<std::uint64_t>(SmallRecording::time_us(n)) * 1000));
        right += pose && pose->pose.p == SmallRecording::truth(n).p ? 1 : 0;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(right, 240);
}

}  // namespace
}  // namespace lasso::mdat::serve
