#include "fsw/core/invariant.hpp"

// The build says "thread_local" where a board has threads. Without any, an interrupt that runs the same component's code leaves what it
// found.
#ifndef LASSO_PER_THREAD
#define LASSO_PER_THREAD
#endif

namespace lasso {
namespace {

LASSO_PER_THREAD const Identity* running = nullptr;

}  // namespace

void fail_invariant(const char* what) {
  if (running == nullptr) on_invariant_failure({what, 0, nullptr});
  on_invariant_failure({what, running->apid, running->context});
}

Running::Running(const Identity& identity) : outer_(running) { running = &identity; }
Running::~Running() { running = outer_; }

}  // namespace lasso
