#include "fsw/link/packet_finder.hpp"

#include <array>
#include <vector>

#include "fsw/link/packet.hpp"
#include "fsw/link/telecommand.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using Stream = std::vector<std::uint8_t>;
constexpr std::size_t kRoom = 64;

Stream command(std::size_t data_bytes, std::uint8_t fill) {
  Stream packet(kCommandHeaderBytes + data_bytes + kPacketTrailerBytes);
  const Bytes out(packet.data(), packet.size());
  ByteWriter writer(out);
  begin_command(CommandHeader{}, writer);
  for (std::size_t i = 0; i < data_bytes; ++i) writer.u8(fill);
  EXPECT_EQ(finish_packet(writer, out), packet.size());
  return packet;
}

struct Found {
  std::vector<Stream> packets;
  std::uint32_t skipped = 0;
  std::size_t waiting = 0;
};

// Through a finder in pieces of at most `piece` bytes.
Found find(const Stream& stream, std::size_t piece, PacketType type = PacketType::kCommand) {
  std::array<std::uint8_t, kRoom> buffer{};
  PacketFinder finder(type, Bytes(buffer.data(), buffer.size()));
  Found found;
  for (std::size_t at = 0; at < stream.size();) {
    const std::size_t taken = finder.take({stream.data() + at, std::min(piece, stream.size() - at)});
    at += taken;
    const ConstBytes packet = finder.packet();
    if (!packet.empty()) found.packets.emplace_back(packet.begin(), packet.end());
  }
  // What a false start held back.
  for (bool more = true; more;) {
    EXPECT_EQ(finder.take({}), 0u);
    more = !finder.packet().empty();
    if (more) found.packets.emplace_back(finder.packet().begin(), finder.packet().end());
  }
  found.skipped = finder.skipped();
  found.waiting = finder.waiting();
  return found;
}

void append(Stream& stream, const Stream& more) { stream.insert(stream.end(), more.begin(), more.end()); }

TEST(PacketFinder, FindsPacketsThatFollowEachOther) {
  VERIFIES("LASSO-LNK-028~1");
  const std::vector<Stream> packets = {command(0, 0), command(5, 1), command(kRoom - 13, 2)};
  Stream stream;
  for (const Stream& packet : packets) append(stream, packet);
  for (const std::size_t piece : {1u, 2u, 7u, 1000u}) {
    const Found found = find(stream, piece);
    EXPECT_EQ(found.packets, packets) << piece;
    EXPECT_EQ(found.skipped, 0u);
    EXPECT_EQ(found.waiting, 0u);
  }
}

TEST(PacketFinder, FindsEveryPacketBetweenGarbage) {
  VERIFIES("LASSO-LNK-028~1");
  test::Generator random(5);
  for (int round = 0; round < 200; ++round) {
    Stream stream;
    std::vector<Stream> packets;
    std::uint32_t garbage = 0;
    for (int i = 0; i < 4; ++i) {
      // Half of the garbage looks like the beginning of a packet.
      const Stream start = command(0, 0);
      Stream noise(random.below(3) == 0 ? 0 : random.below(round % 10 == 0 ? 20 * kRoom : 40));
      for (std::size_t k = 0; k < noise.size(); ++k) {
        noise[k] = k < 5 && random.below(2) == 0 ? start[k] : static_cast<std::uint8_t>(random.bits());
      }
      garbage += static_cast<std::uint32_t>(noise.size());
      append(stream, noise);
      packets.push_back(command(random.below(20), static_cast<std::uint8_t>(i)));
      append(stream, packets.back());
    }
    append(stream, Stream(kRoom, 0));  // after which no false start holds back anything
    const Found found = find(stream, 1 + random.below(50));
    ASSERT_EQ(found.packets, packets) << round;
    ASSERT_EQ(found.skipped, garbage + kRoom);
    ASSERT_EQ(found.waiting, 0u);
  }
}

