int main(int argc, char**) {
  for (int i = 0; i < argc; ++i) {
    const int argc = i;
    if (argc > 2) return 1;
  }
  return 0;
}
