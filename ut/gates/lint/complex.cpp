// Short, and hard to follow.
int planted(const int* values, int n);

int planted(const int* values, int n) {
  int sum = 0;
  for (int i = 0; i < n; ++i) {
    if (values[i] > 0) {
      for (int j = 0; j < i; ++j) {
        if (values[j] > values[i] && (values[j] < 10 || values[i] > 3)) sum += values[j] > 5 ? 1 : 2;
      }
    } else if (values[i] < -5) {
      while (sum > values[i]) --sum;
    }
  }
  return sum;
}
