#include "bsp/ppc603e/serial_port.hpp"

#include <initializer_list>

#include "bsp/ppc603e/cpu.hpp"

namespace lasso::ppc603e {
namespace {

// Registers, and bits in them.
constexpr std::uint32_t kData = 0, kEnable = 1, kCause = 2, kFifoControl = 2, kLineControl = 3, kModem = 4, kLineStatus = 5;
constexpr std::uint8_t kReceived = 1, kOverrun = 2, kEmpty = 0x20;                    // line status; kReceived also in kEnable
constexpr std::uint8_t kWhenEmpty = 2;                                                // kEnable
constexpr std::uint8_t kFifoOn = 0xC7;                                                // on and cleared, interrupt from 14 bytes on
constexpr std::uint8_t kDivisor = 0x80, kEightBits = 3, kReady = 0x0B, kLoop = 0x1B;  // line control, modem
constexpr std::uint8_t kCauses = 0x0F, kFilled = 4, kPaused = 12;                     // of an interrupt
constexpr std::uint32_t kTrigger = 14;                                                // bytes that fill
constexpr std::uint32_t kPatience = 10000;                                            // looks at a status that does not come

}  // namespace

// Reading it clears the overrun.
std::uint8_t SerialPort::status() {
  const std::uint8_t now = read_device(registers_ + kLineStatus);
  if ((now & kOverrun) != 0) lost_ = lost_ + 1;
  return now;
}

void SerialPort::interrupt_when(bool sending) {
  sending_ = sending;
  write_device(registers_ + kEnable, static_cast<std::uint8_t>(kReceived | (sending ? kWhenEmpty : 0)));
}

bool SerialPort::open() {
  write_device(registers_ + kEnable, 0);
  write_device(registers_ + kLineControl, kDivisor);
  write_device(registers_ + kData, 1);
  write_device(registers_ + kEnable, 0);
  write_device(registers_ + kLineControl, kEightBits);
  write_device(registers_ + kFifoControl, kFifoOn);
  const bool good = loop();
  write_device(registers_ + kModem, kReady);
  write_device(registers_ + kFifoControl, kFifoOn);
  sent_ = received_ = lost_ = cut_ = 0;
  interrupt_when(false);
  return good;
}

bool SerialPort::loop() {
  write_device(registers_ + kModem, kLoop);
  for (const std::uint8_t byte : {std::uint8_t{0x55}, std::uint8_t{0xAA}}) {
    write_device(registers_ + kData, byte);
    std::uint32_t looks = 0;
    while ((status() & kReceived) == 0 && looks < kPatience) ++looks;
    if (looks == kPatience || read_device(registers_ + kData) != byte) return false;
  }
  return true;
}

void SerialPort::send() {
  const NoInterrupts quiet;
  if (!sending_ && out_.room() < lcs::kLineBytes) interrupt_when(true);
}

bool SerialPort::all_sent() const { return !sending_ && out_.room() == lcs::kLineBytes; }

void SerialPort::fill() {
  std::uint8_t bytes[kFifo];
  const std::size_t count = out_.read(Bytes(bytes));
  for (std::size_t i = 0; i < count; ++i) write_device(registers_ + kData, bytes[i]);
  sent_ = sent_ + static_cast<std::uint32_t>(count);
  if (count == 0) interrupt_when(false);
}

void SerialPort::take(std::uint32_t count) {
  std::uint8_t bytes[kFifo];
  for (std::uint32_t i = 0; i < count; ++i) bytes[i] = read_device(registers_ + kData);
  const std::size_t kept = in_.write(ConstBytes(bytes, count));
  received_ = received_ + count;
  lost_ = lost_ + count - static_cast<std::uint32_t>(kept);
}

// As many bytes as the interrupt says are there, without a look at each; what is less, when no more has come for a while.
void SerialPort::service() {
  std::uint8_t cause = read_device(registers_ + kCause) & kCauses;
  for (std::uint32_t taken = 0; cause == kFilled && taken + kTrigger <= kMost; taken += kTrigger) {
    take(kTrigger);
    cause = read_device(registers_ + kCause) & kCauses;
  }
  if (cause == kFilled) cut_ = cut_ + 1;
  const std::uint8_t now = status();
  if (cause == kPaused) take_rest(now);
  if (sending_ && (now & kEmpty) != 0) fill();
}

void SerialPort::look() {
  const std::uint8_t now = status();
  take_rest(now);
  if (sending_ && (now & kEmpty) != 0) fill();
}

void SerialPort::take_rest(std::uint8_t now) {
  std::uint32_t taken = 0;
  for (; (now & kReceived) != 0 && taken < kMost; now = status(), ++taken) take(1);
  if ((now & kReceived) != 0) cut_ = cut_ + 1;
}

}  // namespace lasso::ppc603e
