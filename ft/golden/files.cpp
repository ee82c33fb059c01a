#include "ft/golden/files.hpp"

#include <cstdio>

namespace lasso::golden {

bool read_file(const char* name, File& file) {
  std::FILE* in = std::fopen(name, "rb");
  if (in == nullptr) return false;
  file.size = 0;
  std::size_t n = 1;
  while (n > 0) {
    if (file.size == file.memory.size() * 8) file.memory.resize(2 * file.memory.size() + 8192);
    std::uint8_t* end = reinterpret_cast<std::uint8_t*>(file.memory.data()) + file.size;
    n = std::fread(end, 1, file.memory.size() * 8 - file.size, in);
    file.size += n;
  }
  const bool whole = std::ferror(in) == 0;
  return std::fclose(in) == 0 && whole;
}

bool write_file(const char* name, ConstBytes bytes) {
  std::FILE* out = std::fopen(name, "wb");
  if (out == nullptr) return false;
  const bool whole = std::fwrite(bytes.data(), 1, bytes.size(), out) == bytes.size();
  return std::fclose(out) == 0 && whole;
}

}  // namespace lasso::golden
