#include "bsp/posix/file_store.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>

#include "fsw/mission/stored_record.hpp"

namespace lasso::posix {
namespace {

constexpr const char* kNames[kStoreAreas] = {"image0", "image1", "parameters0", "parameters1", "events"};
constexpr mode_t kFolderMode = 0755, kFileMode = 0644;

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
    sizes_[i] = stored_area_bytes(static_cast<StoreArea>(i), image_bytes);
    files_[i] = open_area(folder + "/" + kNames[i], sizes_[i]);
    failed_[i] = files_[i] < 0;
  }
  worker_ = std::thread(&FileStore::work, this);
}

FileStore::~FileStore() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  worker_.join();
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
  const auto index = static_cast<std::size_t>(area);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (failed_[index]) return Status::kNoData;
  const ssize_t got = pread(files_[index], out.data(), out.size(), static_cast<off_t>(offset));
  if (got != static_cast<ssize_t>(out.size())) return Status::kNoData;
  for (const Write& write : writes_) {
    if (write.area == index) overlay(write, offset, out);
  }
  return Status::kOk;
}

// What of it lies in `out`, which begins at `offset`.
void FileStore::overlay(const Write& write, std::size_t offset, Bytes out) {
  const std::size_t begin = std::max(write.offset, offset), end = std::min(write.offset + write.data.size(), offset + out.size());
  for (std::size_t at = begin; at < end; ++at) out[at - offset] = write.data[at - write.offset];
}

Status FileStore::write(StoreArea area, std::size_t offset, ConstBytes data) {
  if (!inside(area, offset, data.size())) return Status::kBadIndex;
  const auto index = static_cast<std::size_t>(area);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (failed_[index] || waiting_ + data.size() > kMostWaiting) return Status::kNoData;
    writes_.push_back({index, offset, std::vector<std::uint8_t>(data.begin(), data.end())});
    waiting_ += data.size();
  }
  changed_.notify_all();
  return Status::kOk;
}

// On the disk before the next one begins: a loss of power leaves what was written up to some moment.
bool FileStore::carry_out(const Write& write) const {
  const ssize_t put = pwrite(files_[write.area], write.data.data(), write.data.size(), static_cast<off_t>(write.offset));
  return put == static_cast<ssize_t>(write.data.size()) && fdatasync(files_[write.area]) == 0;
}

void FileStore::work() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return ending_ || !writes_.empty(); });
    if (writes_.empty()) return;
    const Write& write = writes_.front();  // stays where it is: others are added behind it
    const bool skipped = failed_[write.area];
    lock.unlock();
    const bool done = !skipped && carry_out(write);
    lock.lock();
    failed_[write.area] = failed_[write.area] || !done;
    waiting_ -= write.data.size();
    writes_.pop_front();
    changed_.notify_all();
  }
}

}  // namespace lasso::posix
