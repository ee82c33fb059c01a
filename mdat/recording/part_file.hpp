// A file that is written beside its place, and gets its name once it is whole.
#pragma once

#include <filesystem>
#include <system_error>

#include "mdat/common/errors.hpp"

namespace lasso::mdat {

class PartFile {
 public:
  explicit PartFile(std::filesystem::path place) : place_(std::move(place)), part_(place_.string() + ".part") {}
  ~PartFile() {
    std::error_code ignored;
    if (!done_) std::filesystem::remove(part_, ignored);
  }
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  const std::filesystem::path& path() const { return part_; }
  // Throws InputError.
  void commit() {
    std::error_code error;
    std::filesystem::rename(part_, place_, error);
    if (error) throw InputError(place_.string() + ": cannot be written: " + error.message());
    done_ = true;
  }

 private:
  std::filesystem::path place_, part_;
  bool done_ = false;
};

}  // namespace lasso::mdat
