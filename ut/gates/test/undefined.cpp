#include <limits>
int main(int argc, char**) {
  int number = std::numeric_limits<int>::max();
  number += argc;
  return number == 0 ? 1 : 0;
}
