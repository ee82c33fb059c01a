// A per-point path of one function; FLOATING plants floating point in it, OTHER another number type.
#ifdef OTHER
struct OtherNumber;
using N = OtherNumber;
#else
struct FixedNumber;
using N = FixedNumber;
#endif

template <class N>
int match(const int* a, int count) {
  int sum = 0;
  for (int i = 0; i < count; ++i) sum += a[i] * a[i] >> 3;
#ifdef CALLING
  return static_cast<int>(__builtin_sqrtf(static_cast<float>(sum)));
#elif defined(FLOATING)
  return static_cast<int>(0.5F * static_cast<float>(sum));
#else
  return sum;
#endif
}

template int match<N>(const int*, int);
