// A campaign's folder for a test, which goes with it.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace lasso::test {

class ChunkFolder {
 public:
  ChunkFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "campaign-XXXXXX").string();
    path_ = mkdtemp(name.data());
    std::filesystem::create_directory(path_ / "chunks");
  }
  ~ChunkFolder() { std::filesystem::remove_all(path_); }
  ChunkFolder(const ChunkFolder&) = delete;
  ChunkFolder& operator=(const ChunkFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path chunk(const std::string& name) const { return path_ / "chunks" / name; }
  void write(const std::string& name, const std::string& text) const { std::ofstream(chunk(name), std::ios::binary) << text; }
  std::string read(const std::string& name) const {
    std::ifstream in(chunk(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  bool has(const std::string& name) const { return std::filesystem::exists(chunk(name)); }

 private:
  std::filesystem::path path_;
};

// The message of the error of this kind; empty if none is thrown.
template <class Error, class Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

inline const std::string kPlan(64, 'a');

}  // namespace lasso::test
