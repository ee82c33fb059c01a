#include "fsw/exec/link_pump.hpp"

#include <cstdio>
#include <deque>

#include "ut/exec/component_operator.hpp"
#include "ut/link/keyed_sum.hpp"

namespace lasso {
namespace {

using test::Link;
using test::Stream;

// A line that gives and takes in pieces of a size.
class PieceLink final : public ByteLink {
 public:
  explicit PieceLink(bool datagrams) : datagrams_(datagrams) {}
  bool datagrams() const override { return datagrams_; }
  std::size_t read(Bytes out) override {
    if (to_component.empty()) return 0;
    Stream& front = to_component.front();
    const std::size_t size = std::min(out.size(), front.size());
    std::copy(front.begin(), front.begin() + static_cast<std::ptrdiff_t>(size), out.begin());
    front.erase(front.begin(), front.begin() + static_cast<std::ptrdiff_t>(size));
    if (datagrams_ || front.empty()) to_component.pop_front();
    return size;
  }
  std::size_t write(ConstBytes packets) override {
    if (datagrams_ && packets.size() > room) return 0;
    const std::size_t size = std::min({packets.size(), room, most});
    room -= size;
    from_component.insert(from_component.end(), packets.begin(), packets.begin() + size);
    if (datagrams_) sizes.push_back(size);
    return size;
  }

  std::deque<Stream> to_component;
  Stream from_component;
  std::vector<std::size_t> sizes;  // of datagrams
  std::size_t room = 1U << 20;
  std::size_t most = 1U << 20;  // of one call

