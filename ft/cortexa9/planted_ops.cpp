#include "ft/pil/planted_ops.hpp"

namespace lasso::planted {

std::uint32_t read_at(std::uint32_t address) {
  std::uint32_t word = 0;
  __asm__ volatile("ldr %0, [%1]" : "=r"(word) : "r"(address) : "memory");
  return word;
}
void write_at(std::uint32_t address) { __asm__ volatile("str %0, [%0]" ::"r"(address) : "memory"); }
void jump_to(std::uint32_t address) { __asm__ volatile("bx %0" ::"r"(address) : "memory"); }
void no_instruction() { __asm__ volatile("udf #0"); }
void call_system() { __asm__ volatile("svc #0" ::: "memory"); }

std::uint32_t own_faults() { return 0; }
void own_fault(std::uint32_t) {}

}  // namespace lasso::planted
