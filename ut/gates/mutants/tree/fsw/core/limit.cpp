#include "fsw/core/limit.hpp"

double larger(double a, double b) { return a > b ? a : b; }  // > or >= is the same

bool is_full(int count) { return count >= 8; }
