int first();
[[gnu::noinline]] int first() {
  volatile int value = 7;
  return value;
}
int planted = first();
