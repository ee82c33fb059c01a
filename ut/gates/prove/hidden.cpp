// A variable of the name of what libm.cpp calls, which only its own file sees: it does not define it.
static volatile int sin;
int planted() { return sin; }
