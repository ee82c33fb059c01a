// A box whose two halves are parts, and the state of a track that looks at them.
#pragma once

#include <gtest/gtest.h>

#include "fsw/mode/parts.hpp"
#include "ut/support/box_parts.hpp"
#include "ut/support/box_scan.hpp"

namespace lasso::test {

// The halves of the box, as an image says them.
struct Loaded {
  Loaded() {
    MissionParameters p = preset_parameters();
    p.sigma0_m = 1e-3;
    p.sigma_k_per_m = 0;
    image = make_image(p, with_parts(make_box_tables(BoxModel{}), two_halves(), p));
    EXPECT_EQ(load_image(Bytes(image.data(), image.size), mission, parts).status, Status::kOk);
  }
  TestImage image;
  Mission mission;
  Parts parts;
};

class PartsTest : public ::testing::Test {
 protected:
  static const Loaded& loaded() {
    static const Loaded halves;
    return halves;
  }
  PartsTest() : mission_(loaded().mission), parts_(loaded().parts) {
    next_.scan_id = 100;
    next_.predicted.initialised = true;
    next_.predicted.T_sensor_target = generic_box_pose();
    next_.predicted.covariance.topLeftCorner<6, 6>() = 1e-8 * Mat6::Identity();
  }

  Mission mission_;
  Parts parts_;
  PartsState state_;
  PartsReport report_;
  NextScan next_;
};

}  // namespace lasso::test