 private:
  bool datagrams_;
};

std::size_t pongs(const Stream& stream) {
  std::size_t count = 0;
  for (const test::Packet& packet : test::packets_of(stream)) count += packet.is(17, 2) ? 1U : 0U;
  return count;
}

void run_frame(Component& component, LinkPump& pump) {
  do {
    pump.receive(component.next_slot_us());
    component.run_slot(component.next_slot_us());
    component.run_estimation();
    pump.send();
  } while (!component.next_slot_is_boundary());
}

TEST(LinkPump, CommandsAndAnswersPassInPiecesAndWhole) {
  VERIFIES("LASSO-LNK-026~2");
  for (const bool datagrams : {false, true}) {
    Link link;
    PieceLink line(datagrams);
    LinkPump pump(link.component(), line);
    for (std::uint16_t i = 0; i < 40; ++i) line.to_component.push_back(test::ping(i));  // more than frames answer
    if (!datagrams) {
      Stream all;
      for (const Stream& each : line.to_component) test::append(all, each);
      line.to_component = {all};
    }
    for (int frame = 0; frame < 8; ++frame) run_frame(link.component(), pump);
    EXPECT_EQ(pongs(line.from_component), 40u) << (datagrams ? "datagrams" : "stream");
    EXPECT_TRUE(line.to_component.empty());
    for (const std::size_t size : line.sizes) EXPECT_GE(size, 22u);
    if (datagrams) {
      EXPECT_EQ(line.sizes.size(), test::packets_of(line.from_component).size()) << "one packet each";
    }
  }
}

TEST(LinkPump, ALineThatTakesLittleGetsEverythingInTheEnd) {
  VERIFIES("LASSO-LNK-026~2");
  for (const bool datagrams : {false, true}) {
    Link fast, slow;
    PieceLink wide(datagrams), narrow(datagrams);
    LinkPump to_wide(fast.component(), wide), to_narrow(slow.component(), narrow);
    narrow.room = 0;
    for (int slot = 0; slot < 25 * 5; ++slot) {
      narrow.room += datagrams ? 200 : 130;
      for (auto [link, pump] : {std::pair{&fast, &to_wide}, std::pair{&slow, &to_narrow}}) {
        link->component().run_slot(link->component().next_slot_us());
        link->component().run_estimation();
        pump->send();
      }
    }
    narrow.room = 1U << 20;
    to_narrow.send();
    EXPECT_GT(wide.from_component.size(), 2000u);
    EXPECT_EQ(narrow.from_component, wide.from_component);
  }
}

TEST(LinkPump, ACallDoesBoundedWork) {
  VERIFIES("LASSO-LNK-026~2");
  Link link;
  PieceLink line(false);
  LinkPump pump(link.component(), line);
  line.to_component.push_back(Stream(6000, 0x55));
  pump.receive(0);
  ASSERT_FALSE(line.to_component.empty());
  EXPECT_EQ(line.to_component.front().size(), 6000U - 16U * (kMaxCommandBytes + 1));
  pump.receive(0);
  EXPECT_TRUE(line.to_component.empty());
  for (int frame = 0; frame < 4; ++frame) {
    do {
      link.component().run_slot(link.component().next_slot_us());
      link.component().run_estimation();
    } while (!link.component().next_slot_is_boundary());
  }
  line.most = 5;
  pump.send();
  EXPECT_LE(line.from_component.size(), 64U * 5);
  EXPECT_GT(line.from_component.size(), 60U * 5) << "the last piece of a packet may be shorter";
}

TEST(LinkPump, ADatagramThatIsTooLongIsRefused) {
  VERIFIES("LASSO-LNK-026~2");
  Link link;
  PieceLink line(true);
  LinkPump pump(link.component(), line);
  line.to_component.push_back(Stream(kMaxCommandBytes + 100, 0x55));
  pump.receive(0);
  pump.send();
  const std::vector<test::Packet> answers = test::packets_of(line.from_component);
  ASSERT_EQ(answers.size(), 1u);
  EXPECT_TRUE(answers[0].is(1, 2));
}

// Nobody who may command: what the flood of a frame is made of, one kind after the other.
Stream bad_packet(std::uint32_t number) {
  Stream packet = test::ping(static_cast<std::uint16_t>(number & kSequenceCountMask));
  if (number % 5 == 0) return {0x1B};
  if (number % 5 == 1) packet.back() ^= 1;
  if (number % 5 == 2) packet.resize(9);
  if (number % 5 == 3) return test::with_sum(test::ping(0));  // recorded, and sent again
  return packet;                                              // whole, but not signed
}

struct FloodFigures {
  std::uint32_t bad = 0, commands = 0, answered = 0, latest_slots = 0;
  std::uint32_t telemetry = 0;  // packets
  std::uint32_t inhibited = 0;  // events that the laser is inhibited
};

// `per_slot` bad packets come in each slot, before a command of the operator in each tenth frame: the laser is inhibited. What the ground's
// queue of the link does not hold is lost, as in a socket.
FloodFigures fly_through(std::uint32_t per_slot) {
  constexpr std::size_t kSocketHolds = 277;  // datagrams of some bytes, of Linux' preset
  constexpr std::uint32_t kFrames = 100;
  Link link;
  test::OnceSum authenticator;
  link.component().use_authenticator(authenticator);
  PieceLink line(true);
  LinkPump pump(link.component(), line);
  FloodFigures figures;
  std::uint32_t sent_at = 0, open = 0;
  line.to_component.push_back(test::with_sum(test::ping(0)));
  for (std::uint32_t slot = 0; slot < kFrames * kSlotsPerFrame; ++slot) {
    for (std::uint32_t i = 0; i < per_slot && line.to_component.size() < kSocketHolds; ++i)
      line.to_component.push_back(bad_packet(figures.bad + i));
    figures.bad += per_slot;
    if (slot % (10 * kSlotsPerFrame) == kSlotsPerFrame) {
      ++figures.commands;
      open = 1;
      sent_at = slot;
      const Stream command = test::with_sum(test::plain_packet(CommandKind::kInhibitLaser, static_cast<std::uint16_t>(figures.commands)));
      if (line.to_component.size() < kSocketHolds) line.to_component.push_back(command);
    }
    pump.receive(link.component().next_slot_us());
    link.component().run_slot(link.component().next_slot_us());
    link.component().run_estimation();
    pump.send();
    for (const test::Packet& packet : test::packets_of(line.from_component)) {
      ++figures.telemetry;
      if (packet.header.service == 5 && packet.data[1] == static_cast<std::uint8_t>(EventId::kLaserInhibited)) ++figures.inhibited;
      if (!packet.is(1, 7) || open == 0) continue;
      open = 0;
      ++figures.answered;
      figures.latest_slots = std::max(figures.latest_slots, slot - sent_at);
    }
    line.from_component.clear();
  }
  return figures;
}

TEST(LinkPump, AFloodOfBadPacketsCostsLittleAndHoldsNoCommandBack) {
  VERIFIES("LASSO-LNK-040~2");
  const FloodFigures quiet = fly_through(0), flood = fly_through(3);
  ASSERT_EQ(quiet.commands, 10u);
  const double each = static_cast<double>(flood.telemetry - quiet.telemetry) / flood.bad;
  std::printf(
      "300 bad packets a second: %u of %u commands answered, the latest after %u slots; %.2f packets of telemetry for each bad one\n",
      flood.answered, flood.commands, flood.latest_slots, each);
  EXPECT_EQ(quiet.answered, quiet.commands);
  EXPECT_EQ(flood.answered, flood.commands);
  EXPECT_EQ(flood.inhibited, quiet.inhibited) << "what happens is reported as without the flood";
  EXPECT_LE(flood.latest_slots, 2 * kSlotsPerFrame);
  EXPECT_LT(each, 0.15);
}

}  // namespace
}  // namespace lasso
