// The registers of a 16550, and bits in them.
#pragma once

#include <cstdint>

#include "bsp/ppc603e/cpu.hpp"

namespace lasso::ppc603e {

struct Uart {
  static constexpr std::uint32_t kData = 0, kEnable = 1, kCause = 2, kFifoControl = 2, kLineControl = 3, kModem = 4, kLineStatus = 5;
  static constexpr std::uint8_t kReceived = 1, kOverrun = 2, kEmpty = 0x20;                    // line status; kReceived also in kEnable
  static constexpr std::uint8_t kWhenEmpty = 2;                                                // kEnable
  static constexpr std::uint8_t kFifoOn = 0xC7;                                                // on and cleared, interrupt from 14 bytes on
  static constexpr std::uint8_t kDivisor = 0x80, kEightBits = 3, kReady = 0x0B, kLoop = 0x1B;  // line control, modem
  static constexpr std::uint8_t kCauses = 0x0F, kFilled = 4, kPaused = 12;                     // of an interrupt
  static constexpr std::uint32_t kTrigger = 14;                                                // bytes that fill

  static std::uint8_t read(std::uint32_t registers) { return read_device(registers + kData); }
  static void write(std::uint32_t registers, std::uint8_t byte) { write_device(registers + kData, byte); }
  static bool has_byte(std::uint32_t status) { return (status & kReceived) != 0; }
  static bool can_send(std::uint32_t status) { return (status & kEmpty) != 0; }
};

}  // namespace lasso::ppc603e
