// printf into a string.
#pragma once

#include <string>

namespace lasso::mdat {

[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...);

}  // namespace lasso::mdat
