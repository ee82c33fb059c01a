#include "bsp/bare/cpu.hpp"

namespace lasso::bare {

void write_back(ConstBytes written) {
  const std::uint8_t* const at = written.data();
  const std::size_t bytes = written.size();
  for (std::size_t i = 0; i < bytes; i += kCacheLineBytes) write_back_line(at + i);
  if (bytes > 0) write_back_line(at + bytes - 1);
  await_write_back();
}

}  // namespace lasso::bare
