// The memory of an emulated board, as a file that is shared with its emulator (ram.bin, ft/pil/emulator.py).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace lasso::pil {

constexpr std::size_t kRamBytes = 256U << 20;

class BoardRam {
 public:
  BoardRam() = default;
  ~BoardRam();
  BoardRam(const BoardRam&) = delete;
  BoardRam& operator=(const BoardRam&) = delete;

  // That of the emulator that runs in `folder` now; what was mapped before is no more. Throws mdat::RunError where there is none.
  std::uint8_t* map(const std::string& folder);

 private:
  void unmap();
  std::uint8_t* ram_ = nullptr;
};

}  // namespace lasso::pil
