// The registers of the board's serial ports, and bits in them: a 16550, and one of the Heathrow chip.
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

// As an 8530 has them: a control register by which the others are chosen, and data.
struct ChipUart {
  static constexpr std::uint32_t kControl = 0, kData = 0x10;
  static constexpr std::uint8_t kClock = 4, kTransmit = 5;                    // chosen registers
  static constexpr std::uint8_t kSixteenOneStop = 0x44, kEightBitsOn = 0x68;  // in them
  static constexpr std::uint8_t kEmpty = 4;                                   // of the status

  static void set(std::uint32_t registers, std::uint8_t number, std::uint8_t value) {
    write_device(registers + kControl, number);
    write_device(registers + kControl, value);
  }
  static void open(std::uint32_t registers) {
    set(registers, kClock, kSixteenOneStop);
    set(registers, kTransmit, kEightBitsOn);
  }
  static bool can_send(std::uint32_t registers) { return (read_device(registers + kControl) & kEmpty) != 0; }
  static void write(std::uint32_t registers, std::uint8_t letter) { write_device(registers + kData, letter); }
};

}  // namespace lasso::ppc603e
