// Undefined in the floating build alone.
#include <cstdio>

int main(int count, char**) {
#ifndef LASSO_FIXED_POINT
  return std::printf("%d\n", (-count) << 3) < 0;
#else
  return std::printf("%d\n", count) < 0;
#endif
}
