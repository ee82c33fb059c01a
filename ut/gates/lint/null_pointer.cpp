// Only a path through both conditions shows it.
int planted(int n);

int planted(int n) {
  int value = 7;
  int* pointer = &value;
  if (n > 3) pointer = nullptr;
  if (n > 4) return *pointer;
  return value;
}
