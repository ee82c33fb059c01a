// Numbers of binary answers: little-endian.
#pragma once

#include <string>
#include <vector>

#include "mdat/mcap/bytes.hpp"

namespace lasso::mdat::serve {

template <class T>
void put_all(const std::vector<T>& values, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

}  // namespace lasso::mdat::serve
