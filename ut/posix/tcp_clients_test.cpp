#include "bsp/posix/tcp_clients.hpp"

#include <fcntl.h>
#include <sys/socket.h>

#include "ut/link/command_packets.hpp"

namespace lasso::posix {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using test::Stream;
using test::view;

const TcpClients::Time kBegin = TcpClients::Time() + std::chrono::hours(1);

class TcpClientsTest : public ::testing::Test {
 protected:
  // The client's end.
  Descriptor connect(TcpClients::Time now = kBegin) {
    int ends[2];
    EXPECT_EQ(socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, ends), 0);
    clients_.add(Descriptor(ends[0]), now);
    return Descriptor(ends[1]);
  }
  static void send(const Descriptor& client, const Stream& bytes) {
    ASSERT_EQ(::send(client.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL), static_cast<ssize_t>(bytes.size()));
  }
  Stream read(TcpClients::Time now = kBegin) {
    Stream packet(2000);
    packet.resize(clients_.read(Bytes(packet.data(), packet.size()), now));
    return packet;
  }
  static Stream told(const Descriptor& client) {
    Stream bytes(2000);
    const ssize_t size = recv(client.get(), bytes.data(), bytes.size(), 0);
    bytes.resize(counted(size));
    return bytes;
  }
  static bool is_sent_away(const Descriptor& client) {
    std::uint8_t byte = 0;
    return recv(client.get(), &byte, 1, 0) == 0;
  }
  // Who of the two is told.
  char holder(const Descriptor& a, const Descriptor& b) {
    EXPECT_TRUE(clients_.write(view(Stream{7})));
    const bool first = !told(a).empty(), second = !told(b).empty();
    EXPECT_NE(first, second);
    return first ? 'a' : 'b';
  }

  // Connected, and vouched for by a command.
  Descriptor connect_operator() {
    Descriptor operators = connect();
    send(operators, test::ping(1));
    EXPECT_EQ(read(), test::ping(1));
    clients_.vouch(kBegin);
    return operators;
  }

  TcpClients clients_{Heard{}};
};

TEST_F(TcpClientsTest, EachClientsPacketsAreItsOwnWhateverOthersSend) {
  VERIFIES("LASSO-LNK-048~2");
  const Descriptor a = connect(), b = connect();
  const Stream one = test::ping(1), two = test::ping(2);
  send(a, {0x1B, 0xD1, 0xC0, 0x00, 0x00, 0xFF, 1, 2, 3});  // what begins a long packet
  send(b, {two.begin(), two.begin() + 5});
  EXPECT_EQ(read(), Stream());
  send(a, Stream(40, 0x55));
  send(b, {two.begin() + 5, two.end()});
  EXPECT_EQ(read(), two) << "not torn";
  EXPECT_EQ(read(), Stream());
  EXPECT_EQ(read(kBegin + seconds(2)), Stream());
  send(a, one);
  EXPECT_EQ(read(kBegin + seconds(4)), one) << "what only seemed to begin is looked behind";
}

TEST_F(TcpClientsTest, TheirPacketsComeInTurns) {
  VERIFIES("LASSO-LNK-048~2");
  const Descriptor a = connect(), b = connect();
  Stream flood;
  for (std::uint16_t i = 0; i < 50; ++i) test::append(flood, test::ping(100));
  send(a, flood);
  send(b, test::ping(1));
  const Stream first = read(), second = read();
  EXPECT_TRUE(first == test::ping(1) || second == test::ping(1));
}

TEST_F(TcpClientsTest, WhoNeverCommandedGivesWayToWhoDoes) {
  VERIFIES("LASSO-LNK-048~2");
  const Descriptor a = connect(), b = connect();
  EXPECT_EQ(holder(a, b), 'a') << "the first";
  send(b, test::ping(1));
  EXPECT_EQ(read(), test::ping(1));
  EXPECT_EQ(holder(a, b), 'a') << "nobody vouches for it yet";
  clients_.vouch(kBegin);
  EXPECT_EQ(holder(a, b), 'b');
  send(a, test::ping(2));
  EXPECT_EQ(read(kBegin + seconds(29)), test::ping(2));
  clients_.vouch(kBegin + seconds(29));
  EXPECT_EQ(holder(a, b), 'b') << "who commands keeps it";
  send(a, test::ping(3));
  EXPECT_EQ(read(kBegin + seconds(31)), test::ping(3));
  clients_.vouch(kBegin + seconds(31));
  EXPECT_EQ(holder(a, b), 'a') << "silent for 30 s";
}

