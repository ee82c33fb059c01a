#include "mdat/link/link_health.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "hal_sim/random.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using std::chrono::milliseconds;
constexpr std::uint16_t kCounts = 1 << 14;

// A space packet of telemetry (CCSDS 133.0-B) with six bytes of content.
std::vector<std::uint8_t> space_packet(std::uint16_t apid, std::uint16_t count) {
  std::vector<std::uint8_t> bytes = {static_cast<std::uint8_t>(apid >> 8 & 7),
                                     static_cast<std::uint8_t>(apid),
                                     static_cast<std::uint8_t>(0xC0 | (count >> 8 & 0x3F)),
                                     static_cast<std::uint8_t>(count),
                                     0,
                                     5};
  bytes.resize(12);
  return bytes;
}

ConstBytes span_of(const std::vector<std::uint8_t>& bytes) { return {bytes.data(), bytes.size()}; }

class LinkHealthTest : public ::testing::Test {
 protected:
  void take(std::uint16_t apid, std::uint16_t count, milliseconds at) { health_.take(span_of(space_packet(apid, count)), start_ + at); }
  const LinkHealth::Time start_ = LinkHealth::Time(std::chrono::hours(5));
  LinkHealth health_;
};

TEST_F(LinkHealthTest, BeforeTheFirstPacketThereIsNoAge) {
  VERIFIES("LASSO-WEB-020~1");
  EXPECT_LT(health_.age_s(start_), 0);
  EXPECT_EQ(health_.rate_per_s(start_), 0);
  EXPECT_EQ(health_.packets(), 0U);
}

TEST_F(LinkHealthTest, GapsAreThePacketsThatWereLeftOutWhereverTheCountsWrap) {
  VERIFIES("LASSO-WEB-020~1");
  sim::Random random(11);
  std::uint64_t left_out = 0, sent = 0;
  std::uint16_t counts[2] = {16000, 3};
  for (int i = 0; i < 2000; ++i) {
    const std::size_t stream = random.uniform() < 0.5 ? 0 : 1;
    const bool lost = i > 20 && i < 1990 && random.uniform() < 0.1;
    if (!lost) take(static_cast<std::uint16_t>(100 + stream), counts[stream], milliseconds(i));
    (lost ? left_out : sent) += 1;
    counts[stream] = static_cast<std::uint16_t>((counts[stream] + 1) % kCounts);
  }
  for (std::size_t stream = 0; stream < 2; ++stream) take(static_cast<std::uint16_t>(100 + stream), counts[stream], milliseconds(2000));
  EXPECT_GT(left_out, 100U);
  EXPECT_EQ(health_.missing(), left_out);
  EXPECT_EQ(health_.packets(), sent + 2);
}

TEST_F(LinkHealthTest, ARestartIsNoGap) {
  VERIFIES("LASSO-WEB-020~1");
  take(7, 500, milliseconds(0));
  take(7, 0, milliseconds(10));
  take(7, 1, milliseconds(20));
  EXPECT_EQ(health_.missing(), 0U);
}

TEST_F(LinkHealthTest, TheRateIsThatOfTheLastSeconds) {
  VERIFIES("LASSO-WEB-020~1");
  std::uint16_t count = 0;
  for (int at = 0; at < 20'000; at += 100) take(7, count++, milliseconds(at));
  EXPECT_NEAR(health_.rate_per_s(start_ + milliseconds(19'901)), 10, 0.3);
  EXPECT_NEAR(health_.rate_per_s(start_ + milliseconds(22'401)), 5, 0.3);
  EXPECT_EQ(health_.rate_per_s(start_ + milliseconds(30'000)), 0);
  EXPECT_NEAR(health_.age_s(start_ + milliseconds(30'000)), 10.1, 1e-9);
}

TEST_F(LinkHealthTest, SeveralPacketsComeTogetherAndACutOneIsLeft) {
  VERIFIES("LASSO-WEB-020~1");
  std::vector<std::uint8_t> bytes;
  for (std::uint16_t i = 0; i < 3; ++i) {
    const std::vector<std::uint8_t> one = space_packet(7, i);
    bytes.insert(bytes.end(), one.begin(), one.end());
  }
  bytes.resize(bytes.size() - 2);
  health_.take(span_of(bytes), start_);
  EXPECT_EQ(health_.packets(), 2U);
}

}  // namespace
}  // namespace lasso::mdat
