// A parameter by its key: the place of its row, and its id on the link.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "fsw/mission/parameters.hpp"

namespace lasso::test {

inline std::size_t row_of(const std::string& key) {
  for (std::size_t i = 0; i < parameter_rows().size(); ++i) {
    if (key == parameter_rows()[i].key) return i;
  }
  ADD_FAILURE() << key;
  return 0;
}
inline std::uint16_t id_of(const std::string& key) { return parameter_rows()[row_of(key)].id; }

}  // namespace lasso::test
