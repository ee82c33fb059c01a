// Bytes that claim to be telemetry. What the decoder takes for a pose must encode to the same bytes again; what the queue takes it must
// give back. The first byte: bit 0 leaves length and checksum as they are.
#include "cfg/capacities.hpp"
#include "fsw/link/pose_telemetry.hpp"
#include "fsw/link/telemetry_queue.hpp"
#include "ft/fuzz/exact.hpp"
#include "ft/fuzz/repair.hpp"

namespace lasso::fuzz {
namespace {

constexpr std::size_t kTimeAt = 13, kTimeBytes = 7;

// Time fractions finer than a microsecond and bits that no field holds are not kept.
bool kept(std::size_t i, std::size_t size) {
  return i != 6 && !(i >= kTimeAt && i < kTimeAt + kTimeBytes) && i + kPacketTrailerBytes < size;
}

void check_again(ConstBytes packet, const PacketHeader& header, const PoseTelemetry& pose) {
  std::uint8_t again[kMaxPosePacketBytes];
  expect(encode_pose(pose, header, Bytes(again)) == packet.size(), "a decoded pose packet encodes to its own size");
  for (std::size_t i = 0; i < packet.size(); ++i) expect(!kept(i, packet.size()) || again[i] == packet[i], "and to its own bytes");
}

void check_queue(Bytes packet) {
  static TelemetryQueue queue;
  if (queue.push(packet) != Status::kOk) return expect(queue.size() == 0, "a refused packet leaves no byte in the queue");
  ExactCopy out(packet);
  expect(queue.take(out.bytes()) == packet.size() && out.equals(packet), "the queue gives back what it took");
}

void decode(ConstBytes input, bool as_it_is) {
  ExactCopy packet(input);
  if (!as_it_is) repair(packet.bytes());
  PacketHeader header;
  PoseTelemetry pose;
  if (decode_pose(packet.bytes(), header, pose) == PacketFault::kNone) check_again(packet.bytes(), header, pose);
  check_queue(packet.bytes());
}

}  // namespace
}  // namespace lasso::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 0) lasso::fuzz::decode({data + 1, size - 1}, (data[0] & 1) != 0);
  return 0;
}
