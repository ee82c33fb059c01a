#include "fsw/core/clean.hpp"

namespace lasso {

int absolute(int value) { return value < 0 ? -value : value; }

}  // namespace lasso
