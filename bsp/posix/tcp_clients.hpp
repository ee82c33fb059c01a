// Who speaks with a component at a TCP port. Anybody may connect there; each client's packets are found in its own bytes, so that nobody
// can tear another one's. Telemetry goes to one of them, the holder:
//   - the first who has connected,
//   - until somebody else is vouched for (sent a valid command, with a key a signed one) while the holder never was, or was silent for 30
//   s,
//   - or until the holder has gone; one that nobody vouched for is sent away after 30 s where somebody else waits.
// An answer to a command goes to who sent it, for the last kAsked commands of each; where several sent the same one, to one that was
// vouched for, and to who sent it last. There are at most kClients; a further one takes the place of the oldest that nobody vouched for, or
// else of the one that was silent longest, for 30 s at least, or is sent away.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <list>
#include <vector>

#include "bsp/posix/socket.hpp"
#include "fsw/core/span.hpp"
#include "fsw/link/commands.hpp"
#include "fsw/link/packet_finder.hpp"

namespace lasso::posix {

// Which packets a link is listened to for: at a component's end commands for it, at the ground's end telemetry of it.
struct Heard {
  PacketType type = PacketType::kCommand;
  std::uint16_t apid = kApid;
};

class TcpClients {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kSilent{30};
  static constexpr std::size_t kClients = 4;
  static constexpr std::size_t kAsked = 64;  // more than are answered in two frames

  explicit TcpClients(const Heard& heard) : heard_(heard) {}

  void add(Descriptor socket, Time now);
  // A packet with right checksum, of one client after the other; 0: there is none.
  std::size_t read(Bytes out, Time now);
  // The last packet came from who may command.
  void vouch(Time now);
  // A whole packet. False: who gets it takes nothing now. Where nobody gets it, it is lost.
  bool write(ConstBytes packet);

  std::size_t size() const { return clients_.size(); }

 private:
  static constexpr std::size_t kLongestPacket = 65542;  // of space packets
  static constexpr std::size_t kReadBytes = 2048;       // of a call
  // A command that may be answered yet: its first four bytes, as the answer repeats them; 0, which begins no command: none.
  struct Asked {
    std::uint32_t key = 0;
    std::uint64_t turn = 0;  // in which it was read
  };
  struct Client {
    Client(Descriptor taken, const Heard& packets, Time now)
        : socket(std::move(taken)),
          packet(packets.type == PacketType::kCommand ? kMaxCommandBytes : kLongestPacket),
          finder(packets.type, Bytes(packet.data(), packet.size()), packets.apid),
          heard(now),
          came(now) {}
    Descriptor socket;
    std::vector<std::uint8_t> packet;  // that is being found
    PacketFinder finder;
    std::vector<std::uint8_t> in;    // that the finder has not taken yet
    std::vector<std::uint8_t> rest;  // of a packet of telemetry that was begun
    Time heard, came;                // connected, or vouched for last; its last byte
    bool vouched = false;
    std::array<Asked, kAsked> asked{};
    std::size_t next = 0;  // of asked
  };
  using Place = std::list<Client>::iterator;

  bool keeps(const Client& client, Time now) const { return client.vouched && now - client.heard < kSilent; }
  void drop_silent(Time now);
  void drop(Place client);
  bool look(Client& client, Time now);
  static void receive(Client& client, Time now);
  static bool flush(Client& client);
  Client* asker(std::uint32_t key, bool vouched);
  Client* receiver(ConstBytes packet);

  Heard heard_;
  std::list<Client> clients_;  // the holder first; then who waits, in the order of their turns
  Client* last_ = nullptr;     // whose packet was read last
  std::uint64_t turn_ = 0;
};

}  // namespace lasso::posix
