// Of two functions, so that the compiler makes no loop of it.
int down(int n);
[[gnu::noinline]] int planted(int n) { return n < 2 ? n : down(n - 1) + n; }
[[gnu::noinline]] int down(int n) { return planted(n - 1) * 3; }
