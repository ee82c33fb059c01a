// mdat-embed FOLDER OUT.cpp: the files of a folder, compressed, as the source of page_files(). A folder that is not there gives none.
#define ZLIB_CONST
#include <zlib.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

constexpr int kGzipWindow = 16 + MAX_WBITS, kMemory = 9;
constexpr std::size_t kLineBytes = 16;

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error(file.string() + ": cannot be read");
  return {std::istreambuf_iterator<char>(in), {}};
}

// The same bytes each time: the header says no time.
std::string gzipped(const std::string& bytes) {
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kGzipWindow, kMemory, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::runtime_error("zlib cannot begin");
  std::string result(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<const Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  const int status = deflate(&stream, Z_FINISH);
  result.resize(stream.total_out);
  deflateEnd(&stream);
  if (status != Z_STREAM_END) throw std::runtime_error("zlib cannot compress");
  return result;
}

// Characters one by one: a text may not be as long as a file.
std::string characters(const std::string& bytes) {
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); at += kLineBytes) {
    text += "   ";
    for (const char c : bytes.substr(at, kLineBytes)) {
      char octal[12];
      (void)std::snprintf(octal, sizeof octal, " '\\%03o',", static_cast<unsigned>(static_cast<unsigned char>(c)));
      text += octal;
    }
    text += "\n";
  }
  return text;
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::is_directory(folder)) return files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && entry.path().extension() != ".map") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string source_of(const fs::path& folder) {
  std::string text = "// Made by the build from the page: see mdat/serve/embed.\n";
  text += std::string("#") + "include \"mdat/serve/page_files.hpp\"\n\n";
  text += "namespace lasso::mdat::serve {\nnamespace {\n\n";
  std::string rows;
  int number = 0;
  for (const fs::path& file : files_in(folder)) {
    const std::string bytes = gzipped(bytes_of(file)), name = "kFile" + std::to_string(number++);
    text += "constexpr char " + name + "[] = {\n" + characters(bytes) + "};\n";
    rows += "      PageFile{\"" + file.filename().string() + "\", {" + name + ", " + std::to_string(bytes.size()) + "}},\n";
  }
  text += "\n}  // namespace\n\nstd::span<const PageFile> page_files() {\n";
  if (rows.empty()) return text + "  return {};\n}\n\n}  // namespace lasso::mdat::serve\n";
  return text + "  static constexpr PageFile kFiles[] = {\n" + rows + "  };\n  return kFiles;\n}\n\n}  // namespace lasso::mdat::serve\n";
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 3) throw std::runtime_error("usage: mdat-embed FOLDER OUT.cpp");
    std::ofstream out(argv[2], std::ios::binary);
    out << source_of(argv[1]);
    if (!out.flush()) throw std::runtime_error(std::string(argv[2]) + ": cannot be written");
    return 0;
  } catch (const std::exception& error) {
    (void)std::fprintf(stderr, "mdat-embed: %s\n", error.what());
    return 1;
  }
}