TEST_F(TcpClientsTest, WhoIsSilentIsSentAwayAfter30SecondsWhereSomebodyWaits) {
  VERIFIES("LASSO-LNK-048~2");
  const Descriptor a = connect();
  read(kBegin + seconds(100));
  EXPECT_FALSE(is_sent_away(a)) << "it keeps nobody from anything";
  const Descriptor b = connect(kBegin + seconds(100));
  read(kBegin + seconds(100));
  EXPECT_TRUE(is_sent_away(a));
  EXPECT_TRUE(clients_.write(view(Stream{7})));
  EXPECT_EQ(told(b), Stream{7});
}

TEST_F(TcpClientsTest, WhoWaitsIsToldAfter30SecondsAtTheLatest) {
  VERIFIES("LASSO-LNK-048~2");
  const Descriptor a = connect(), b = connect(kBegin + seconds(1)), c = connect(kBegin + seconds(1));
  read(kBegin + milliseconds(29'999));
  EXPECT_EQ(holder(a, c), 'a');
  read(kBegin + seconds(30));
  EXPECT_TRUE(is_sent_away(a));
  EXPECT_EQ(holder(b, c), 'a') << "b waits longer than c";
  read(kBegin + seconds(31));
  EXPECT_TRUE(is_sent_away(b));
  EXPECT_TRUE(clients_.write(view(Stream{7})));
  EXPECT_EQ(told(c), Stream{7});
}

// Somebody who only listens has commanded before: a stranger who says nothing takes nothing from it.
TEST_F(TcpClientsTest, AnOperatorWhoListensKeepsItsPlaceBesideStrangers) {
  VERIFIES("LASSO-LNK-048~2");
  const Descriptor operators = connect_operator();
  std::vector<Descriptor> strangers;
  for (int i = 0; i < 10; ++i) strangers.push_back(connect(kBegin + seconds(31)));
  read(kBegin + seconds(62));
  EXPECT_EQ(clients_.size(), TcpClients::kClients);
  EXPECT_FALSE(is_sent_away(operators));
  EXPECT_EQ(holder(operators, strangers.back()), 'a');
}

TEST_F(TcpClientsTest, OfOperatorsAloneWhoIsSilentLongestMakesWay) {
  VERIFIES("LASSO-LNK-048~2");
  std::vector<Descriptor> operators;
  for (std::uint16_t i = 0; i < TcpClients::kClients; ++i) {
    operators.push_back(connect());
    send(operators.back(), test::ping(i));
    ASSERT_EQ(read(), test::ping(i));
    clients_.vouch(kBegin + seconds(i == 1 ? 0 : 5));
  }
  const Descriptor early = connect(kBegin + seconds(29));
  EXPECT_TRUE(is_sent_away(early));
  const Descriptor late = connect(kBegin + seconds(30));
  EXPECT_FALSE(is_sent_away(late));
  EXPECT_TRUE(is_sent_away(operators[1]));
}

// What the component says of the command `asked`.
Stream answer_to(const Stream& asked) {
  Stream answer(64);
  ByteWriter writer{Bytes(answer.data(), answer.size())};
  PacketHeader header;
  header.service = 1;
  header.subservice = 2;
  begin_packet(header, writer);
  writer.bytes({asked.data(), 4});
  writer.u8(13);
  answer.resize(finish_packet(writer, Bytes(answer.data(), answer.size())));
  return answer;
}

TEST_F(TcpClientsTest, AnAnswerGoesToWhoAsked) {
  VERIFIES("LASSO-LNK-048~2");
  const Descriptor a = connect(), b = connect();
  send(b, test::ping(9));
  ASSERT_EQ(read(), test::ping(9));
  const Stream answer = answer_to(test::ping(9));
  EXPECT_TRUE(clients_.write(view(answer)));
  EXPECT_EQ(told(b), answer);
  EXPECT_EQ(told(a), Stream());
}

// As by an upload beside a monitor.
TEST_F(TcpClientsTest, TheAnswersOfSeveralCommandsInOneFrameAllGoToWhoAsked) {
  VERIFIES("LASSO-LNK-054~2");
  const Descriptor holder = connect_operator(), b = connect();
  Stream commands;
  for (std::uint16_t i = 0; i < TcpClients::kAsked; ++i) test::append(commands, test::ping(static_cast<std::uint16_t>(100 + i)));
  send(b, commands);
  for (std::uint16_t i = 0; i < TcpClients::kAsked; ++i) ASSERT_EQ(read(), test::ping(static_cast<std::uint16_t>(100 + i)));
  for (std::uint16_t i = 0; i < TcpClients::kAsked; ++i) {
    const Stream answer = answer_to(test::ping(static_cast<std::uint16_t>(100 + i)));
    EXPECT_TRUE(clients_.write(view(answer)));
    ASSERT_EQ(told(b), answer) << i;
  }
  EXPECT_EQ(told(holder), Stream());
}

// The later one is refused for its count: its operator has to hear of that.
TEST_F(TcpClientsTest, OfOperatorsWithTheSameCountWhoSentItLastIsAnswered) {
  VERIFIES("LASSO-LNK-054~2");
  const Descriptor a = connect_operator(), b = connect_operator();
  for (const Descriptor* one : {&a, &b, &a}) {
    const Descriptor& other = one == &a ? b : a;
    send(*one, test::ping(7));
    ASSERT_EQ(read(), test::ping(7));
    send(*one, test::ping(8));
    ASSERT_EQ(read(), test::ping(8));
    EXPECT_TRUE(clients_.write(view(answer_to(test::ping(7)))));
    EXPECT_EQ(told(*one), answer_to(test::ping(7)));
    EXPECT_EQ(told(other), Stream());
  }
}

TEST_F(TcpClientsTest, NobodyGetsTheAnswerOfAnOperatorByItsCount) {
  VERIFIES("LASSO-LNK-048~2");
  const Descriptor stranger = connect(), a = connect(), b = connect();
  for (const Descriptor* one : {&a, &b}) {
    send(*one, test::ping(one == &a ? 8 : 9));
    ASSERT_EQ(read(), test::ping(one == &a ? 8 : 9));
    clients_.vouch(kBegin);
  }
  send(stranger, test::ping(9));
  ASSERT_EQ(read(), test::ping(9));
  EXPECT_TRUE(clients_.write(view(answer_to(test::ping(9)))));
  EXPECT_EQ(told(b), answer_to(test::ping(9)));
  EXPECT_EQ(told(stranger), Stream());
}

TEST_F(TcpClientsTest, ACrowdOfStrangersTakesNothingFromTheOperator) {
  VERIFIES("LASSO-LNK-048~2");
  const Descriptor operators = connect_operator();
  std::vector<Descriptor> strangers;
  for (int i = 0; i < 10; ++i) strangers.push_back(connect());
  EXPECT_EQ(clients_.size(), TcpClients::kClients);
  EXPECT_TRUE(clients_.write(view(Stream{7})));
  EXPECT_EQ(told(operators), Stream{7});
  EXPECT_TRUE(is_sent_away(strangers.front()));
  EXPECT_FALSE(is_sent_away(strangers.back()));
}

TEST_F(TcpClientsTest, WhoGoesIsForgotten) {
  VERIFIES("LASSO-LNK-048~2");
  {
    const Descriptor a = connect();
    send(a, test::ping(1));
  }
  EXPECT_EQ(read(), test::ping(1)) << "what it sent before";
  EXPECT_EQ(read(), Stream());
  EXPECT_EQ(clients_.size(), 0U);
  clients_.vouch(kBegin);
  EXPECT_TRUE(clients_.write(view(Stream{7}))) << "it is lost";
}

// A packet of telemetry that a full socket took in part goes on where it stopped.
TEST_F(TcpClientsTest, APacketThatWasBegunIsSentToItsEnd) {
  VERIFIES("LASSO-LNK-048~2");
  const Descriptor a = connect();
  const Stream packet(5000, 0x77);
  std::size_t taken = 0, came = 0;
  for (; clients_.write(view(packet)) && taken < 1000; ++taken) {
  }
  ASSERT_LT(taken, 1000U);
  // The rest of the packet that was begun goes with the next one.
  for (bool more = true; more; more = came < taken * packet.size()) {
    Stream bytes(100000);
    const std::size_t size = counted(recv(a.get(), bytes.data(), bytes.size(), 0));
    came += size;
    if (size > 0) continue;
    ASSERT_LT(came % packet.size(), packet.size());
    taken += clients_.write(view(packet)) ? 1U : 0U;
  }
  EXPECT_EQ(came, taken * packet.size());
}

}  // namespace
}  // namespace lasso::posix
