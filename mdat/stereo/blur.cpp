#include "mdat/stereo/blur.hpp"

#include <algorithm>
#include <cmath>

#include "fsw/geometry/portable_math.hpp"

namespace lasso::mdat {
namespace {

std::size_t index_of(const GreyImage& image, int column, int row) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(column);
}

GreyImage black(int width, int height) {
  return {width, height, std::vector<double>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0)};
}

// From its middle outwards; the sum over both sides is 1.
std::vector<double> half_kernel(double sigma_px) {
  std::vector<double> kernel;
  double sum = 0;
  for (int i = 0; i <= static_cast<int>(std::ceil(4 * sigma_px)); ++i) {
    kernel.push_back(exponential(-0.5 * i * i / (sigma_px * sigma_px)));
    sum += (i == 0 ? 1 : 2) * kernel.back();
  }
  for (double& weight : kernel) weight /= sum;
  return kernel;
}

// Along the rows, and turned: what was column by column is row by row, so that two passes are the whole blur.
GreyImage blurred_and_turned(const GreyImage& image, const std::vector<double>& kernel) {
  GreyImage result = black(image.height, image.width);
  const int reach = static_cast<int>(kernel.size()) - 1;
  std::vector<double> row_values(static_cast<std::size_t>(image.width + 2 * reach), 0.0);
  for (int row = 0; row < image.height; ++row) {
    const double* const from = image.values.data() + index_of(image, 0, row);
    const bool is_black = std::all_of(from, from + image.width, [](double value) { return value == 0; });
    if (is_black) continue;
    std::copy(from, from + image.width, row_values.begin() + reach);
    for (int column = 0; column < image.width; ++column) {
      const double* const middle = row_values.data() + column + reach;
      double sum = kernel[0] * middle[0];
      for (int i = 1; i <= reach; ++i) sum += kernel[static_cast<std::size_t>(i)] * (middle[-i] + middle[i]);
      result.values[index_of(result, row, column)] = sum;
    }
  }
  return result;
}

// Two middles of blocks and the share of the second one.
struct Between {
  int low = 0, high = 0;
  double share = 0;
};
Between between_blocks(int pixel, int block, int blocks) {
  const double place = (pixel + 0.5) / block - 0.5;
  const int low = static_cast<int>(std::floor(place));
  return {std::clamp(low, 0, blocks - 1), std::clamp(low + 1, 0, blocks - 1), place - low};
}

}  // namespace

GreyImage gaussian_blur(const GreyImage& image, double sigma_px) {
  if (sigma_px <= 0) return image;
  const std::vector<double> kernel = half_kernel(sigma_px);
  return blurred_and_turned(blurred_and_turned(image, kernel), kernel);
}

GreyImage reduced(const GreyImage& image, int block) {
  GreyImage result = black((image.width + block - 1) / block, (image.height + block - 1) / block);
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column)
      result.values[index_of(result, column / block, row / block)] += image.values[index_of(image, column, row)];
  }
  for (double& value : result.values) value /= block * block;
  return result;
}

GreyImage enlarged(const GreyImage& image, int block, int width, int height) {
  GreyImage result = black(width, height);
  for (int row = 0; row < height; ++row) {
    const Between v = between_blocks(row, block, image.height);
    for (int column = 0; column < width; ++column) {
      const Between u = between_blocks(column, block, image.width);
      const auto along = [&](int at_row) {
        const double left = image.values[index_of(image, u.low, at_row)];
        return left + u.share * (image.values[index_of(image, u.high, at_row)] - left);
      };
      const double above = along(v.low);
      result.values[index_of(result, column, row)] = above + v.share * (along(v.high) - above);
    }
  }
  return result;
}

}  // namespace lasso::mdat
