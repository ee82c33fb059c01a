// Memory at a place that is the same in each run, between pages that nobody may touch: a flipped bit of a pointer then leads to the same
// place, or to the same end, whenever it is repeated.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <stdexcept>

namespace lasso::campaign {

class Arena {
 public:
  // Zeroed, for the life of the process.
  void* take(std::size_t size) {
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    void* place = reinterpret_cast<void*>(next_);  // NOLINT(performance-no-int-to-ptr): the place is chosen
    const std::size_t whole = (size + page - 1) / page * page;
    void* memory = mmap(place, whole, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED_NOREPLACE, -1, 0);
    if (memory != place) throw std::runtime_error("the memory at the campaign's fixed addresses is taken");
    next_ += whole + page;
    return memory;
  }

 private:
  std::uintptr_t next_ = 0x300000000000;  // no flip of one bit leads from here to where Linux puts programs, heaps and stacks
};

}  // namespace lasso::campaign
