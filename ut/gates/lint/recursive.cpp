int planted(int n);

int planted(int n) { return n < 2 ? 1 : n * planted(n - 1); }
