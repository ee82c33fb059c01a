// The registers of the PowerPC 603e that this board uses.
#pragma once

#include <cstdint>

namespace lasso::ppc603e {

constexpr std::uint32_t kExternalInterrupts = 0x8000;  // MSR[EE]
constexpr std::uint32_t kRest = 0x40000;               // MSR[POW]: doze until an interrupt
constexpr std::uint32_t kProcessor603e = 0x0006;       // upper half of the PVR, or 7
constexpr std::uint32_t kProcessor603eV = 0x0007;

inline std::uint32_t machine_state() {
  std::uint32_t value = 0;
  __asm__ volatile("mfmsr %0" : "=r"(value)::"memory");
  return value;
}
inline void set_machine_state(std::uint32_t value) { __asm__ volatile("sync\n\tmtmsr %0\n\tisync" ::"r"(value) : "memory"); }
inline std::uint32_t processor_version() {
  std::uint32_t value = 0;
  __asm__ volatile("mfpvr %0" : "=r"(value));
  return value;
}
// Of the four blocks of data that are mapped (start.S), the last one: no interrupts meanwhile.
inline void set_last_data_block(std::uint32_t upper, std::uint32_t lower) {
  __asm__ volatile("sync\n\tmtdbatu 3,%2\n\tisync\n\tmtdbatl 3,%1\n\tmtdbatu 3,%0\n\tisync" ::"r"(upper), "r"(lower), "r"(0) : "memory");
}

// Registers of devices: bytes, and words whose lowest byte comes first (PCI).
inline void write_device(std::uint32_t address, std::uint8_t value) {
  // NOLINTNEXTLINE(performance-no-int-to-ptr,clang-analyzer-core.FixedAddressDereference): registers lie at fixed addresses
  *reinterpret_cast<volatile std::uint8_t*>(address) = value;
  __asm__ volatile("eieio" ::: "memory");
}
inline std::uint8_t read_device(std::uint32_t address) {
  // NOLINTNEXTLINE(performance-no-int-to-ptr,clang-analyzer-core.FixedAddressDereference): as above
  const std::uint8_t value = *reinterpret_cast<volatile std::uint8_t*>(address);
  __asm__ volatile("eieio" ::: "memory");
  return value;
}
inline void write_device_word(std::uint32_t address, std::uint32_t value) {
  __asm__ volatile("stwbrx %0,0,%1\n\teieio" ::"r"(value), "r"(address) : "memory");
}
inline std::uint32_t read_device_word(std::uint32_t address) {
  std::uint32_t value = 0;
  __asm__ volatile("lwbrx %0,0,%1\n\teieio" : "=r"(value) : "r"(address) : "memory");
  return value;
}

}  // namespace lasso::ppc603e