TEST(PacketFinder, GoesOnBehindADamagedPacket) {
  VERIFIES("LASSO-LNK-028~1");
  const Stream good = command(9, 7);
  for (std::size_t bit = 0; bit < good.size() * 8; ++bit) {
    Stream stream = good;
    stream[bit / 8] = static_cast<std::uint8_t>(stream[bit / 8] ^ (1u << (bit % 8)));
    append(stream, good);
    append(stream, Stream(kRoom, 0xFF));
    const Found found = find(stream, 11);
    ASSERT_EQ(found.packets, std::vector<Stream>{good}) << bit;
    ASSERT_EQ(found.skipped, good.size() + kRoom) << bit;
  }
}

TEST(PacketFinder, TakesNoPacketThatItsBufferCannotHold) {
  VERIFIES("LASSO-LNK-028~1");
  Stream stream = command(kRoom - 12, 1);
  const std::size_t too_large = stream.size();
  append(stream, command(3, 2));
  const Found found = find(stream, 1000);
  EXPECT_EQ(found.packets, std::vector<Stream>{command(3, 2)});
  EXPECT_EQ(found.skipped, too_large);
}

TEST(PacketFinder, LooksForOneKindOfPacket) {
  VERIFIES("LASSO-LNK-028~1");
  Stream telemetry(kPacketHeaderBytes + kPacketTrailerBytes);
  const Bytes out(telemetry.data(), telemetry.size());
  ByteWriter writer(out);
  begin_packet(PacketHeader{}, writer);
  ASSERT_EQ(finish_packet(writer, out), telemetry.size());
  Stream stream = command(1, 1);
  append(stream, telemetry);
  EXPECT_EQ(find(stream, 1000, PacketType::kTelemetry).packets, std::vector<Stream>{telemetry});
  EXPECT_EQ(find(stream, 1000, PacketType::kCommand).packets, std::vector<Stream>{command(1, 1)});
}

TEST(PacketFinder, ALengthTooSmallForAChecksumIsNoPacket) {
  VERIFIES("LASSO-LNK-028~1");
  // A header that states 7 bytes, of which the CRC would have been taken from the header.
  const Found found = find({0x1B, 0xD1, 0xC0, 0x00, 0x00, 0x00, 0x55, 0x55}, 1000);
  EXPECT_TRUE(found.packets.empty());
  EXPECT_EQ(found.skipped, 8u);
}

TEST(PacketFinder, WaitsForTheRestOfAPacket) {
  VERIFIES("LASSO-LNK-028~1");
  const Stream whole = command(4, 4);
  for (std::size_t n = 1; n < whole.size(); ++n) {
    const Found found = find(Stream(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(n)), 1000);
    EXPECT_TRUE(found.packets.empty());
    EXPECT_EQ(found.waiting, n);
    EXPECT_EQ(found.skipped, 0u);
  }
}

TEST(PacketFinder, LooksBehindWhatItGivesUp) {
  VERIFIES("LASSO-LNK-028~1");
  Stream stream = command(30, 1);
  stream.resize(20);  // the rest never comes
  append(stream, command(3, 2));
  std::array<std::uint8_t, kRoom> buffer{};
  PacketFinder finder(PacketType::kCommand, Bytes(buffer.data(), buffer.size()));
  EXPECT_FALSE(finder.give_up());
  EXPECT_EQ(finder.take({stream.data(), stream.size()}), stream.size());
  EXPECT_TRUE(finder.packet().empty());
  EXPECT_EQ(finder.waiting(), stream.size());
  EXPECT_TRUE(finder.give_up());
  finder.take({});
  EXPECT_EQ(Stream(finder.packet().begin(), finder.packet().end()), command(3, 2));
  EXPECT_EQ(finder.skipped(), 20u);
  EXPECT_FALSE(finder.give_up()) << "what was found is no part of what waits";
  EXPECT_TRUE(finder.packet().empty());
}

}  // namespace
}  // namespace lasso
