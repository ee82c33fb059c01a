int main(int argc, char**) {
  const unsigned char narrow = argc;
  return narrow - 1;
}
