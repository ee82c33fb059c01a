#include "mdat/link/telemetry_receiver.hpp"

#include <algorithm>

namespace lasso::mdat {
namespace {

constexpr std::size_t kMostAtOnce = 65536;
constexpr std::chrono::seconds kPatienceForRest(1);

// Of all packets of telemetry.
std::size_t largest_packet() {
  std::size_t largest = kPacketHeaderBytes;
  for (const PacketRow& row : kPackets) {
    if (row.type == PacketType::kTelemetry) largest = std::max(largest, item_offset(row, row.items.size()) + kPacketTrailerBytes);
  }
  return largest;
}

}  // namespace

TelemetryReceiver::TelemetryReceiver(std::uint16_t apid)
    : buffer_(largest_packet()), input_(kMostAtOnce), finder_(PacketType::kTelemetry, Bytes(buffer_.data(), buffer_.size()), apid) {}

bool TelemetryReceiver::take(ByteLink& link, const Listener& listener) {
  const auto now = std::chrono::steady_clock::now();
  const std::size_t came = link.read(Bytes(input_.data(), input_.size()));
  if (came > 0) last_ = now;
  whole_ = false;
  search({input_.data(), came}, listener);
  if (whole_) link.peer_spoke();
  if (link.datagrams() || now - last_ > kPatienceForRest) give_up(listener);
  return came > 0;
}

void TelemetryReceiver::search(ConstBytes bytes, const Listener& listener) {
  do {
    const std::size_t taken = finder_.take(bytes);
    bytes = bytes.subspan(taken, bytes.size() - taken);
    const ConstBytes packet = finder_.packet();
    if (!packet.empty()) whole_ = true;
    if (!packet.empty()) listener(decode_packet(packet, PacketType::kTelemetry));
  } while (!bytes.empty() || !finder_.packet().empty());
  other_bytes_ += finder_.skipped() - skipped_;
  skipped_ = finder_.skipped();
}

// A packet may stand behind what only seemed to begin one.
void TelemetryReceiver::give_up(const Listener& listener) {
  while (finder_.give_up()) search({}, listener);
}

}  // namespace lasso::mdat
