#include "fsw/mode/starts.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "ut/support/box_scene.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

constexpr TimeUs kNow = 50'000'000;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class StartsTest : public ::testing::Test {
 protected:
  StartsTest() {
    mission_.parameters = test::box_parameters(scene_);
    mission_.center_m = scene_.box.center;
    mission_.radius_m = scene_.box.center.norm() + scene_.box.half.norm();
    offer_ = rough_offer(mission_.parameters, scene_.pose_at(2000000), scene_.rates, kNow - 3000000);
  }
  StartRefusal try_offer() {
    const FilterState before = filter_;
    const StartRefusal refusal = start_from(mission_, offer_, kNow, bearing_, filter_);
    if (refusal != StartRefusal::kNone) {
      EXPECT_EQ(filter_.initialised, before.initialised) << "as it was";
      EXPECT_EQ(filter_.t_us, before.t_us);
    }
    return refusal;
  }
  test::BoxScene scene_ = test::default_scene();
  Mission mission_;
  StartOffer offer_;
  BearingState bearing_;
  FilterState filter_;
};

TEST_F(StartsTest, AnOfferIsMovedToNow) {
  VERIFIES("LASSO-MOD-132~1");
  ASSERT_EQ(try_offer(), StartRefusal::kNone);
  EXPECT_TRUE(filter_.initialised);
  EXPECT_EQ(filter_.t_us, kNow);
  EXPECT_LT(pose_difference(filter_.T_sensor_target, scene_.pose_at(5000000)).norm(), 1e-9);
  const double sigma_m = mission_.parameters.start_sigma_m;
  const double moved = 9 * mission_.parameters.initial_rate_mps * mission_.parameters.initial_rate_mps;
  EXPECT_GT(filter_.covariance(5, 5), sigma_m * sigma_m + 0.99 * moved) << "and is less certain there";
  EXPECT_DOUBLE_EQ(offer_.covariance(0, 0), mission_.parameters.start_sigma_rad * mission_.parameters.start_sigma_rad);
}

TEST_F(StartsTest, WhatIsNotANumberIsRefused) {
  VERIFIES("LASSO-MOD-134~3 LASSO-MOD-008~2");
  const StartOffer good = offer_;
  offer_.T_sensor_target.q.x() = kNan;
  EXPECT_EQ(try_offer(), StartRefusal::kNotFinite);
  offer_ = good;
  offer_.T_sensor_target.p.z() = kNan;
  EXPECT_EQ(try_offer(), StartRefusal::kNotFinite);
  offer_ = good;
  offer_.rates.omega_radps.y() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(try_offer(), StartRefusal::kNotFinite);
  offer_ = good;
  offer_.rates.v_mps.y() = kNan;
  EXPECT_EQ(try_offer(), StartRefusal::kNotFinite);
  offer_ = good;
  offer_.covariance(3, 4) = kNan;
  EXPECT_EQ(try_offer(), StartRefusal::kNotFinite);
}

