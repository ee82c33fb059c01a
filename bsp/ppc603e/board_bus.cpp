#include "bsp/ppc603e/board_bus.hpp"

#include <initializer_list>

#include "bsp/ppc603e/cpu.hpp"

namespace lasso::ppc603e {
namespace {

constexpr std::uint32_t kConfigAddress = 0xFEC00000, kConfigData = 0xFEE00000;
constexpr std::uint32_t kBridge = 0x00021057;      // device and vendor: Grackle
constexpr std::uint32_t kSerialCard = 0x00041B36;  // four 16550
constexpr std::uint32_t kChip = 0x106B;            // vendor of the Heathrow chip; class 0xFF00
constexpr std::uint32_t kChipClass = 0xFF00;
constexpr std::uint32_t kDevices = 32;
constexpr std::uint32_t kBusIo = 0xFE000000, kSerialIo = 0x1000, kChipMemory = 0xFD000000;
constexpr std::uint32_t kCommand = 4, kClass = 8, kBase0 = 0x10, kIoOn = 1, kMemoryOn = 2;
// Interrupts 0 to 31 and 32 to 63: the registers of each.
constexpr std::uint32_t kLow = kChipMemory + 0x20, kHigh = kChipMemory + 0x10, kMask = 4, kClear = 8;
constexpr std::uint32_t kBusInterrupts = 0x01E00000;  // 21 to 24: the four lines of the bus

std::uint32_t read_config(std::uint32_t device, std::uint32_t offset) {
  write_device_word(kConfigAddress, 0x80000000u | device << 11 | offset);
  return read_device_word(kConfigData);
}

void write_config(std::uint32_t device, std::uint32_t offset, std::uint32_t value) {
  write_device_word(kConfigAddress, 0x80000000u | device << 11 | offset);
  write_device_word(kConfigData, value);
}

void place(std::uint32_t device, std::uint32_t base, std::uint32_t enable) {
  write_config(device, kBase0, base);
  write_config(device, kCommand, read_config(device, kCommand) | enable);
}

void mask_all() {
  for (const std::uint32_t half : {kLow, kHigh}) {
    write_device_word(half + kMask, 0);
    write_device_word(half + kClear, 0xFFFFFFFF);
  }
}

}  // namespace

Bus open_bus() {
  Bus bus;
  bus.bridge = read_config(0, 0) == kBridge;
  if (!bus.bridge) return bus;
  for (std::uint32_t device = 1; device < kDevices; ++device) {
    const std::uint32_t id = read_config(device, 0);
    if (id == kSerialCard && !bus.card) {
      place(device, kSerialIo, kIoOn);
      bus.card = true;
    }
    if ((id & 0xFFFF) == kChip && read_config(device, kClass) >> 16 == kChipClass) {
      place(device, kChipMemory, kMemoryOn);
      bus.chip = true;
    }
  }
  if (bus.chip) mask_all();
  return bus;
}

std::uint32_t serial_registers(std::uint32_t port) { return kBusIo + kSerialIo + 8 * port; }

void unmask_serial_interrupt() { write_device_word(kLow + kMask, kBusInterrupts); }

void mask_serial_interrupt() { write_device_word(kLow + kMask, 0); }

}  // namespace lasso::ppc603e
