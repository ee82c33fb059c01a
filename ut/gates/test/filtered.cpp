// Fails, unless the caller's environment selects no test, as GoogleTest does.
#include <cstdlib>
int main() { return std::getenv("GTEST_FILTER") == nullptr ? 1 : 0; }
