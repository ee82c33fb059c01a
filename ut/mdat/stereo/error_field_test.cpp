#include "mdat/stereo/error_field.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// Of many fields, at two places.
struct FieldMoments {
  double mean = 0, variance = 0, product = 0;
};

FieldMoments moments_of(double off_px, double blur_px) {
  constexpr int kFields = 4000;
  FieldMoments sums;
  for (int i = 0; i < kFields; ++i) {
    const double a = error_field(static_cast<std::uint64_t>(i), 17.3, 40.8, blur_px);
    const double b = error_field(static_cast<std::uint64_t>(i), 17.3 + 0.6 * off_px, 40.8 - 0.8 * off_px, blur_px);
    sums.mean += a / kFields;
    sums.variance += a * a / kFields;
    sums.product += a * b / kFields;
  }
  return sums;
}

TEST(ErrorField, IsStandardNormalAndAsSmoothAsItsBlur) {
  VERIFIES("LASSO-STE-015~1");
  for (const double blur_px : {2.5, 80.0}) {
    for (const double blurs : {0.0, 1.5, 6.0}) {
      const FieldMoments moments = moments_of(blurs * blur_px, blur_px);
      EXPECT_NEAR(moments.mean, 0, 0.06);
      EXPECT_NEAR(moments.variance, 1, 0.08);
      EXPECT_NEAR(moments.product, std::exp(-blurs * blurs / 4), 0.07) << blurs;
    }
  }
}

TEST(ErrorField, IsTheSameForOneSeedAndAnotherForAnother) {
  VERIFIES("LASSO-STE-015~1");
  EXPECT_EQ(error_field(5, 3.25, -8, 2.5), error_field(5, 3.25, -8, 2.5));
  EXPECT_NE(error_field(5, 3.25, -8, 2.5), error_field(6, 3.25, -8, 2.5));
}

TEST(ErrorField, SharesOfTheNormalDistribution) {
  VERIFIES("LASSO-STE-015~1");
  for (const double x : {-4.0, -1.3, -0.2, 0.0, 0.4, 2.2, 5.0}) EXPECT_NEAR(normal_share(x), 0.5 * std::erfc(-x / std::sqrt(2.0)), 1e-6);
}

}  // namespace
}  // namespace lasso::mdat
