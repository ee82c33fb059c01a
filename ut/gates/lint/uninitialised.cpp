int planted(int n);

int planted(int n) {
  int value;
  if (n > 3) value = 1;
  return value;
}
