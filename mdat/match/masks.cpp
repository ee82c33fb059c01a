#include "mdat/match/masks.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace lasso::mdat {
namespace {

constexpr double kGreatestCode = 255;
constexpr double kLeastLight_e = 10;      // codes of the darkest pixels are coarser than the read noise
constexpr double kSobelGain = 12.0 / 64;  // variance of Sobel's gradient, divided by 8, for each of the noise
constexpr double kRoundingVariance = 1.0 / 12;

double electrons_of_code(double code, const PairCodes& kind) {
  const double share = code / kGreatestCode;
  return kind.full_well_e * (kind.square_root ? share * share : share);
}

cv::Mat window_mean(const cv::Mat& image) {
  cv::Mat mean;
  cv::boxFilter(image, mean, CV_32F, {kMaskWindow_px, kMaskWindow_px}, {-1, -1}, true, cv::BORDER_REPLICATE);
  return mean;
}

cv::Mat square_about(int reach_px) { return cv::getStructuringElement(cv::MORPH_RECT, {2 * reach_px + 1, 2 * reach_px + 1}); }

// Variance of a code where there are `electrons` on average: d code / d e squared times shot and read noise, and rounding.
float code_variance(float electrons, const PairCodes& kind) {
  const double e = std::max(1.0, static_cast<double>(electrons));
  const double slope = kind.square_root ? kGreatestCode / (2 * std::sqrt(kind.full_well_e * e)) : kGreatestCode / kind.full_well_e;
  return static_cast<float>(slope * slope * (e + kind.read_noise_e * kind.read_noise_e) + kRoundingVariance);
}

}  // namespace

cv::Mat electrons_of(const cv::Mat& codes, const PairCodes& kind) {
  cv::Mat table(1, 256, CV_32F), electrons;
  for (int code = 0; code < 256; ++code) table.at<float>(code) = static_cast<float>(electrons_of_code(code, kind));
  cv::LUT(codes, table, electrons);
  return electrons;
}

cv::Mat lit_mask(const cv::Mat& codes, const PairCodes& kind) {
  const double step_e = electrons_of_code(1, kind);
  const double noise_e = std::sqrt(kind.read_noise_e * kind.read_noise_e + kRoundingVariance * step_e * step_e);
  const double least_e = kLightSigmas * noise_e / kMaskWindow_px + std::max(kLeastLight_e, 0.5 * step_e);
  const cv::Mat light = window_mean(electrons_of(codes, kind));
  cv::Mat lit = light > least_e, brightest, shade;
  cv::erode(lit, lit, square_about(kSkyMargin_px));
  cv::dilate(light, brightest, square_about(kShadeReach_px));
  cv::dilate(light < kShadeShare * brightest, shade, square_about(kShadeMargin_px));
  return lit & ~shade;
}

cv::Mat glint_mask(const cv::Mat& codes, const PairCodes& kind) {
  cv::Mat glint = window_mean(electrons_of(codes, kind)) > kGlintShare * kind.full_well_e;
  cv::dilate(glint, glint, square_about(kGlintMargin_px));
  return glint;
}

cv::Mat predicted_sigma_px(const cv::Mat& codes, const PairCodes& kind) {
  const double count = kMaskWindow_px * kMaskWindow_px;
  cv::Mat gradient;
  cv::Sobel(codes, gradient, CV_32F, 1, 0, 3, 1.0 / 8, 0, cv::BORDER_REPLICATE);
  const cv::Mat light = window_mean(electrons_of(codes, kind)), energy = count * window_mean(gradient.mul(gradient));
  cv::Mat sigma(codes.size(), CV_32F);
  for (int row = 0; row < codes.rows; ++row) {
    for (int column = 0; column < codes.cols; ++column) {
      const double variance = static_cast<double>(code_variance(light.at<float>(row, column), kind));
      const double texture = static_cast<double>(energy.at<float>(row, column)) - count * kSobelGain * variance;
      sigma.at<float>(row, column) = static_cast<float>(std::sqrt(2 * variance / std::max(1e-6, texture)));
    }
  }
  return sigma;
}

}  // namespace lasso::mdat
