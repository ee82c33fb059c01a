#include "bsp/posix/line_pump.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <vector>

#include "ut/support/verifies.hpp"

namespace lasso::posix {
namespace {

// More bytes than a ring holds, both ways, by rings that are drained in pieces: none is lost, none twice, all in order.
TEST(LinePump, CarriesMoreThanItsRingsHold) {
  VERIFIES("LASSO-LCS-004~1 LASSO-SIM-031~1");
  constexpr std::size_t kBytes = 5 * lcs::kLineBytes;
  LineServer server;
  ASSERT_EQ(server.listen("tcp://127.0.0.1:0", false), "");
  SerialLine ends[2];
  ASSERT_EQ(ends[0].open(server.address(), 4000000, false), "");
  for (int i = 0; i < 5000 && !server.accept(ends[1]); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ASSERT_TRUE(ends[1].is_open());
  lcs::Line rings[2];
  const auto value = [](std::size_t i) { return static_cast<std::uint8_t>(i * 7 + i / 251); };
  std::size_t sent[2] = {}, got[2] = {};
  bool right = true;
  {
    LinePump pumps[2] = {{ends[0], rings[0]}, {ends[1], rings[1]}};
    for (int i = 0; i < 20000 && (got[0] < kBytes || got[1] < kBytes); ++i) {
      for (int end = 0; end < 2; ++end) {
        for (std::uint8_t byte = value(sent[end]); sent[end] < kBytes && rings[end].to_camera.write({&byte, 1}) == 1;
             byte = value(sent[end]))
          ++sent[end];
        std::uint8_t out[500];
        const std::size_t count = rings[end].from_camera.read(Bytes(out));
        for (std::size_t k = 0; k < count; ++k) right = right && out[k] == value(got[end]++);
      }
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    EXPECT_FALSE(pumps[0].broken());
  }
  EXPECT_EQ(got[0], kBytes);
  EXPECT_EQ(got[1], kBytes);
  EXPECT_TRUE(right);
}

TEST(LinePump, SaysThatTheOtherEndHasGoneAndSendsWhatWasGivenLast) {
  LineServer server;
  ASSERT_EQ(server.listen("tcp://127.0.0.1:0", false), "");
  SerialLine client, other;
  ASSERT_EQ(client.open(server.address(), 4000000, false), "");
  for (int i = 0; i < 5000 && !server.accept(other); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  lcs::Line rings, last;
  {
    LinePump pump(other, last);
    const std::uint8_t bytes[] = {1, 2, 3};
    last.to_camera.write(ConstBytes(bytes));
  }
  std::uint8_t heard[8];
  std::size_t count = 0;
  for (int i = 0; i < 5000 && count < 3; ++i) {
    count += client.read(Bytes(heard + count, 8 - count));
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(count, 3U);
  LinePump pump(client, rings);
  other.close();
  for (int i = 0; i < 5000 && !pump.broken(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_TRUE(pump.broken());
}

}  // namespace
}  // namespace lasso::posix
