// The parts of SerialPort that are the same for each kind of port, for a board's serial_port.cpp alone. Uart is what knows its registers:
//   static std::uint8_t read(std::uint32_t registers);              // a byte that is there
//   static void write(std::uint32_t registers, std::uint8_t byte);  // there is room for it
//   static bool has_byte(std::uint32_t status);
#pragma once

#include "bsp/bare/serial_port.hpp"

namespace lasso::bare {

// Loop bound: count, at most kFifo.
template <class Uart>
void SerialPort::take(std::uint32_t count) {
  std::uint8_t bytes[kFifo];
  for (std::uint32_t i = 0; i < count; ++i) bytes[i] = Uart::read(registers_);
  const std::size_t kept = in_.write(ConstBytes(bytes, count));
  received_ = received_ + count;
  lost_ = lost_ + count - static_cast<std::uint32_t>(kept);
}

// One by one, as long as the status says that there is one. Loop bound: kMost.
template <class Uart>
void SerialPort::take_rest(std::uint32_t now) {
  std::uint32_t taken = 0;
  for (; Uart::has_byte(now) && taken < kMost; now = status(), ++taken) take<Uart>(1);
  if (Uart::has_byte(now)) cut_ = cut_ + 1;
}

// As many as are there, and fit. After the last one the port asks for no more. Loop bound: most, at most kFifo.
template <class Uart>
void SerialPort::fill(std::uint32_t most) {
  std::uint8_t bytes[kFifo];
  const std::size_t count = out_.read(Bytes(bytes, most));
  for (std::size_t i = 0; i < count; ++i) Uart::write(registers_, bytes[i]);
  sent_ = sent_ + static_cast<std::uint32_t>(count);
  if (count == 0) interrupt_when(false);
}

}  // namespace lasso::bare
