[[gnu::noinline]] static void below(char* bytes) { asm volatile("" : : "r"(bytes) : "memory"); }
int task(int n) {
  char bytes[1000];
  below(bytes);
  return n + bytes[0];
}
