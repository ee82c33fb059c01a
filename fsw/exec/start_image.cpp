#include "fsw/exec/start_image.hpp"

#include <algorithm>

#include "fsw/mission/stored_record.hpp"

namespace lasso {

ImageStart start_image(Component& component, const BoardMemory& memory, ConstBytes given) {
  const Status taken = component.use_memory(memory);
  if (taken != Status::kOk) return {{taken, 0, 0, "the component refuses its memory"}, false};
  if (memory.store != nullptr && !failed(component.load_stored_image())) return {{}, true};
  if (given.size() > memory.image_buffers[0].size()) return {{Status::kOverCapacity, 0, 0, "the image is longer than its buffer"}, false};
  const bool first_counts = memory.store != nullptr && newer_of(*memory.store, StoreArea::kImage0, StoreArea::kImage1) == Newer::kFirst;
  const Bytes buffer = memory.image_buffers[first_counts ? 1 : 0].first(given.size());
  std::copy(given.begin(), given.end(), buffer.begin());
  return {component.load_image(buffer), false};
}

}  // namespace lasso
