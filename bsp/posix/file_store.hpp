// The non-volatile store as files of a folder, one an area: image0, image1, parameters0, parameters1, events. What is written goes to the
// disk in that order by a thread of the store's own, so that a slot never waits for a disk.
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "fsw/mission/store.hpp"

namespace lasso::posix {

class FileStore final : public Store {
 public:
  // Makes folder and files where they are missing; images of up to `image_bytes` fit. opened() says whether all are there.
  FileStore(const std::string& folder, std::size_t image_bytes);
  ~FileStore();  // everything is on the disk then
  FileStore(const FileStore&) = delete;
  FileStore& operator=(const FileStore&) = delete;

  bool opened() const;
  std::size_t size(StoreArea area) const override;
  // Sees what was written before, wherever it is by now.
  Status read(StoreArea area, std::size_t offset, Bytes out) override;
  // Never waits. kNoData once a write to the area has failed, or when kMostWaiting bytes wait.
  Status write(StoreArea area, std::size_t offset, ConstBytes data) override;

  static constexpr std::size_t kMostWaiting = 16U << 20;

 private:
  struct Write {
    std::size_t area = 0, offset = 0;
    std::vector<std::uint8_t> data;
  };
  bool inside(StoreArea area, std::size_t offset, std::size_t bytes) const;
  static void overlay(const Write& write, std::size_t offset, Bytes out);
  void work();
  bool carry_out(const Write& write) const;

  int files_[kStoreAreas] = {};
  std::size_t sizes_[kStoreAreas] = {};

  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::deque<Write> writes_;  // the first one is being carried out
  std::size_t waiting_ = 0;   // bytes of all of them
  bool failed_[kStoreAreas] = {};
  bool ending_ = false;
  std::thread worker_;  // last: uses all of the above
};

}  // namespace lasso::posix
