#include "mdat/match/masks.hpp"

#include <gtest/gtest.h>

#include "hal_sim/random.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// Codes of a detector that collects so many electrons in each pixel, with read noise alone where there are none.
cv::Mat codes_of(const cv::Mat& electrons, const PairCodes& kind, std::uint64_t seed) {
  sim::Random random(seed);
  cv::Mat codes(electrons.size(), CV_8U);
  for (int row = 0; row < electrons.rows; ++row) {
    for (int column = 0; column < electrons.cols; ++column) {
      const auto mean = static_cast<double>(electrons.at<float>(row, column));
      const double e = std::max(0.0, mean + std::sqrt(mean) * random.gaussian() + kind.read_noise_e * random.gaussian());
      const double share = std::min(1.0, e / kind.full_well_e);
      codes.at<std::uint8_t>(row, column) = static_cast<std::uint8_t>(std::lround(255 * (kind.square_root ? std::sqrt(share) : share)));
    }
  }
  return codes;
}

TEST(Masks, BlackSkyIsDarkAndALitSquareIsLitButForItsRim) {
  VERIFIES("LASSO-STE-006~1");
  for (const bool square_root : {true, false}) {
    const PairCodes kind{square_root, 20000, 8};
    cv::Mat electrons(200, 300, CV_32F, cv::Scalar(0));
    electrons(cv::Range(60, 140), cv::Range(100, 200)) = 900;
    const cv::Mat lit = lit_mask(codes_of(electrons, kind, 5), kind);
    cv::Mat beyond = lit.clone();
    beyond(cv::Range(60, 140), cv::Range(100, 200)) = 0;
    EXPECT_EQ(cv::countNonZero(beyond), 0);
    EXPECT_EQ(cv::countNonZero(lit(cv::Range(66, 134), cv::Range(106, 194))), 68 * 88);
  }
}

// Rows and columns are alike: the masks of a picture on its side are its masks on their side.
TEST(Masks, ReachAsFarAlongColumnsAsAlongRows) {
  VERIFIES("LASSO-STE-006~1");
  const PairCodes kind{true, 20000, 8};
  cv::Mat electrons(120, 120, CV_32F, cv::Scalar(0));
  electrons(cv::Range(30, 70), cv::Range(20, 90)) = 900;
  electrons(cv::Range(40, 50), cv::Range(60, 75)) = 19000;
  const cv::Mat codes = codes_of(electrons, kind, 7), turned = codes.t();
  EXPECT_EQ(cv::countNonZero(lit_mask(turned, kind) != lit_mask(codes, kind).t()), 0);
  EXPECT_EQ(cv::countNonZero(glint_mask(turned, kind) != glint_mask(codes, kind).t()), 0);
  EXPECT_GT(cv::countNonZero(lit_mask(codes, kind)), 100);
  EXPECT_GT(cv::countNonZero(glint_mask(codes, kind)), 100);
}

// Beside a bright square, glare lights the sky by some hundredths of it.
TEST(Masks, SkyThatGlareLightsIsDark) {
  VERIFIES("LASSO-STE-006~1");
  const PairCodes kind;
  cv::Mat electrons(100, 200, CV_32F, cv::Scalar(400));
  electrons(cv::Range::all(), cv::Range(0, 100)) = 10000;
  const cv::Mat lit = lit_mask(codes_of(electrons, kind, 6), kind);
  EXPECT_EQ(cv::countNonZero(lit(cv::Range::all(), cv::Range(103, 106))), 0) << "the margin of the bright side";
  EXPECT_EQ(cv::countNonZero(lit(cv::Range::all(), cv::Range(0, 98))), 98 * 100);
  EXPECT_EQ(cv::countNonZero(lit(cv::Range::all(), cv::Range(120, 200))), 80 * 100) << "that is all right by itself";
}

TEST(Masks, GlintsAreAboveFourFifthsOfTheFullWell) {
  VERIFIES("LASSO-STE-006~1");
  const PairCodes kind;
  cv::Mat electrons(60, 60, CV_32F, cv::Scalar(15000));
  electrons(cv::Range(20, 40), cv::Range(20, 40)) = 17500;
  const cv::Mat glint = glint_mask(codes_of(electrons, kind, 7), kind);
  EXPECT_EQ(cv::countNonZero(glint(cv::Range(20, 40), cv::Range(20, 40))), 400) << "the square";
  EXPECT_GT(cv::countNonZero(glint), 24 * 24) << "and about it";
  EXPECT_LT(cv::countNonZero(glint), 31 * 31);
}

// A ramp of known slope: the shift of a window with this gradient and noise is known to sqrt(2) s / (5 g).
TEST(Masks, PredictedSigmaIsThatOfTheGradient) {
  VERIFIES("LASSO-STE-006~1");
  const PairCodes kind{true, 20000, 8};
  for (const double slope : {1.0, 4.0}) {
    cv::Mat codes(40, 60, CV_8U);
    for (int row = 0; row < 40; ++row) {
      for (int column = 0; column < 60; ++column)
        codes.at<std::uint8_t>(row, column) = static_cast<std::uint8_t>(10 + std::lround(slope * column));
    }
    const auto e = static_cast<double>(electrons_of(codes, kind).at<float>(20, 30));
    const double noise = std::sqrt(255 * 255 / (4 * 20000 * e) * (e + 64) + 1 / 12.0);
    const double texture = 25 * slope * slope - 25 * 12.0 / 64 * noise * noise;
    EXPECT_NEAR(static_cast<double>(predicted_sigma_px(codes, kind).at<float>(20, 30)) / (std::sqrt(2) * noise / std::sqrt(texture)), 1,
                0.05);
  }
}

// Matched by least squares along the row, shifts of noisy windows spread as predicted.
TEST(Masks, PredictedSigmaIsWhatALeastSquaresMatchReaches) {
  VERIFIES("LASSO-STE-006~1");
  const PairCodes kind{true, 20000, 8};
  cv::Mat electrons(7, 41, CV_32F);
  for (int row = 0; row < 7; ++row) {
    for (int column = 0; column < 41; ++column)
      electrons.at<float>(row, column) = static_cast<float>(4000 + 1500 * std::sin(0.6 * column + 0.1 * row));
  }
  double squares = 0, predicted = 0;
  constexpr int kPairs = 600;
  for (int i = 0; i < kPairs; ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    const cv::Mat left = codes_of(electrons, kind, 2 * seed + 1), right = codes_of(electrons, kind, 2 * seed + 2);
    predicted += static_cast<double>(predicted_sigma_px(left, kind).at<float>(3, 20)) / kPairs;
    double slope_difference = 0, slope2 = 0;
    for (int row = 1; row < 6; ++row) {
      for (int column = 18; column <= 22; ++column) {
        const auto clean = [&](int at) { return 255 * std::sqrt(static_cast<double>(electrons.at<float>(row, at)) / 20000); };
        const double slope = 0.5 * (clean(column + 1) - clean(column - 1));
        slope_difference += slope * (left.at<std::uint8_t>(row, column) - right.at<std::uint8_t>(row, column));
        slope2 += slope * slope;
      }
    }
    squares += slope_difference * slope_difference / (slope2 * slope2) / kPairs;
  }
  EXPECT_NEAR(predicted / std::sqrt(squares), 1, 0.12);
}

}  // namespace
}  // namespace lasso::mdat
