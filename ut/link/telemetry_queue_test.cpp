#include "fsw/link/telemetry_queue.hpp"

#include <array>
#include <deque>
#include <vector>

#include "fsw/link/packet.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

std::vector<std::uint8_t> packet_of(std::size_t data_bytes, std::uint8_t fill) {
  std::vector<std::uint8_t> packet(kPacketHeaderBytes + data_bytes + kPacketTrailerBytes);
  const Bytes out(packet.data(), packet.size());
  ByteWriter writer(out);
  begin_packet(PacketHeader{}, writer);
  for (std::size_t i = 0; i < data_bytes; ++i) writer.u8(fill);
  EXPECT_EQ(finish_packet(writer, out), packet.size());
  return packet;
}

ConstBytes span_of(const std::vector<std::uint8_t>& bytes) { return ConstBytes(bytes.data(), bytes.size()); }

std::vector<std::uint8_t> take(TelemetryQueue& queue, std::size_t room) {
  std::vector<std::uint8_t> out(room);
  out.resize(queue.take(Bytes(out.data(), room)));
  return out;
}

TEST(TelemetryQueue, GivesWholePacketsInOrder) {
  VERIFIES("LASSO-LNK-006~1");
  TelemetryQueue queue;
  const auto first = packet_of(10, 1);
  const auto second = packet_of(20, 2);
  ASSERT_EQ(queue.push(span_of(first)), Status::kOk);
  ASSERT_EQ(queue.push(span_of(second)), Status::kOk);
  EXPECT_TRUE(take(queue, first.size() - 1).empty());
  EXPECT_EQ(take(queue, first.size() + second.size() - 1), first);
  EXPECT_EQ(take(queue, 1000), second);
  EXPECT_EQ(queue.size(), 0u);
  EXPECT_EQ(queue.peak(), first.size() + second.size());
}

TEST(TelemetryQueue, DropsAndCountsWhatDoesNotFit) {
  VERIFIES("LASSO-LNK-006~1");
  TelemetryQueue queue;
  const auto large = packet_of(kTelemetryQueueBytes - 30, 1);
  ASSERT_EQ(queue.push(span_of(large)), Status::kOk);
  EXPECT_EQ(queue.push(span_of(packet_of(10, 2))), Status::kOverCapacity);
  EXPECT_EQ(queue.dropped(), 1u);
  EXPECT_EQ(take(queue, kTelemetryQueueBytes), large);
}

TEST(TelemetryQueue, KeepsRoomForAnswersBehindAllElse) {
  VERIFIES("LASSO-LNK-006~1 LASSO-LNK-040~2");
  TelemetryQueue queue;
  const auto large = packet_of(kTelemetryQueueBytes - 30, 1), answer = packet_of(kAnswerBytes / 2 - 24, 2);
  ASSERT_EQ(queue.push(span_of(large)), Status::kOk);
  EXPECT_EQ(queue.push(span_of(answer)), Status::kOverCapacity);
  EXPECT_EQ(queue.push_answer(span_of(answer)), Status::kOk);
  EXPECT_EQ(queue.push_answer(span_of(answer)), Status::kOk);
  EXPECT_EQ(queue.push_answer(span_of(answer)), Status::kOverCapacity);
  EXPECT_EQ(take(queue, kTelemetryQueueBytes), large) << "in order";
  EXPECT_EQ(take(queue, answer.size()), answer);
  EXPECT_EQ(queue.push(span_of(large)), Status::kOverCapacity) << "an answer takes the others' room, too";
  EXPECT_EQ(take(queue, answer.size()), answer);
}

TEST(TelemetryQueue, RefusesWhatIsNotOnePacket) {
  VERIFIES("LASSO-LNK-006~1");
  TelemetryQueue queue;
  auto packet = packet_of(10, 1);
  packet.push_back(0);
  EXPECT_EQ(queue.push(span_of(packet)), Status::kBadLength);
  EXPECT_EQ(queue.push(ConstBytes()), Status::kBadLength);
  EXPECT_EQ(queue.size(), 0u);
  EXPECT_EQ(queue.dropped(), 0u);
}

TEST(TelemetryQueue, AgreesWithAListThroughManyTurnsOfTheRing) {
  VERIFIES("LASSO-LNK-006~1");
  TelemetryQueue queue;
  std::deque<std::vector<std::uint8_t>> model;
  test::Generator random(3);
  std::size_t model_bytes = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto packet = packet_of(random.below(900), static_cast<std::uint8_t>(i));
    const bool fits = model_bytes + packet.size() <= kTelemetryQueueBytes;
    EXPECT_EQ(queue.push(span_of(packet)), fits ? Status::kOk : Status::kOverCapacity);
    if (fits) model.push_back(packet);
    if (fits) model_bytes += packet.size();
    if (random.below(3) != 0 || model.empty()) continue;
    std::vector<std::uint8_t> expected;
    const std::size_t room = random.below(3000);
    while (!model.empty() && expected.size() + model.front().size() <= room) {
      expected.insert(expected.end(), model.front().begin(), model.front().end());
      model_bytes -= model.front().size();
      model.pop_front();
    }
    ASSERT_EQ(take(queue, room), expected);
    ASSERT_EQ(queue.size(), model_bytes);
  }
}

}  // namespace
}  // namespace lasso
