#include "ft/pil/board_ram.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include "mdat/common/errors.hpp"

namespace lasso::pil {

BoardRam::~BoardRam() { unmap(); }

void BoardRam::unmap() {
  if (ram_ != nullptr) (void)munmap(ram_, kRamBytes);
  ram_ = nullptr;
}

std::uint8_t* BoardRam::map(const std::string& folder) {
  unmap();
  const int fd = open((folder + "/ram.bin").c_str(), O_RDWR | O_CLOEXEC);
  void* mapped = fd < 0 ? MAP_FAILED : mmap(nullptr, kRamBytes, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
  if (fd >= 0) (void)close(fd);
  if (mapped == MAP_FAILED) throw mdat::RunError(folder + "/ram.bin: the board's memory cannot be mapped");
  ram_ = static_cast<std::uint8_t*>(mapped);
  return ram_;
}

}  // namespace lasso::pil
