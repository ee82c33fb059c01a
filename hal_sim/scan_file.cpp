#include "hal_sim/scan_file.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <set>

#include "hal_sim/scan_text.hpp"

namespace lasso::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestFileBytes = 64u << 20;  // far above any scan of kMaxRays

using Reader = RangeImage (*)(const std::string&, std::string_view);

Reader reader_of(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
  if (extension == ".csv") return read_csv;
  if (extension == ".ply") return read_ply;
  if (extension == ".pcd") return read_pcd;
  return nullptr;
}

std::string contents_of(const fs::path& file) {
  std::error_code error;
  const bool regular = fs::is_regular_file(file, error);
  const std::uintmax_t size = regular ? fs::file_size(file, error) : 0;
  if (!regular || error) fail(file.string(), "is not a file that can be read; check its name");
  if (size > kLargestFileBytes) fail(file.string(), "has " + std::to_string(size) + " bytes, expected at most 64 MiB; is it a scan?");
  std::ifstream in(file, std::ios::binary);
  std::string text(static_cast<std::size_t>(size), '\0');
  if (!in.read(text.data(), static_cast<std::streamsize>(size))) fail(file.string(), "cannot be read; check your rights to it");
  return text;
}

std::vector<fs::path> scans_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (reader_of(entry->path()) != nullptr && entry->is_regular_file()) files.push_back(entry->path());
  }
  if (error) fail(folder.string(), "is not a folder that can be read (" + error.message() + ")");
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) { return a.filename().string() < b.filename().string(); });
  return files;
}

}  // namespace

RangeImage read_scan_file(const fs::path& file) {
  const Reader reader = reader_of(file);
  if (reader == nullptr) fail(file.string(), "is no scan file, expected .csv, .ply or .pcd");
  return reader(file.string(), contents_of(file));
}

RecordedScans::RecordedScans(const fs::path& folder) : files_(scans_in(folder)) {
  if (files_.empty()) fail(folder.string(), "holds no scan, expected .csv, .ply or .pcd files");
  std::set<std::string> stems;
  for (const fs::path& file : files_) {
    if (!stems.insert(file.stem().string()).second) {
      fail(file.string(), "another scan of this folder has the stem " + shown(file.stem().string()) + " too; rename one of them");
    }
  }
}

RangeImage RecordedScans::read(std::size_t i) const {
  RangeImage image = read_scan_file(file(i));
  image.scan_id = static_cast<std::uint32_t>(i);
  return image;
}

void RecordedScans::check() const {
  for (const std::filesystem::path& scan : files_) (void)read_scan_file(scan);
}

}  // namespace lasso::sim
