// A tail call: the machine code has a jump where the source has a call.
int planted(int (*f)(int)) { return f(1); }
