void planted(unsigned n) { asm volatile("" : : "r"(__builtin_alloca(n)) : "memory"); }
