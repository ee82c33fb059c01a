// What a loader puts into memory beside the board's own image: straps, and the mission's image. In flight nothing that goes astray can
// write to it, and each start finds it as it was loaded.
#pragma once

#include <cstddef>
#include <cstdint>

#include "bsp/bare/cpu.hpp"
#include "bsp/bare/ram_store.hpp"
#include "fsw/core/span.hpp"

namespace lasso::bare {

// What is soldered, or loaded: where it is not, the board's own values hold.
struct Straps {
  std::uint32_t magic;
  std::uint32_t ticks_per_s;  // of the time base
  std::uint32_t rig;          // 1: at the third port
};

// Until the end of the scope the loaded memory can be read, maybe in the place of the devices (board.hpp): no interrupts, and nothing on
// the console. A fault meanwhile maps the devices first.
class LoadedMemory {
 public:
  LoadedMemory();
  ~LoadedMemory();
  LoadedMemory(const LoadedMemory&) = delete;
  LoadedMemory& operator=(const LoadedMemory&) = delete;

  static Straps straps();
  // Where a loader has to put them, for people.
  static std::uint32_t straps_at();
  static std::uint32_t image_at();
  // Its first words: none is there without kImageMagic. What it holds the component checks.
  static std::uint32_t image_magic();
  static std::uint32_t image_bytes();
  // Empty where none is there, or one that is too large.
  static ConstBytes image();

 private:
  NoInterrupts no_interrupts_;
};

}  // namespace lasso::bare
