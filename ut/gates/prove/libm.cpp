#include <cmath>
double planted(double x) { return std::sin(x); }
