// A file that a fuzzer starts from.
#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace lasso::fuzz {

// With its folder. Throws std::runtime_error.
inline void write(const std::filesystem::path& file, const std::string& bytes) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream out(file, std::ios::binary);
  out << bytes;
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

// The option byte, then what it speaks of.
inline std::string seed(char option, const void* bytes, std::size_t size) {
  return std::string(1, option) + std::string(static_cast<const char*>(bytes), size);
}
inline std::string seed(char option, const std::string& text) { return seed(option, text.data(), text.size()); }

}  // namespace lasso::fuzz
