// How a board starts a component that has two image buffers: with its store's image, or with the one that the board has been given.
#pragma once

#include "fsw/exec/component.hpp"

namespace lasso {

struct ImageStart {
  LoadFailure failure;
  bool from_store = false;
};

// Gives the component its memory (both buffers, which are not empty), and starts it with the store's image, or with `given`, which is
// copied, where there is no store or none of its images is right. An area of the store that counts is not overwritten by `given`. Before
// begin().
ImageStart start_image(Component& component, const BoardMemory& memory, ConstBytes given);

}  // namespace lasso
