// What the compiler takes for granted on this processor beside bsp/bare/runtime.cpp. It has no instruction that divides integers.
#include "fsw/core/invariant.hpp"

extern "C" {
int __aeabi_idiv0(int) {
  lasso::on_invariant_failure("division by zero");
}  // NOLINT(bugprone-reserved-identifier): libgcc asks for these names
long long __aeabi_ldiv0(long long) { lasso::on_invariant_failure("division by zero"); }
int __aeabi_atexit(void*, void (*)(void*), void*) { return 0; }
}
