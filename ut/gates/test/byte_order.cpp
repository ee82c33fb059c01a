// Passes on the host, and fails on the target, whose first byte is the highest.
#include <cstring>
int main() {
  const int one = 1;
  unsigned char first = 0;
  std::memcpy(&first, &one, 1);
  return first == 1 ? 0 : 1;
}