TEST_F(StartsTest, WhatCannotBeIsRefusedByItsName) {
  VERIFIES("LASSO-MOD-134~3 LASSO-MOD-182~2 LASSO-MOD-008~2 LASSO-MOD-006~2 LASSO-REG-019~1");
  const StartOffer good = offer_;
  offer_.T_sensor_target.q.w() += 0.1;
  EXPECT_EQ(try_offer(), StartRefusal::kNotUnit);
  for (const double off : {-1.1e-6, -0.9e-6, 0.9e-6, 1.1e-6}) {
    offer_ = good;
    offer_.T_sensor_target.q.coeffs() *= 1 + off;
    EXPECT_EQ(try_offer(), std::abs(off) < 1e-6 ? StartRefusal::kNone : StartRefusal::kNotUnit) << off;
  }
  offer_ = good;
  offer_.covariance(2, 2) = 0;
  EXPECT_EQ(try_offer(), StartRefusal::kBadCovariance);
  offer_ = good;
  offer_.covariance(2, 3) = 1e-3;
  EXPECT_EQ(try_offer(), StartRefusal::kBadCovariance);
  offer_ = good;
  offer_.covariance(1, 1) = 3.19 * 3.19;
  EXPECT_EQ(try_offer(), StartRefusal::kNone);
  offer_.covariance(1, 1) = 3.21 * 3.21;
  EXPECT_EQ(try_offer(), StartRefusal::kBadCovariance) << "any attitude";
  offer_ = good;
  offer_.covariance(4, 4) = 99 * mission_.parameters.range_max_m * mission_.parameters.range_max_m;
  EXPECT_EQ(try_offer(), StartRefusal::kNone);
  offer_.covariance(4, 4) = 101 * mission_.parameters.range_max_m * mission_.parameters.range_max_m;
  EXPECT_EQ(try_offer(), StartRefusal::kBadCovariance) << "any place";
  offer_ = good;
  offer_.t_us = kNow + 1;
  EXPECT_EQ(try_offer(), StartRefusal::kFromFuture);
  offer_.t_us = kNow;
  EXPECT_EQ(try_offer(), StartRefusal::kNone);
  mission_.parameters.start_age_max_s = 4;
  offer_.t_us = kNow - 4000000;
  EXPECT_EQ(try_offer(), StartRefusal::kNone);
  --offer_.t_us;
  EXPECT_EQ(try_offer(), StartRefusal::kTooOld);
  offer_ = good;
  offer_.rates.omega_radps.y() = 1e7;  // more turns in 3 s than an angle can count
  EXPECT_EQ(try_offer(), StartRefusal::kTooFast);
  offer_ = good;
  offer_.rates.omega_radps.y() = 0.98 / (0.5 * mission_.parameters.duration_s);  // a radian in half a scan
  EXPECT_EQ(try_offer(), StartRefusal::kNone);
  offer_.rates.omega_radps.y() = 1.02 / (0.5 * mission_.parameters.duration_s);
  EXPECT_EQ(try_offer(), StartRefusal::kTooFast);
}

TEST_F(StartsTest, WhatTheSensorCannotSeeIsRefused) {
  VERIFIES("LASSO-MOD-134~3");
  offer_.rates = Twist{};
  mission_.parameters.range_min_m = 1;
  for (const double z_m : {-2.5, 21.0, 0.2}) {
    offer_.T_sensor_target.p = Vec3(0, 0, z_m);
    EXPECT_EQ(try_offer(), StartRefusal::kOutOfReach) << z_m;
  }
  offer_.T_sensor_target.p.z() = 20.2;  // a part of it is within 20 m
  EXPECT_EQ(try_offer(), StartRefusal::kNone);
}

TEST_F(StartsTest, WhatAnotherSensorReachesIsTaken) {
  VERIFIES("LASSO-MOD-134~3 LASSO-SNS-041~1");
  offer_.rates = Twist{};
  SensorParameters far = mission_.parameters;
  far.range_min_m = 30;
  far.range_max_m = 100;
  ASSERT_TRUE(mission_.sensors.push_back(far));
  for (const double z_m : {2.5, 60.0, 100.2}) {
    offer_.T_sensor_target.p = Vec3(0, 0, z_m);
    EXPECT_EQ(try_offer(), StartRefusal::kNone) << z_m;
  }
  for (const double z_m : {25.0, 101.0, -60.0}) {
    offer_.T_sensor_target.p = Vec3(0, 0, z_m);
    EXPECT_EQ(try_offer(), StartRefusal::kOutOfReach) << z_m;
  }
}

TEST_F(StartsTest, WhatIsNotAtTheBearingIsRefused) {
  VERIFIES("LASSO-MOD-134~3");
  offer_.t_us = kNow;
  bearing_.started = true;
  bearing_.t_us = kNow - 1000000;
  bearing_.v_mps = Vec3(0, 0, -0.5);
  bearing_.covariance = 1e-4 * Mat6::Identity();
  const Vec3 center = offer_.T_sensor_target * scene_.box.center;
  mission_.parameters.bearing_rate_mps = 0.01;
  bearing_.p_m = center + Vec3(0, 0, 0.5);  // and moving here
  EXPECT_EQ(try_offer(), StartRefusal::kNone);
  bearing_.p_m = center + Vec3(0, 3, 0.5);
  EXPECT_EQ(try_offer(), StartRefusal::kNotAtBearing);
  mission_.parameters.bearing_rate_mps = 5;  // who knows where it is after a second
  EXPECT_EQ(try_offer(), StartRefusal::kNone);
  mission_.parameters.bearing_rate_mps = 0.01;
  bearing_.t_us = kNow - 6000000;  // older than bearing.memory_s
  EXPECT_EQ(try_offer(), StartRefusal::kNone);
  bearing_.t_us = kNow;
  bearing_.started = false;
  EXPECT_EQ(try_offer(), StartRefusal::kNone);
}

