#pragma once

double larger(double a, double b);
bool is_full(int count);
inline int half(int even) { return even / 2; }
