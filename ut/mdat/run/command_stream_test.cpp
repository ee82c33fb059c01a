#include "mdat/run/command_stream.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <string>
#include <vector>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using Pieces = std::vector<CommandPiece>;

// What has come for it so far.
struct Ground final : ByteLink {
  std::deque<std::string> waiting;
  std::string answered;
  bool datagrams() const override { return true; }
  std::size_t read(Bytes out) override {
    if (waiting.empty()) return 0;
    const std::size_t size = waiting.front().copy(reinterpret_cast<char*>(out.data()), out.size());
    waiting.pop_front();
    return size;
  }
  std::size_t write(ConstBytes packets) override {
    answered.append(packets.begin(), packets.end());
    return packets.size();
  }
};

struct CommandListener final : RunListener {
  Pieces pieces;
  void on_packets(TimeUs, ConstBytes) override {}
  void on_frame(const FlownFrame&) override {}
  void on_commands(TimeUs slot_us, ConstBytes bytes) override { pieces.push_back({slot_us, {bytes.begin(), bytes.end()}}); }
};

std::string read_from(ByteLink& link, std::size_t room) {
  std::vector<std::uint8_t> bytes(room);
  const std::size_t size = link.read(Bytes(bytes.data(), room));
  return {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)};
}

CommandPiece piece(TimeUs slot_us, const std::string& text) { return {slot_us, {text.begin(), text.end()}}; }

TEST(CommandStream, ListenerIsToldWhatComesAndWhen) {
  VERIFIES("LASSO-REC-021~1");
  Ground ground;
  CommandListener listener;
  TimeUs now_us = 10;
  RunLink link(&ground, nullptr, &listener, [&] { return now_us; });
  ASSERT_NE(link.get(), nullptr);
  EXPECT_EQ(read_from(*link.get(), 8), "") << "nothing has come";
  ground.waiting = {"one", "and two", "far too long"};
  EXPECT_EQ(read_from(*link.get(), 8), "one");
  now_us = 20;
  EXPECT_EQ(read_from(*link.get(), 8), "and two");
  EXPECT_EQ(read_from(*link.get(), 8), "far too ") << "what is lost to the component is lost to the listener";
  ASSERT_EQ(listener.pieces.size(), 3U);
  EXPECT_EQ(listener.pieces[0].slot_us, 10);
  EXPECT_EQ(listener.pieces[1].slot_us, 20);
  EXPECT_EQ(std::string(listener.pieces[2].bytes.begin(), listener.pieces[2].bytes.end()), "far too ");
  EXPECT_TRUE(link.get()->datagrams());
  const std::string answer = "pong";
  EXPECT_EQ(link.get()->write(ConstBytes(reinterpret_cast<const std::uint8_t*>(answer.data()), answer.size())), 4U);
  EXPECT_EQ(ground.answered, "pong");
}

TEST(CommandStream, ComesAgainInItsSlots) {
  VERIFIES("LASSO-REC-021~1");
  const CommandStream stream{true, {piece(10, "one"), piece(10, "two"), piece(30, "three")}};
  TimeUs now_us = 0;
  RunLink link(nullptr, &stream, nullptr, [&] { return now_us; });
  EXPECT_EQ(read_from(*link.get(), 8), "") << "before its slot";
  now_us = 10;
  EXPECT_EQ(read_from(*link.get(), 8), "one");
  EXPECT_EQ(read_from(*link.get(), 2), "tw") << "a datagram, whose rest is lost";
  EXPECT_EQ(read_from(*link.get(), 8), "");
  now_us = 40;
  EXPECT_EQ(read_from(*link.get(), 8), "three") << "later is better than never";
  EXPECT_EQ(read_from(*link.get(), 8), "");
  EXPECT_EQ(link.get()->write(ConstBytes(stream.pieces[0].bytes.data(), 3)), 3U) << "answers go nowhere, and are no trouble";
}

TEST(CommandStream, OfBytesLosesNone) {
  VERIFIES("LASSO-REC-021~1");
  const CommandStream stream{false, {piece(10, "seven of"), piece(10, "them")}};
  RunLink link(nullptr, &stream, nullptr, [] { return TimeUs{10}; });
  EXPECT_FALSE(link.get()->datagrams());
  EXPECT_EQ(read_from(*link.get(), 5), "seven");
  EXPECT_EQ(read_from(*link.get(), 5), " of");
  EXPECT_EQ(read_from(*link.get(), 5), "them");
}

// A link goes before what was recorded; nobody has to listen to it.
TEST(CommandStream, NoLinkAtAllIsNone) {
  VERIFIES("LASSO-REC-021~1");
  Ground ground;
  const CommandStream stream{false, {piece(0, "old")}};
  const SlotClock clock = [] { return TimeUs{0}; };
  EXPECT_EQ(RunLink(nullptr, nullptr, nullptr, clock).get(), nullptr);
  EXPECT_EQ(RunLink(&ground, &stream, nullptr, clock).get(), &ground);
}

}  // namespace
}  // namespace lasso::mdat
