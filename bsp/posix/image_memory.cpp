#include "bsp/posix/image_memory.hpp"

#include <link.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "fsw/exec/lasso.hpp"
#include "fsw/exec/start_image.hpp"

namespace lasso::posix {
namespace {

constexpr std::size_t kMaxCodeBytes = 4U << 20;  // that a component watches

// The segment of `program` in which `place` is.
bool is_in(const dl_phdr_info& program, const ElfW(Phdr) & segment, std::uintptr_t place) {
  const std::uintptr_t begin = program.dlpi_addr + segment.p_vaddr;
  return segment.p_type == PT_LOAD && (segment.p_flags & PF_X) != 0 && place >= begin && place < begin + segment.p_memsz;
}

// Of a program that is larger than what is watched, the part around the flight code.
int find_code(dl_phdr_info* program, std::size_t, void* found) {
  const auto* here = reinterpret_cast<const std::uint8_t*>(&required_memory);
  const auto place = reinterpret_cast<std::uintptr_t>(here);
  for (std::size_t i = 0; i < program->dlpi_phnum; ++i) {
    const ElfW(Phdr)& segment = program->dlpi_phdr[i];
    if (!is_in(*program, segment, place)) continue;
    const std::uintptr_t begin = program->dlpi_addr + segment.p_vaddr, end = begin + segment.p_memsz;
    const std::uintptr_t from = std::max(begin, place > kMaxCodeBytes / 2 ? place - kMaxCodeBytes / 2 : 0);
    *static_cast<ConstBytes*>(found) = {here - (place - from), std::min<std::size_t>(end - from, kMaxCodeBytes)};
    return 1;
  }
  return 0;
}

}  // namespace

ConstBytes code_of_program() {
  ConstBytes code;
  (void)dl_iterate_phdr(find_code, &code);
  return code;
}

ImageMemory::ImageMemory(const std::string& store_folder, std::size_t image_bytes) : image_bytes_(image_bytes / 8 * 8) {
  for (auto& buffer : buffers_) buffer.reset(new std::uint64_t[image_bytes_ / 8]);  // its pages come with the first image
  if (store_folder.empty()) return;
  store_ = std::make_unique<FileStore>(store_folder, image_bytes_);
  if (!store_->opened()) throw std::system_error(errno, std::generic_category(), store_folder);
}

BoardMemory ImageMemory::board() {
  BoardMemory memory;
  for (std::size_t i = 0; i < 2; ++i) memory.image_buffers[i] = Bytes(reinterpret_cast<std::uint8_t*>(buffers_[i].get()), image_bytes_);
  memory.store = store_.get();
  memory.code = code_of_program();
  return memory;
}

LoadFailure ImageMemory::start(Component& component, ConstBytes image) {
  const ImageStart started = start_image(component, board(), image);
  from_store_ = started.from_store;
  return started.failure;
}

}  // namespace lasso::posix
