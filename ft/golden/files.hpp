// Whole files, by C's means alone: these programs run on the emulated target as well.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fsw/core/span.hpp"

namespace lasso::golden {

// A file's bytes, 8-byte aligned as the image loader wants them.
struct File {
  std::vector<std::uint64_t> memory;
  std::size_t size = 0;
  Bytes bytes() { return {reinterpret_cast<std::uint8_t*>(memory.data()), size}; }
};

bool read_file(const char* name, File& file);
bool write_file(const char* name, ConstBytes bytes);

}  // namespace lasso::golden
