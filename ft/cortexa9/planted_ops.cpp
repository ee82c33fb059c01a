#include "ft/pil/planted_ops.hpp"

extern "C" std::uint8_t board_acquisition_stack_begin[];

namespace lasso::planted {
namespace {

constexpr std::uint32_t kThumb = 1;  // of an address; the state that comes back says so, too, as all of the board's C++ is
constexpr std::uint32_t kStackBytes = 0x8000;
constexpr std::uint32_t kFrameBytes = 80,
                        kReturnAt = 24;  // of an interrupt of the background, whose stack pointer is in it (bsp/cortexa9/vectors.S)

}  // namespace

std::uint32_t read_at(std::uint32_t address) {
  std::uint32_t word = 0;
  __asm__ volatile("ldr %0, [%1]" : "=r"(word) : "r"(address) : "memory");
  return word;
}
void write_at(std::uint32_t address) { __asm__ volatile("str %0, [%0]" ::"r"(address) : "memory"); }
void jump_to(std::uint32_t address) { __asm__ volatile("bx %0" ::"r"(address) : "memory"); }
void no_instruction() { __asm__ volatile("udf #0"); }
void call_system() { __asm__ volatile("svc #0" ::: "memory"); }

void lead_background_to(void (*there)()) {
  const std::uint32_t stack = *reinterpret_cast<volatile std::uint32_t*>(board_acquisition_stack_begin + kStackBytes - kFrameBytes);
  *reinterpret_cast<volatile std::uint32_t*>(stack + kReturnAt) =
      static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(there)) & ~kThumb;
}

std::uint32_t own_faults() { return 0; }
void own_fault(std::uint32_t) {}

}  // namespace lasso::planted
