bool both(bool a, bool b) { return a && b; }
int sign(int x) { return x > 0 ? 1 : 0; }
