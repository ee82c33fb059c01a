#include <initializer_list>

#include "bsp/bare/cpu.hpp"
#include "bsp/bare/serial_parts.hpp"
#include "bsp/ppc603e/uart.hpp"

namespace lasso::bare {
namespace {

using ppc603e::read_device;
using ppc603e::Uart;
using ppc603e::write_device;

constexpr std::uint32_t kPatience = 10000;  // looks at a status that does not come

// Whether bytes that are sent in the port's loop come back.
bool loops(std::uint32_t registers) {
  write_device(registers + Uart::kModem, Uart::kLoop);
  for (const std::uint8_t byte : {std::uint8_t{0x55}, std::uint8_t{0xAA}}) {
    write_device(registers + Uart::kData, byte);
    std::uint32_t looks = 0;
    while (!Uart::has_byte(read_device(registers + Uart::kLineStatus)) && looks < kPatience) ++looks;
    if (looks == kPatience || Uart::read(registers) != byte) return false;
  }
  return true;
}

}  // namespace

// Reading it clears the overrun.
std::uint32_t SerialPort::status() {
  const std::uint8_t now = read_device(registers_ + Uart::kLineStatus);
  if ((now & Uart::kOverrun) != 0) lost_ = lost_ + 1;
  return now;
}

void SerialPort::interrupt_when(bool sending) {
  sending_ = sending;
  write_device(registers_ + Uart::kEnable, static_cast<std::uint8_t>(Uart::kReceived | (sending ? Uart::kWhenEmpty : 0)));
}

bool SerialPort::open() {
  write_device(registers_ + Uart::kEnable, 0);
  write_device(registers_ + Uart::kLineControl, Uart::kDivisor);
  write_device(registers_ + Uart::kData, 1);
  write_device(registers_ + Uart::kEnable, 0);
  write_device(registers_ + Uart::kLineControl, Uart::kEightBits);
  write_device(registers_ + Uart::kFifoControl, Uart::kFifoOn);
  const bool good = loops(registers_);
  write_device(registers_ + Uart::kModem, Uart::kReady);
  write_device(registers_ + Uart::kFifoControl, Uart::kFifoOn);
  sent_ = received_ = lost_ = cut_ = 0;
  interrupt_when(false);
  return good;
}

// The interrupt comes at once: the port is empty.
void SerialPort::send() {
  const NoInterrupts quiet;
  if (!sending_ && out_.room() < lcs::kLineBytes) interrupt_when(true);
}

// As many bytes as the interrupt says are there, without a look at each; what is less, when no more has come for a while.
void SerialPort::service() {
  std::uint8_t cause = read_device(registers_ + Uart::kCause) & Uart::kCauses;
  for (std::uint32_t taken = 0; cause == Uart::kFilled && taken + Uart::kTrigger <= kMost; taken += Uart::kTrigger) {
    take<Uart>(Uart::kTrigger);
    cause = read_device(registers_ + Uart::kCause) & Uart::kCauses;
  }
  if (cause == Uart::kFilled) cut_ = cut_ + 1;
  const std::uint32_t now = status();
  if (cause == Uart::kPaused) take_rest<Uart>(now);
  if (sending_ && Uart::can_send(now)) send_more();
}

void SerialPort::look() {
  const std::uint32_t now = status();
  take_rest<Uart>(now);
  if (sending_ && Uart::can_send(now)) send_more();
}

void SerialPort::send_more() { fill<Uart>(kFifo); }

bool SerialPort::all_sent() const { return !sending_ && out_.room() == lcs::kLineBytes; }

}  // namespace lasso::bare
