#include "bsp/posix/file_store.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "fsw/mission/stored_record.hpp"

namespace lasso::posix {
namespace {

constexpr const char* kNames[kStoreAreas] = {"image0", "image1", "parameters0", "parameters1", "events"};
constexpr std::size_t kParameterBytes = 16384;
constexpr std::size_t kEventBytes = 65536;
constexpr mode_t kFolderMode = 0755, kFileMode = 0644;

std::size_t size_of(StoreArea area, std::size_t image_bytes) {
  if (area == StoreArea::kImage0 || area == StoreArea::kImage1) return kStoredHeaderBytes + image_bytes;
  return area == StoreArea::kEventLog ? kEventBytes : kParameterBytes;
}

// A file of that size at least: what was never written is zero.
int open_area(const std::string& path, std::size_t bytes) {
  const int file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kFileMode);
  struct stat state {};
  if (file < 0) return file;
  const bool sized =
      fstat(file, &state) == 0 && (static_cast<std::size_t>(state.st_size) >= bytes || ftruncate(file, static_cast<off_t>(bytes)) == 0);
  if (sized) return file;
  (void)close(file);
  return -1;
}

}  // namespace

FileStore::FileStore(const std::string& folder, std::size_t image_bytes) {
  (void)mkdir(folder.c_str(), kFolderMode);  // it may be there
  for (std::size_t i = 0; i < kStoreAreas; ++i) {
    sizes_[i] = size_of(static_cast<StoreArea>(i), image_bytes);
    files_[i] = open_area(folder + "/" + kNames[i], sizes_[i]);
  }
}

FileStore::~FileStore() {
  for (const int file : files_) {
    if (file >= 0) (void)close(file);
  }
}

bool FileStore::opened() const {
  bool all = true;
  for (const int file : files_) all = all && file >= 0;
  return all;
}

std::size_t FileStore::size(StoreArea area) const { return sizes_[static_cast<std::size_t>(area)]; }

bool FileStore::inside(StoreArea area, std::size_t offset, std::size_t bytes) const {
  return offset <= size(area) && bytes <= size(area) - offset;
}

Status FileStore::read(StoreArea area, std::size_t offset, Bytes out) {
  if (!inside(area, offset, out.size())) return Status::kBadIndex;
  const ssize_t got = pread(files_[static_cast<std::size_t>(area)], out.data(), out.size(), static_cast<off_t>(offset));
  return got == static_cast<ssize_t>(out.size()) ? Status::kOk : Status::kNoData;
}

Status FileStore::write(StoreArea area, std::size_t offset, ConstBytes data) {
  if (!inside(area, offset, data.size())) return Status::kBadIndex;
  const int file = files_[static_cast<std::size_t>(area)];
  const ssize_t put = pwrite(file, data.data(), data.size(), static_cast<off_t>(offset));
  return put == static_cast<ssize_t>(data.size()) && fdatasync(file) == 0 ? Status::kOk : Status::kNoData;
}

}  // namespace lasso::posix
