#include "bsp/posix/udp_peers.hpp"

#include <string>

#include "fsw/link/link_report.hpp"
#include "ut/link/command_packets.hpp"

namespace lasso::posix {
namespace {

using std::chrono::seconds;

sockaddr_in at_port(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_addr.s_addr = 1;
  address.sin_port = port;
  return address;
}

test::Stream answer_to(const test::Stream& command) {
  Verification verification;
  verification.packet_id = static_cast<std::uint16_t>(command_key(test::view(command)) >> 16);
  verification.sequence_control = static_cast<std::uint16_t>(command_key(test::view(command)));
  PacketHeader header;
  header.service = kServiceVerification;
  header.subservice = kSubserviceRefused;
  test::Stream packet(kMaxLinkReportBytes);
  packet.resize(encode_verification(verification, header, Bytes(packet.data(), packet.size())));
  return packet;
}

class UdpPeersTest : public ::testing::Test {
 protected:
  bool hears(std::uint16_t port, const test::Stream& bytes, int at_s = 0) {
    return peers_.heard(at_port(port), test::view(bytes), UdpPeers::Time(seconds(at_s)));
  }
  // A valid command, after so many seconds.
  void command(std::uint16_t port, int at_s) {
    EXPECT_TRUE(hears(port, test::ping(port), at_s));
    peers_.vouch(UdpPeers::Time(seconds(at_s)));
  }
  // Ports that a packet goes to.
  std::string told(const test::Stream& packet = {1, 2, 3}) const {
    std::string ports;
    for (const sockaddr_in& address : peers_.receivers(test::view(packet))) ports += std::to_string(address.sin_port) + " ";
    return ports;
  }
  UdpPeers peers_;
};

TEST_F(UdpPeersTest, WhatNobodyVouchesForMovesNothing) {
  VERIFIES("LASSO-LNK-041~2");
  static_cast<void>(hears(9, {1}));
  EXPECT_EQ(told(), "");
  command(1, 0);
  for (std::uint16_t port = 100; port < 1000; ++port) static_cast<void>(hears(port, test::ping(port)));
  EXPECT_EQ(told(), "1 ");
}

TEST_F(UdpPeersTest, TheFirstStaysUntilItIsSilentAndTheOthersMakeWayForEachOther) {
  VERIFIES("LASSO-LNK-041~2");
  for (std::uint16_t port = 1; port <= 4; ++port) command(port, port);
  EXPECT_EQ(told(), "1 2 3 4 ");
  command(2, 5);
  command(5, 6);
  EXPECT_EQ(told(), "1 2 5 4 ") << "3 was silent longest, but for the first";
  command(6, 30);
  EXPECT_EQ(told(), "1 2 5 6 ");
  command(7, 31);
  EXPECT_EQ(told(), "2 5 6 7 ") << "30 s are over";
  command(2, 100);
  EXPECT_EQ(told(), "2 5 6 7 ") << "while nobody new comes, the silent ones are told";
  command(8, 101);
  EXPECT_EQ(told(), "2 8 ");
}

TEST_F(UdpPeersTest, ACrowdOfStrangersIsNotLookedAtAndWhoHasAPlaceIs) {
  VERIFIES("LASSO-LNK-040~2");
  command(1, 10);
  int looked_at = 0;
  for (int i = 0; i < 3000; ++i) looked_at += hears(9, {1}, 10) ? 1 : 0;
  EXPECT_EQ(looked_at, UdpPeers::kStrangersPerSecond - 1) << "and the first command's";
  EXPECT_TRUE(hears(1, {1}, 10));
  EXPECT_TRUE(hears(9, {1}, 11)) << "the next second";
}

TEST_F(UdpPeersTest, WhoIsConfiguredIsToldAlwaysAndOnce) {
  VERIFIES("LASSO-LNK-041~2");
  peers_.configure(at_port(50));
  EXPECT_EQ(told(), "50 ");
  command(50, 0);
  for (std::uint16_t port = 1; port <= 9; ++port) command(port, 100 * port);
  EXPECT_EQ(told(), "50 9 ");
}

TEST_F(UdpPeersTest, AnAnswerGoesToWhoAskedToo) {
  VERIFIES("LASSO-LNK-041~2");
  command(1, 0);
  static_cast<void>(hears(2, test::set_mode(99, 77)));
  EXPECT_EQ(told(answer_to(test::set_mode(99, 77))), "1 2 ");
  EXPECT_EQ(told(answer_to(test::ping(78))), "1 ");
  EXPECT_EQ(told(answer_to(test::ping(1))), "1 ") << "once";
  EXPECT_EQ(told(), "1 ");
  for (std::uint16_t i = 0; i < 64; ++i) static_cast<void>(hears(3, {1}));
  EXPECT_EQ(told(answer_to(test::set_mode(99, 77))), "1 ") << "too long ago";
  EXPECT_EQ(told(answer_to({})), "1 3 ") << "what is there of it names it";
}

}  // namespace
}  // namespace lasso::posix
