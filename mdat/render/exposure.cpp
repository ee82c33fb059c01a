#include "mdat/render/exposure.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lasso::mdat {
namespace {

constexpr double kLeastLit = 1e-6;  // of the brightest: darker pixels are not lit

// x^(1/5) by Newton's method: libm's powers differ between machines.
double fifth_root(double x) {
  double y = 0.5 + 0.5 * x;
  for (int i = 0; i < 60; ++i) y = 0.8 * y + 0.2 * x / (y * y * y * y);
  return y;
}

double linear_of(double code) {
  const double value = code / 255;
  if (value <= 0.04045) return value / 12.92;
  const double base = (value + 0.055) / 1.055, root = fifth_root(base);
  return base * base * root * root;  // to the power of 2.4
}

// Linear values between one code and the next.
const std::array<double, 255>& thresholds() {
  static const std::array<double, 255> table = [] {
    std::array<double, 255> values{};
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = linear_of(static_cast<double>(i) + 0.5);
    return values;
  }();
  return table;
}

}  // namespace

double automatic_white(const std::vector<Rgb>& radiance, const std::vector<SeenPoint>& seen) {
  std::vector<double> lit;
  double brightest = 0;
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    if (seen[i].hit) lit.push_back(luminance(radiance[i]));
    if (seen[i].hit) brightest = std::max(brightest, lit.back());
  }
  std::erase_if(lit, [&](double value) { return value <= kLeastLit * brightest; });
  if (lit.empty()) return 0;
  const auto place = lit.begin() + static_cast<std::ptrdiff_t>(kExposedShare * static_cast<double>(lit.size() - 1));
  std::nth_element(lit.begin(), place, lit.end());
  return *place / kExposedLevel;
}

std::uint8_t srgb_code(double linear) {
  const auto& table = thresholds();
  return static_cast<std::uint8_t>(std::upper_bound(table.begin(), table.end(), linear) - table.begin());
}

Picture photo(const std::vector<Rgb>& radiance, const Camera& camera, double white) {
  Picture picture(camera.width, camera.height);
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c)
      picture.pixels[i][c] = white > 0 ? srgb_code(radiance[i][static_cast<int>(c)] / white) : std::uint8_t{0};
  }
  return picture;
}

}  // namespace lasso::mdat
