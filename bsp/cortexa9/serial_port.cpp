#include "bsp/bare/cpu.hpp"
#include "bsp/bare/serial_parts.hpp"
#include "bsp/cortexa9/uart.hpp"

namespace lasso::bare {
namespace {

using cortexa9::read_device;
using cortexa9::Uart;
using cortexa9::write_device;

// By the numbers that such a port has.
bool is_there(std::uint32_t registers) {
  constexpr std::uint32_t kPart = 0x11, kPartAndMaker = 0x10;
  return read_device(registers + Uart::kId) == kPart && read_device(registers + Uart::kId + 4) == kPartAndMaker;
}

}  // namespace

std::uint32_t SerialPort::status() { return read_device(registers_ + Uart::kFlags); }

void SerialPort::interrupt_when(bool sending) {
  sending_ = sending;
  write_device(registers_ + Uart::kMask, Uart::kReceived | Uart::kPaused | (sending ? Uart::kSent : 0));
}

bool SerialPort::open() {
  if (!is_there(registers_)) return false;
  Uart::reset(registers_);
  sent_ = received_ = lost_ = cut_ = 0;
  interrupt_when(false);
  return true;
}

// The interrupt comes when the FIFO has run low, and only if it was not: the first bytes are put there.
void SerialPort::send() {
  const NoInterrupts quiet;
  if (sending_ || out_.room() == lcs::kLineBytes) return;
  interrupt_when(true);
  send_more();
}

// As long as one has room. When the ring is empty, the port asks for no more.
void SerialPort::send_more() {
  for (std::uint32_t i = 0; i <= kFifo && sending_ && (status() & Uart::kFull) == 0; ++i) fill<Uart>(1);
}

// Bytes that are left keep their interrupt: it ends when they are read.
void SerialPort::service() {
  const std::uint32_t causes = read_device(registers_ + Uart::kCauses);
  write_device(registers_ + Uart::kClear, Uart::kSent | Uart::kOverrun);
  if ((causes & Uart::kOverrun) != 0) lost_ = lost_ + 1;
  look();
}

void SerialPort::look() {
  take_rest<Uart>(status());
  if (sending_) send_more();
}

// The end of the last byte raises no interrupt: who rests until then has another wake-up call.
bool SerialPort::all_sent() const {
  return !sending_ && out_.room() == lcs::kLineBytes && (read_device(registers_ + Uart::kFlags) & Uart::kBusy) == 0;
}

}  // namespace lasso::bare
