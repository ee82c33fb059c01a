// The user's wish to end what has no end of its own, or takes long: Ctrl-C, or SIGTERM.
#pragma once

#include <atomic>

namespace lasso::mdat {

// From the first call on these signals end nothing by themselves: they set this.
const std::atomic<bool>& interruption();

}  // namespace lasso::mdat
