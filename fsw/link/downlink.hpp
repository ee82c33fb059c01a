// Packets to the ground: counted, each kind by itself too, and queued. Used by one thread.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/span.hpp"
#include "fsw/core/time.hpp"
#include "fsw/link/packet.hpp"
#include "fsw/link/row.hpp"
#include "fsw/link/telemetry_queue.hpp"

namespace lasso {

struct MessageType {
  std::uint8_t service, subservice;
};
inline constexpr MessageType kHousekeepingReport{kServiceHousekeeping, kSubserviceHousekeepingReport};
// Every kind of telemetry; the rows of the dictionary are of these.
inline constexpr MessageType kMessageTypes[] = {{1, 1}, {1, 2}, {1, 3}, {1, 7},   {1, 8}, {3, 25}, {5, 1},  {5, 2},
                                                {5, 3}, {5, 4}, {5, 8}, {5, 129}, {6, 6}, {6, 10}, {17, 2}, {20, 2}};
constexpr std::size_t kMessageTypeCount = sizeof(kMessageTypes) / sizeof(kMessageTypes[0]);

class Downlink {
 public:
  // Of the component `apid`.
  explicit Downlink(std::uint16_t apid = kApid) : apid_(apid) {}
  // Of the next packet of a kind, which has to be one of kMessageTypes. Loop bound: these.
  PacketHeader next_header(MessageType type, TimeUs t_us);
  // From now on headers state spacecraft time: the component's plus this. Both, and their sum, are within 2^62 us.
  void correlate_time(TimeUs offset_us);
  // The component's clock has jumped: headers state its own time again.
  void forget_time();
  TimeUs time_offset_us() const { return time_offset_us_; }
  // A whole packet. A full queue counts what it drops.
  void send(ConstBytes packet);
  // As send(); an answer to a command, which has room of its own.
  void send_answer(ConstBytes packet);
  // A packet of the values' items alone, or behind a number.
  template <class Values, std::size_t kRows>
  void send(MessageType type, const Codec<Values, kRows>& codec, const Values& values, TimeUs t_us) {
    std::uint8_t packet[kMaxPlainPacketBytes];
    ByteWriter writer{Bytes(packet)};
    begin_packet(next_header(type, t_us), writer);
    codec.write(values, writer);
    send({packet, finish_packet(writer, Bytes(packet))});
  }

  // Moves whole packets into `out` and returns their bytes, oldest first.
  std::size_t take(Bytes out) { return queue_.take(out); }
  const TelemetryQueue& queue() const { return queue_; }

 private:
  static constexpr std::size_t kMaxPlainPacketBytes = 256;

  std::uint16_t apid_;
  TelemetryQueue queue_;
  std::uint16_t packets_ = 0;  // sent; the lower 14 bits are the sequence count
  std::uint16_t messages_[kMessageTypeCount] = {};
  TimeUs time_offset_us_ = 0;
  std::uint8_t time_status_ = kTimeStatusFree;
};

}  // namespace lasso
