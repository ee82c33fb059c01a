// The registers of a PL011, and bits in them: DR, FR, IBRD, FBRD, LCR_H, CR, IFLS, IMSC, RIS (before the mask: overruns are not in it),
// ICR.
#pragma once

#include <cstdint>

#include "bsp/cortexa9/devices.hpp"

namespace lasso::cortexa9 {

struct Uart {
  static constexpr std::uint32_t kData = 0, kFlags = 0x18, kDivisor = 0x24, kFraction = 0x28, kLineControl = 0x2C, kControl = 0x30,
                                 kLevels = 0x34, kMask = 0x38, kCauses = 0x3C, kClear = 0x44, kId = 0xFE0;
  static constexpr std::uint32_t kBusy = 8, kNoByte = 0x10, kFull = 0x20, kEmpty = 0x80;  // flags
  static constexpr std::uint32_t kEightBits = 0x70;                                       // line control: with FIFOs
  static constexpr std::uint32_t kOn = 0x301;                                             // control: it, sending, receiving
  static constexpr std::uint32_t kHalf = 2 << 3;                                          // levels: half received, an eighth to send
  static constexpr std::uint32_t kReceived = 0x10, kSent = 0x20, kPaused = 0x40, kOverrun = 0x400, kAll = 0x7FF;  // causes, mask, clear

  static std::uint8_t read(std::uint32_t registers) { return static_cast<std::uint8_t>(read_device(registers + kData)); }
  static void write(std::uint32_t registers, std::uint8_t byte) { write_device(registers + kData, byte); }
  static bool has_byte(std::uint32_t flags) { return (flags & kNoByte) == 0; }

  // Off, and on again: 8 data bits, no parity, 1 stop bit, the clock's sixteenth as bit rate; no interrupts, nothing in the FIFOs.
  static void reset(std::uint32_t registers) {
    write_device(registers + kControl, 0);
    write_device(registers + kMask, 0);
    write_device(registers + kLineControl, 0);
    write_device(registers + kClear, kAll);
    write_device(registers + kDivisor, 1);
    write_device(registers + kFraction, 0);
    write_device(registers + kLineControl, kEightBits);
    write_device(registers + kLevels, kHalf);
    write_device(registers + kControl, kOn);
  }
};

}  // namespace lasso::cortexa9
