// Asks for the sign of each argument.
#include <cstdlib>

#include "fsw/core/many.hpp"

int sign(int x);

int main(int argc, char** argv) {
  const int all =
#include "all.inc"
      0;
  int sum = 0;
  for (int i = 1; i < argc; ++i) sum += sign(std::atoi(argv[i]));
  return all == 60 && sum < argc ? 0 : 1;
}
