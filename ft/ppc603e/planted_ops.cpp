#include "ft/pil/planted_ops.hpp"

namespace lasso::planted {

std::uint32_t read_at(std::uint32_t address) {
  std::uint32_t word = 0;
  __asm__ volatile("lwz %0,0(%1)" : "=r"(word) : "b"(address) : "memory");
  return word;
}
void write_at(std::uint32_t address) { __asm__ volatile("stw %0,0(%0)" ::"b"(address) : "memory"); }
void jump_to(std::uint32_t address) { __asm__ volatile("mtctr %0\n\tbctr" ::"r"(address) : "ctr", "memory"); }
void no_instruction() { __asm__ volatile(".long 0"); }
void call_system() { __asm__ volatile("sc" ::: "memory"); }

}  // namespace lasso::planted
