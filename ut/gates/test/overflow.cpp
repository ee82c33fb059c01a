// Writes one past the end of what it owns.
int main(int argc, char**) {
  int* numbers = new int[4]();
  numbers[argc + 3] = 1;
  const int sum = numbers[0] + numbers[3];
  delete[] numbers;
  return sum;
}
