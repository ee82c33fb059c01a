// To whom a component at a UDP port sends its telemetry. Anybody may send datagrams there; who gets telemetry is
//   - who was configured,
//   - the first who was vouched for (sent a valid command, with a key a signed one), until it is silent for 30 s and another one comes,
//   - up to three more of them, the one that was silent longest making way.
// So a datagram that is no command of an operator moves nothing, and a second operator takes nothing from the first. An answer to a command
// also goes to who sent it, vouched for or not.
#pragma once

#include <netinet/in.h>

#include <array>
#include <chrono>
#include <cstdint>

#include "fsw/core/fixed_vector.hpp"
#include "fsw/core/span.hpp"

namespace lasso::posix {

class UdpPeers {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kSilent{30};
  static constexpr int kStrangersPerSecond = 500;
  static constexpr std::size_t kPlaces = 4;  // but for the configured one
  using List = FixedVector<sockaddr_in, kPlaces + 2>;

  void configure(const sockaddr_in& address) { static_cast<void>(configured_.push_back(address)); }
  // A datagram came from there. False: it is not worth a look, as strangers sent more than kStrangersPerSecond.
  bool heard(const sockaddr_in& from, ConstBytes datagram, Time now);
  // The last datagram came from who is to be told.
  void vouch(Time now);
  // To whom a packet goes.
  List receivers(ConstBytes packet) const;

 private:
  struct Place {
    sockaddr_in address{};
    Time heard{};
  };
  // A command that may be answered yet: its first four bytes, as the answer repeats them.
  struct Asked {
    std::uint32_t key = 0;
    sockaddr_in address{};
    bool open = false;
  };
  static constexpr std::size_t kAsked = 64;  // more than are read between two writes
  void drop_silent(Time now);
  bool has_place(const sockaddr_in& address) const;
  bool is_crowded(Time now);

  FixedVector<sockaddr_in, 1> configured_;
  FixedVector<Place, kPlaces> places_;  // the first one stays while it is not silent
  std::array<Asked, kAsked> asked_{};
  std::size_t next_ = 0;  // of asked_, and behind the last datagram's
  Time second_{};         // since then
  int strangers_ = 0;     // have sent so many
};

}  // namespace lasso::posix
