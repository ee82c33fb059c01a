#include "ft/pil/planted_ops.hpp"

extern "C" std::uint8_t board_acquisition_stack_begin[];

namespace lasso::planted {
namespace {

constexpr std::uint32_t kStackBytes = 0x8000;
constexpr std::uint32_t kFrameBytes = 256, kReturnAt = 84;  // of an interrupt of the background, and SRR0 in it (bsp/ppc603e/vectors.S)
constexpr std::uint32_t kUnaligned = 0x00400001;
// That no instruction of this board raises, or not on the emulated processor.
constexpr std::uint32_t kVectors[] = {0x100, 0x200, 0x300,  0x400,  0xA00,  0xB00,  0xD00,
                                      0xE00, 0xF00, 0x1300, 0x1400, 0x1500, 0x1600, 0x1700};

// As the processor does: without translation, and without interrupts.
void take_vector(std::uint32_t vector) {
  std::uint32_t state = 0;
  __asm__ volatile(
      "mfmsr %0\n\trlwinm %0,%0,0,17,15\n\tmtmsr %0\n\tisync\n\trlwinm %0,%0,0,28,25\n\t"
      "mtsrr0 %1\n\tmtsrr1 %0\n\trfi"
      : "=&r"(state)
      : "r"(vector)
      : "memory");
}

void use_no_floating_point() {
  std::uint32_t state = 0;
  __asm__ volatile("mfmsr %0\n\trlwinm %0,%0,0,19,17\n\tmtmsr %0\n\tisync\n\tfneg 1,1" : "=&r"(state) : : "fr1", "memory");
}

void reserve_unaligned() {
  std::uint32_t word = 0;
  __asm__ volatile("lwarx %0,0,%1" : "=r"(word) : "r"(kUnaligned) : "memory");
}

}  // namespace

std::uint32_t read_at(std::uint32_t address) {
  std::uint32_t word = 0;
  __asm__ volatile("lwz %0,0(%1)" : "=r"(word) : "b"(address) : "memory");
  return word;
}
void write_at(std::uint32_t address) { __asm__ volatile("stw %0,0(%0)" ::"b"(address) : "memory"); }
void jump_to(std::uint32_t address) { __asm__ volatile("mtctr %0\n\tbctr" ::"r"(address) : "ctr", "memory"); }
void no_instruction() { __asm__ volatile(".long 0"); }
void call_system() { __asm__ volatile("sc" ::: "memory"); }

void lead_background_to(void (*there)()) {
  auto* const place = reinterpret_cast<volatile std::uint32_t*>(board_acquisition_stack_begin + kStackBytes - kFrameBytes + kReturnAt);
  *place = static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(there));
}

std::uint32_t own_faults() { return 2 + sizeof kVectors / sizeof kVectors[0]; }

void own_fault(std::uint32_t number) {
  if (number == 0) return use_no_floating_point();
  if (number == 1) return reserve_unaligned();
  take_vector(kVectors[number - 2]);
}

}  // namespace lasso::planted
