// What the compiler takes for granted on this processor beside bsp/bare/runtime.cpp: what libgcc's division of integers, for which there is
// no instruction, does with zero.
#include "fsw/core/invariant.hpp"

extern "C" {
[[noreturn]] int __aeabi_idiv0(int);              // NOLINT(bugprone-reserved-identifier): libgcc asks for this name
[[noreturn]] long long __aeabi_ldiv0(long long);  // NOLINT(bugprone-reserved-identifier): likewise
}

int __aeabi_idiv0(int) { lasso::fail_invariant("division by zero"); }

long long __aeabi_ldiv0(long long) { lasso::fail_invariant("division by zero"); }
