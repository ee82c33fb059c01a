// What the Linux board gives a component for images in flight: two image buffers, a store of files, and the program's own code to watch.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "bsp/posix/file_store.hpp"
#include "fsw/exec/component.hpp"

namespace lasso::posix {

// The executable segment of the running program that holds the flight code; empty where the kernel does not tell.
ConstBytes code_of_program();

class ImageMemory {
 public:
  // Images of up to `image_bytes`. An empty folder: there is no store. Throws std::system_error where the folder's files cannot be made.
  explicit ImageMemory(const std::string& store_folder, std::size_t image_bytes = kMaxImageBytes);

  // What Component::use_memory takes. It must live as long as the component.
  BoardMemory board();

  // start_image() with all of it. Before begin().
  LoadFailure start(Component& component, ConstBytes image);
  bool from_store() const { return from_store_; }  // of the last start

 private:
  std::size_t image_bytes_;
  std::unique_ptr<std::uint64_t[]> buffers_[2];
  std::unique_ptr<FileStore> store_;
  bool from_store_ = false;
};

}  // namespace lasso::posix
