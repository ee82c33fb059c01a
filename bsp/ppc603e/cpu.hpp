// The registers of the PowerPC 603e that this board uses.
#pragma once

#include <cstdint>

#include "fsw/core/span.hpp"

namespace lasso::ppc603e {

constexpr std::uint32_t kExternalInterrupts = 0x8000;  // MSR[EE]
constexpr std::uint32_t kRest = 0x40000;               // MSR[POW]: doze until an interrupt
constexpr std::uint32_t kProcessor603e = 0x0006;       // upper half of the PVR, or 7
constexpr std::uint32_t kProcessor603eV = 0x0007;

inline std::uint64_t time_base() {
  std::uint32_t high = 0, low = 0, again = 0;
  do {  // NOLINT(bugprone-infinite-loop): the processor changes them
    __asm__ volatile("mftbu %0\n\tmftb %1\n\tmftbu %2" : "=r"(high), "=r"(low), "=r"(again));
  } while (high != again);
  return (std::uint64_t{high} << 32) | low;
}
inline void set_decrementer(std::uint32_t ticks) { __asm__ volatile("mtdec %0" ::"r"(ticks)); }
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
inline void allow_interrupts(bool allowed) {
  const std::uint32_t others = machine_state() & ~kExternalInterrupts;
  set_machine_state(allowed ? others | kExternalInterrupts : others);
}

// Until the end of the scope.
class NoInterrupts {
 public:
  NoInterrupts() : before_(machine_state()) { set_machine_state(before_ & ~kExternalInterrupts); }
  ~NoInterrupts() { set_machine_state(before_); }
  NoInterrupts(const NoInterrupts&) = delete;
  NoInterrupts& operator=(const NoInterrupts&) = delete;

 private:
  std::uint32_t before_;
};

// Rests until an interrupt has made it true.
template <class Done>
void rest_until(const Done& done) {
  for (allow_interrupts(false); !done(); allow_interrupts(false)) set_machine_state(machine_state() | kExternalInterrupts | kRest);
  allow_interrupts(true);
}

// Of the four blocks of data that are mapped (start.S), the last one: no interrupts meanwhile.
inline void set_last_data_block(std::uint32_t upper, std::uint32_t lower) {
  __asm__ volatile("sync\n\tmtdbatu 3,%2\n\tisync\n\tmtdbatl 3,%1\n\tmtdbatu 3,%0\n\tisync" ::"r"(upper), "r"(lower), "r"(0) : "memory");
}

// From the data cache to memory.
inline void write_back(ConstBytes written) {
  constexpr std::uint32_t kLineBytes = 32;
  const std::uint8_t* const at = written.data();
  const std::size_t bytes = written.size();
  for (std::size_t i = 0; i < bytes; i += kLineBytes) __asm__ volatile("dcbst 0,%0" ::"r"(at + i) : "memory");
  if (bytes > 0) __asm__ volatile("dcbst 0,%0" ::"r"(at + bytes - 1) : "memory");
  __asm__ volatile("sync" ::: "memory");
}

// Registers of devices: bytes, and words whose lowest byte comes first (PCI).
inline void write_device(std::uint32_t address, std::uint8_t value) {
  *reinterpret_cast<volatile std::uint8_t*>(address) = value;  // NOLINT(performance-no-int-to-ptr): registers lie at fixed addresses
  __asm__ volatile("eieio" ::: "memory");
}
inline std::uint8_t read_device(std::uint32_t address) {
  const std::uint8_t value = *reinterpret_cast<volatile std::uint8_t*>(address);  // NOLINT(performance-no-int-to-ptr): as above
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
