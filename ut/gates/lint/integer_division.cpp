double half(int number);

double half(int number) { return number / 2; }
