#include "mdat/missiondb/stereo_pair_file.hpp"

#include "fsw/geometry/so3.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

StereoPair generic_pair() {
  StereoPair pair;
  pair.left = {640, 480, 801.25, 802.5, 319.1, 240.7, {-0.1, 0.02, 1e-3, -2e-3, 0.3}};
  pair.right = {644, 482, 790.1, 791.9, 322.2, 238.4, {0.1, -0.02, 1e-4, 2e-4, -0.3}};
  pair.T_left_right = {exp_so3(Vec3(0.01, -0.02, 0.03)), Vec3(0.31, -0.004, 0.007)};
  pair.codes = {false, 12345, 3.5};
  return pair;
}

void expect_same(const PairCamera& a, const PairCamera& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.focal_x_px, b.focal_x_px);
  EXPECT_EQ(a.focal_y_px, b.focal_y_px);
  EXPECT_EQ(a.center_x_px, b.center_x_px);
  EXPECT_EQ(a.center_y_px, b.center_y_px);
  EXPECT_EQ(a.distortion, b.distortion);
}

TEST(StereoPairFile, WhatIsWrittenIsRead) {
  VERIFIES("LASSO-STE-007~1");
  const Folder folder;
  const StereoPair pair = generic_pair(), read = load_stereo_pair(folder.write("pair.toml", stereo_pair_text(pair)));
  expect_same(read.left, pair.left);
  expect_same(read.right, pair.right);
  EXPECT_EQ(read.T_left_right.p, pair.T_left_right.p);
  EXPECT_LT((read.T_left_right.q.coeffs() - pair.T_left_right.q.coeffs()).norm(), 1e-15);
  EXPECT_FALSE(read.codes.square_root);
  EXPECT_EQ(read.codes.full_well_e, 12345);
  EXPECT_EQ(read.codes.read_noise_e, 3.5);
}

TEST(StereoPairFile, WhatNeedNotBeSaidHasAPreset) {
  VERIFIES("LASSO-STE-007~1");
  const Folder folder;
  const std::string camera = "width = 640\nheight = 480\nfocal_px = [800, 800]\ncenter_px = [319.5, 239.5]\n";
  const StereoPair pair =
      load_stereo_pair(folder.write("p.toml", "[left]\n" + camera + "[right]\n" + camera + "position_m = [0.2, 0, 0]\n"));
  EXPECT_EQ(pair.left.distortion, (std::array<double, 5>{}));
  EXPECT_EQ(pair.T_left_right.q.w(), 1);
  EXPECT_TRUE(pair.codes.square_root);
}

TEST(StereoPairFile, RefusesWhatIsNoPair) {
  VERIFIES("LASSO-STE-007~1");
  const Folder folder;
  const auto refusal = [&](StereoPair pair) {
    return mission_error_of([&] { static_cast<void>(load_stereo_pair(folder.write("pair.toml", stereo_pair_text(pair)))); });
  };
  StereoPair left_of_it = generic_pair(), above = generic_pair(), turned = generic_pair(), small = generic_pair();
  left_of_it.T_left_right.p.x() = -0.3;
  above.T_left_right.p = Vec3(0.1, -0.3, 0);
  turned.T_left_right.q.coeffs() *= 0.9;
  small.left.width = 3;
  EXPECT_NE(refusal(left_of_it).find("exchange the pictures"), std::string::npos) << refusal(left_of_it);
  EXPECT_NE(refusal(above).find("right.position_m"), std::string::npos);
  EXPECT_NE(refusal(turned).find("right.quaternion"), std::string::npos);
  EXPECT_NE(refusal(small).find("pair.toml:7:9: left.width: 3"), std::string::npos) << refusal(small);
}

}  // namespace
}  // namespace lasso::mdat
