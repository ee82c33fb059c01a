// What comes over a link: packets of telemetry whose checksum is right, and how many bytes belong to none.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <vector>

#include "fsw/link/byte_link.hpp"
#include "fsw/link/packet_finder.hpp"
#include "mdat/link/decode.hpp"

namespace lasso::mdat {

class TelemetryReceiver {
 public:
  using Listener = std::function<void(const DecodedPacket&)>;

  // Of the component `apid`.
  explicit TelemetryReceiver(std::uint16_t apid = kApid);
  TelemetryReceiver(const TelemetryReceiver&) = delete;
  TelemetryReceiver& operator=(const TelemetryReceiver&) = delete;

  // Takes what the link has now, at most some 64 kB, and gives each packet to `listener`, for the call. False: nothing had come. Of a
  // stream, bytes that seem to begin a packet wait a second for its rest; of a datagram they do not.
  bool take(ByteLink& link, const Listener& listener);

  // So far; those that wait are not among them.
  std::uint64_t other_bytes() const { return other_bytes_; }

 private:
  void search(ConstBytes bytes, const Listener& listener);
  void give_up(const Listener& listener);

  std::vector<std::uint8_t> buffer_, input_;
  PacketFinder finder_;
  bool whole_ = false;         // the last search found a packet
  std::uint32_t skipped_ = 0;  // of the finder, when it was asked last: it wraps
  std::uint64_t other_bytes_ = 0;
  std::chrono::steady_clock::time_point last_{};  // byte
};

}  // namespace lasso::mdat
