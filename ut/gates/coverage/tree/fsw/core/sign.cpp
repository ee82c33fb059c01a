int calls = 0;
int sign(int x) {
  if (x < 0) {
    ++calls;
    return -1;
  }
  ++calls;
  return x > 0 ? 1 : 0;
}
