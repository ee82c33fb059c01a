// Two threads count, and nobody takes turns.
#include <thread>
static int count = 0;
static void add() {
  for (int i = 0; i < 1000; ++i) ++count;
}
int main() {
  std::thread other(add);
  add();
  other.join();
  return count > 0 ? 0 : 1;
}