TEST_F(StartsTest, TheSourcesFollowTheMissionsOrder) {
  VERIFIES("LASSO-MOD-131~1 LASSO-MOD-133~4");
  InitialPoseSources sources;
  MissionParameters& p = mission_.parameters;
  EXPECT_EQ(sources.next(p, false), InitialPoseSource::kNone);
  sources.put(InitialPoseSource::kApriori, offer_);
  sources.put(InitialPoseSource::kNavigation, offer_);
  offer_.t_us = 77;
  sources.put(InitialPoseSource::kNavigation, offer_);  // the last one counts
  EXPECT_EQ(sources.next(p, false), InitialPoseSource::kNavigation);
  EXPECT_EQ(sources.take(InitialPoseSource::kNavigation).t_us, 77);
  EXPECT_EQ(sources.next(p, false), InitialPoseSource::kApriori);
  sources.put(InitialPoseSource::kHandover, offer_);
  EXPECT_EQ(sources.next(p, false), InitialPoseSource::kHandover);
  p.start_first = static_cast<double>(InitialPoseSource::kApriori);
  EXPECT_EQ(sources.next(p, false), InitialPoseSource::kApriori);
  p.start_first = p.start_second = p.start_third = p.start_fourth = static_cast<double>(InitialPoseSource::kNone);
  EXPECT_EQ(sources.next(p, true), InitialPoseSource::kNone);
  EXPECT_DEATH(sources.put(static_cast<InitialPoseSource>(kInitialPoseSources), offer_), "no such source");
}

TEST_F(StartsTest, SearchHasItsTurnWhereItIsPossibleAndAgainWhenAllElseIsTried) {
  VERIFIES("LASSO-MOD-131~1 LASSO-MOD-133~4");
  InitialPoseSources sources;
  MissionParameters& p = mission_.parameters;
  p.start_first = static_cast<double>(InitialPoseSource::kSearch);
  p.start_second = static_cast<double>(InitialPoseSource::kApriori);
  sources.put(InitialPoseSource::kApriori, offer_);
  EXPECT_EQ(sources.next(p, false), InitialPoseSource::kApriori);
  EXPECT_EQ(sources.next(p, true), InitialPoseSource::kSearch);
  (void)sources.take(InitialPoseSource::kSearch);
  EXPECT_EQ(sources.next(p, true), InitialPoseSource::kApriori) << "the others first";
  (void)sources.take(InitialPoseSource::kApriori);
  EXPECT_EQ(sources.next(p, true), InitialPoseSource::kSearch) << "again";
  EXPECT_EQ(sources.next(p, false), InitialPoseSource::kNone);
}

TEST_F(StartsTest, TheOrderNamesItsSources) {
  VERIFIES("LASSO-MOD-133~4");
  MissionParameters& p = mission_.parameters;
  p.start_first = static_cast<double>(InitialPoseSource::kSearch);
  p.start_fifth = static_cast<double>(InitialPoseSource::kUplink);
  EXPECT_TRUE(is_in_order(p, InitialPoseSource::kSearch));
  EXPECT_TRUE(is_in_order(p, InitialPoseSource::kUplink));
  p.start_first = static_cast<double>(InitialPoseSource::kNone);
  EXPECT_FALSE(is_in_order(p, InitialPoseSource::kSearch));
}

TEST(StartNames, AreThoseOfTheCode) {
  VERIFIES("LASSO-MOD-134~3");
  EXPECT_EQ(std::string(to_string(InitialPoseSource::kUplink)), "uplink");
  EXPECT_EQ(std::string(to_string(InitialPoseSource::kSearch)), "search");
  EXPECT_EQ(std::string(to_string(static_cast<InitialPoseSource>(6))), "unknown");
  EXPECT_EQ(std::string(to_string(StartRefusal::kNone)), "none");
  EXPECT_EQ(std::string(to_string(StartRefusal::kNotConfirmed)), "not_confirmed");
  EXPECT_EQ(std::string(to_string(StartRefusal::kContradicted)), "contradicted");
  EXPECT_EQ(std::string(to_string(StartRefusal::kNotFromHere)), "not_from_here");
  EXPECT_EQ(std::string(to_string(static_cast<StartRefusal>(14))), "unknown");
}

}  // namespace
}  // namespace lasso
