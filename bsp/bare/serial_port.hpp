// A serial port between a line and two rings. Its interrupt moves the bytes: at 4 Mbit/s sixteen bytes come in 40 us, while a slot lasts
// 10 ms. What knows registers is the board's: it defines the functions, with the parts in serial_parts.hpp.
#pragma once

#include <cstdint>

#include "hal_lcs/byte_ring.hpp"
#include "hal_lcs/driver.hpp"

namespace lasso::bare {

using Ring = lcs::ByteRing<lcs::kLineBytes>;

class SerialPort {
 public:
  // The rings outlive the port.
  SerialPort(std::uint32_t registers, Ring& in, Ring& out) : registers_(registers), in_(in), out_(out) {}

  // Resets it; 8 data bits, no parity, 1 stop bit. False: it fails its test (stated on the board's page).
  bool open();
  // Whatever waits in its ring leaves from now on.
  void send();
  // Of the interrupt, which is off meanwhile. Loop bound: kMost bytes taken, and kFifo + 1 to send. What is left comes with the next one.
  void service();
  // Takes what is there without being asked to; the same bound. The interrupt is off.
  void look();

  // Nothing is left to be sent, as far as the port says.
  bool all_sent() const;
  std::uint32_t sent() const { return sent_; }          // bytes since open(), modulo 2^32
  std::uint32_t received() const { return received_; }  // likewise
  std::uint32_t lost() const { return lost_; }  // that found no room in the ring; and one for each overrun seen, of one byte or more
  std::uint32_t cut() const { return cut_; }    // services and looks that have left something, for their bound

 private:
  static constexpr std::uint32_t kFifo = 16;
  static constexpr std::uint32_t kMost = 64;  // four times what a port holds
  std::uint32_t status();
  void interrupt_when(bool sending);
  template <class Uart>
  void take(std::uint32_t count);
  template <class Uart>
  void take_rest(std::uint32_t now);
  template <class Uart>
  void fill(std::uint32_t most);
  void send_more();

  std::uint32_t registers_;
  Ring& in_;
  Ring& out_;
  volatile std::uint32_t sent_ = 0, received_ = 0, lost_ = 0, cut_ = 0;
  volatile bool sending_ = false;
};

}  // namespace lasso::bare
