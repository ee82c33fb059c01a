// Beside the path: floating point for each label; WITHOUT: none any more.
#ifdef WITHOUT
using Real = int;
#else
using Real = double;
#endif
Real weigh(const Real* labels, int count);
Real weigh(const Real* labels, int count) {
  Real sum = 0;
  for (int i = 0; i < count; ++i) sum += labels[i] * labels[i];
  return sum;
}
