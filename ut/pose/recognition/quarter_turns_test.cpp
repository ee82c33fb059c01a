#include "fsw/pose/recognition/quarter_turns.hpp"

#include <gtest/gtest.h>

#include "fsw/geometry/so3.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

constexpr double kRounding = 1e-12;

// Each axis on to an axis or its opposite: what a cube does.
bool is_of_a_cube(const Mat3& R) {
  bool is = (R.transpose() * R - Mat3::Identity()).norm() < kRounding && R.determinant() > 0;
  for (int i = 0; i < 9; ++i) {
    const double size = R(i / 3, i % 3) * R(i / 3, i % 3);
    is = is && (size < kRounding || (size > 1 - kRounding && size < 1 + kRounding));
  }
  return is;
}

TEST(QuarterTurns, AreAllOfACubeEachOnceAboutTheMiddle) {
  VERIFIES("LASSO-MOD-187~1");
  Pose pose;
  pose.q = exp_so3(Vec3(0.4, -1.1, 0.7));
  pose.p = Vec3(1.5, -0.6, 3.2);
  const Vec3 center(0.3, -0.2, 0.5);
  for (std::size_t i = 0; i < kQuarterTurns; ++i) {
    const Pose turned = quarter_turned(pose, i, center);
    EXPECT_TRUE(is_of_a_cube(to_matrix(turned.q) * to_matrix(pose.q).transpose())) << i;
    EXPECT_LT((inverse(turned) * center - inverse(pose) * center).norm(), kRounding) << i;
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_GT((to_matrix(turned.q) - to_matrix(quarter_turned(pose, k, center).q)).norm(), 1) << i << ", " << k;
    }
  }
  EXPECT_LT((to_matrix(quarter_turned(pose, 0, center).q) - to_matrix(pose.q)).norm(), kRounding);
}

}  // namespace
}  // namespace lasso
