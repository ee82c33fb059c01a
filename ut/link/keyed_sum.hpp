// An authenticator for tests on every processor: a CRC-32C over a secret and the packet. It shows who is asked, and for what; it stops
// nobody. ut/mdat/link/signature_test.cpp has one that does.
#pragma once

#include <set>

#include "fsw/core/crc.hpp"
#include "fsw/link/authenticator.hpp"
#include "ut/link/command_packets.hpp"

namespace lasso::test {

constexpr std::uint8_t kSecret = 0x5A;
constexpr std::size_t kSumBytes = 4;

inline std::uint32_t keyed_sum(ConstBytes packet) {
  Stream bytes = {kSecret};
  bytes.insert(bytes.end(), packet.begin(), packet.end());
  return crc32c(view(bytes));
}

class KeyedSum final : public Authenticator {
 public:
  std::size_t trailer_bytes() const override { return kSumBytes; }
  bool authentic(ConstBytes packet, ConstBytes trailer) override {
    ++asked;
    return ByteReader(trailer).u32() == keyed_sum(packet);
  }
  int asked = 0;
};

// Takes each packet once, as a number that has to grow does.
class OnceSum final : public Authenticator {
 public:
  std::size_t trailer_bytes() const override { return kSumBytes; }
  bool authentic(ConstBytes packet, ConstBytes trailer) override {
    return ByteReader(trailer).u32() == keyed_sum(packet) && seen_.insert(keyed_sum(packet)).second;
  }

 private:
  std::set<std::uint32_t> seen_;
};

inline Stream with_sum(Stream packet) {
  packet.resize(packet.size() - kPacketTrailerBytes);
  packet[5] = static_cast<std::uint8_t>(packet[5] + kSumBytes);
  const std::uint32_t sum = keyed_sum(view(packet));
  for (int shift = 24; shift >= 0; shift -= 8) packet.push_back(static_cast<std::uint8_t>(sum >> shift));
  packet.resize(packet.size() + kPacketTrailerBytes);
  repair_crc(packet);
  return packet;
}

}  // namespace lasso::test
