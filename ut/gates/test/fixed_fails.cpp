// Fails in the fixed-point build alone.
int main() {
#ifdef LASSO_FIXED_POINT
  return 1;
#else
  return 0;
#endif
}
