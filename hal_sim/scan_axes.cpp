// What conventions of axes are called, and the rotations that they are.
#include <algorithm>
#include <cctype>

#include "hal_sim/raw_scan.hpp"
#include "hal_sim/scan_text.hpp"

namespace lasso::sim {
namespace {

constexpr char kExpected[] =
    "expected what the file's x, y and z point to, such as forward-right-down, forward-left-up or right-up-backward, or which of the "
    "file's axes "
    "the sensor's x (right), y (down) and z (forward) are, such as y,z,x";

struct Word {
  std::string_view name;
  int axis;  // of the sensor frame
  double sign;
};
constexpr Word kWords[] = {{"right", 0, 1}, {"left", 0, -1}, {"down", 1, 1}, {"up", 1, -1}, {"forward", 2, 1}, {"backward", 2, -1}};
constexpr Word kLetters[] = {{"x", 0, 1},   {"-x", 0, -1}, {"y", 1, 1},  {"-y", 1, -1}, {"z", 2, 1},
                             {"-z", 2, -1}, {"+x", 0, 1},  {"+y", 1, 1}, {"+z", 2, 1}};

template <std::size_t N>
const Word* find(const Word (&words)[N], std::string_view name) {
  const Word* const found = std::find_if(std::begin(words), std::end(words), [&](const Word& word) { return word.name == name; });
  return found == std::end(words) ? nullptr : found;
}

[[noreturn]] void refuse(std::string_view text) { fail("--axes", "is " + shown(text) + ", " + kExpected); }

}  // namespace

Mat3 axes_of(std::string_view text) {
  const bool letters = text.find(',') != std::string_view::npos;
  const auto names = split(text, letters ? ',' : '-');
  if (names.size() != 3) refuse(text);
  Mat3 R = Mat3::Zero();
  for (int i = 0; i < 3; ++i) {
    const std::string_view name = names[static_cast<std::size_t>(i)];
    const Word* const word = letters ? find(kLetters, name) : find(kWords, name);
    if (word == nullptr) refuse(text);
    letters ? R(i, word->axis) = word->sign : R(word->axis, i) = word->sign;
  }
  if (std::abs(R.determinant()) < 0.5) refuse(text);  // an axis stands there twice
  return R;
}

}  // namespace lasso::sim
