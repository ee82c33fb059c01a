#include "mdat/link/telemetry_receiver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "hal_sim/random.hpp"
#include "ut/mdat/link/some_telemetry.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// The counts of the packets that come.
std::vector<std::uint64_t> received_counts(TelemetryReceiver& receiver, PieceLink& link) {
  std::vector<std::uint64_t> counts;
  const auto listener = [&](const DecodedPacket& packet) { counts.push_back(packet.header.at(5)); };
  while (receiver.take(link, listener)) {
  }
  return counts;
}

// Headers and nothing else.
TelemetryBytes short_packet(std::uint16_t count) {
  TelemetryBytes packet(64);
  ByteWriter writer{Bytes(packet.data(), packet.size())};
  PacketHeader header;
  header.sequence_count = count;
  begin_packet(header, writer);
  packet.resize(finish_packet(writer, Bytes(packet.data(), packet.size())));
  return packet;
}

std::size_t number_below(sim::Random& random, std::size_t end) {
  return std::min(end - 1, static_cast<std::size_t>(random.uniform() * static_cast<double>(end)));
}

// Noise of any length between packets, some of which are damaged, in pieces of any size.
TEST(TelemetryReceiver, EachWholePacketIsFoundAndEachOtherByteCounted) {
  VERIFIES("LASSO-GND-162~1");
  sim::Random random(17);
  TelemetryBytes stream;
  std::vector<std::uint64_t> whole;
  std::size_t bytes_of_packets = 0;
  for (std::uint16_t count = 0; count < 300; ++count) {
    TelemetryBytes packet = pose_packet(count);
    if (random.uniform() < 0.2) {
      packet[number_below(random, packet.size())] ^= static_cast<std::uint8_t>(1U << number_below(random, 8));
    } else {
      whole.push_back(count);
      bytes_of_packets += packet.size();
    }
    stream.insert(stream.end(), packet.begin(), packet.end());
    for (std::size_t i = random.uniform() < 0.5 ? 0 : number_below(random, 40); i > 0; --i)
      stream.push_back(static_cast<std::uint8_t>(number_below(random, 256)));
  }
  for (int i = 0; i < 1000; ++i) stream.push_back(0);  // what may have begun a packet is none
  PieceLink link(false);
  for (std::size_t at = 0; at < stream.size();) {
    const std::size_t end = std::min(stream.size(), at + 1 + number_below(random, 2000));
    link.add({stream.begin() + static_cast<std::ptrdiff_t>(at), stream.begin() + static_cast<std::ptrdiff_t>(end)});
    at = end;
  }
  TelemetryReceiver receiver;
  EXPECT_EQ(received_counts(receiver, link), whole);
  EXPECT_EQ(receiver.other_bytes(), stream.size() - bytes_of_packets);
}

TEST(TelemetryReceiver, OfDatagramsACutOneHoldsNothingUp) {
  VERIFIES("LASSO-GND-162~1");
  PieceLink link(true);
  TelemetryBytes cut = pose_packet(1);
  cut.resize(100);
  link.add(pose_packet(0));
  link.add(cut);
  TelemetryReceiver receiver;
  EXPECT_EQ(received_counts(receiver, link), (std::vector<std::uint64_t>{0}));
  EXPECT_EQ(receiver.other_bytes(), 100U);
  TelemetryBytes two = pose_packet(2);
  const TelemetryBytes three = pose_packet(3);
  two.insert(two.end(), three.begin(), three.end());
  link.add(two);
  EXPECT_EQ(received_counts(receiver, link), (std::vector<std::uint64_t>{2, 3}));
}

TEST(TelemetryReceiver, APacketBehindWhatOnlyBeganOneComesAfterASecondOfSilence) {
  VERIFIES("LASSO-GND-162~1");
  PieceLink link(false);
  TelemetryBytes bytes = pose_packet(1);
  bytes.resize(20);
  const TelemetryBytes whole = short_packet(2);
  bytes.insert(bytes.end(), whole.begin(), whole.end());
  TelemetryReceiver receiver;
  link.add(bytes);
  EXPECT_TRUE(received_counts(receiver, link).empty()) << "the rest of the first one may come";
  std::this_thread::sleep_for(std::chrono::milliseconds(1050));
  EXPECT_EQ(received_counts(receiver, link), (std::vector<std::uint64_t>{2}));
  EXPECT_EQ(receiver.other_bytes(), 20U);
}

}  // namespace
}  // namespace lasso::mdat
