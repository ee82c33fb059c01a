// Whole numbers of the command lines of campaigns and rigs.
#pragma once

#include <charconv>
#include <limits>
#include <string>

#include "mdat/common/errors.hpp"

namespace lasso::mdat {

// Throws InputError, which names it: not digits alone, or fewer than `least`, or more than its type holds.
template <class Number>
Number count_of(const std::string& name, const std::string& text, Number least = 0) {
  Number number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || stop != end || number < least)
    throw InputError(name + "=" + text + ": a whole number from " + std::to_string(least) + " to " +
                     std::to_string(std::numeric_limits<Number>::max()) + " is needed");
  return number;
}

}  // namespace lasso::mdat
