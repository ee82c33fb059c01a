#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "mdat/render/picture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

constexpr Pixel kInk = {255, 255, 255};

std::vector<Pixel> drawn(const std::string& text, int scale = 1) {
  Picture picture(text_width(text, scale) + 2, scale * kLetterHeight);
  write(picture, 0, 0, text, kInk, scale);
  return picture.pixels;
}

std::ptrdiff_t ink(const std::vector<Pixel>& pixels) { return std::count(pixels.begin(), pixels.end(), kInk); }

TEST(Letters, EachHasAShapeOfItsOwn) {
  VERIFIES("LASSO-PIC-001~1");
  const std::string all = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz.,:;-+/()%='_<>?\"&#";
  std::set<std::vector<Pixel>> shapes;
  for (const char letter : all) {
    shapes.insert(drawn({letter}));
    EXPECT_GT(ink(drawn({letter})), 1) << letter;
  }
  EXPECT_EQ(shapes.size(), all.size());
  EXPECT_EQ(ink(drawn(" ")), 0);
  EXPECT_EQ(drawn("\xe9"), drawn("?"));
}

TEST(Letters, GrowWithTheScale) {
  VERIFIES("LASSO-PIC-001~1");
  EXPECT_EQ(ink(drawn("Range 3 m", 3)), 9 * ink(drawn("Range 3 m")));
}

TEST(Letters, DoNotTouchEachOtherAndAreCutAtTheEdge) {
  VERIFIES("LASSO-PIC-001~1");
  Picture picture(12, 9);
  write(picture, 0, 0, "MM", kInk, 1);
  for (int row = 0; row < 9; ++row) EXPECT_NE(picture.at(5, row), kInk);
  write(picture, 8, 5, "MMMM", kInk, 1);  // most of it lies outside
  write(picture, -30, -3, "MM", kInk, 1);
}

}  // namespace
}  // namespace lasso::mdat
