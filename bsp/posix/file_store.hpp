// The non-volatile store as files of a folder, one an area: image0, image1, parameters0, parameters1, events. Writes reach the disk before
// they return.
#pragma once

#include <string>

#include "fsw/mission/store.hpp"

namespace lasso::posix {

class FileStore final : public Store {
 public:
  // Makes folder and files where they are missing; images of up to `image_bytes` fit. opened() says whether all are there.
  FileStore(const std::string& folder, std::size_t image_bytes);
  ~FileStore();
  FileStore(const FileStore&) = delete;
  FileStore& operator=(const FileStore&) = delete;

  bool opened() const;
  std::size_t size(StoreArea area) const override;
  Status read(StoreArea area, std::size_t offset, Bytes out) override;
  Status write(StoreArea area, std::size_t offset, ConstBytes data) override;

 private:
  bool inside(StoreArea area, std::size_t offset, std::size_t bytes) const;

  int files_[kStoreAreas] = {};
  std::size_t sizes_[kStoreAreas] = {};
};

}  // namespace lasso::posix
