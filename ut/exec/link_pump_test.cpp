#include "fsw/exec/link_pump.hpp"

#include <deque>

#include "ut/exec/component_operator.hpp"

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

}  // namespace
}  // namespace lasso
