// Asks both() of each argument's two digits, and for the sign of its first.
bool both(bool a, bool b);
int sign(int x);

int main(int argc, char** argv) {
  int sum = 0;
  for (int i = 1; i < argc; ++i) sum += (both(argv[i][0] == '1', argv[i][1] == '1') ? 1 : 0) + sign(argv[i][0] - '0');
  return sum < 2 * argc ? 0 : 1;
}
