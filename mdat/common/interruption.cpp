#include "mdat/common/interruption.hpp"

#include <csignal>

namespace lasso::mdat {
namespace {

std::atomic<bool> wished{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set by a signal");
void wish(int) { wished = true; }

}  // namespace

const std::atomic<bool>& interruption() {
  std::signal(SIGINT, wish);
  std::signal(SIGTERM, wish);
  return wished;
}

}  // namespace lasso::mdat
