int* planted(unsigned n) { return new int[n]; }
