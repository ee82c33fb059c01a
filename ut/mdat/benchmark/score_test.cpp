#include "mdat/benchmark/score.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "fsw/geometry/so3.hpp"
#include "hal_sim/random.hpp"
#include "mdat/common/text.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

Quat random_turn(sim::Random& random) {
  const double x = random.gaussian(), y = random.gaussian(), z = random.gaussian();
  return normalized(Quat(random.gaussian(), x, y, z));
}

Vec3 random_vector(sim::Random& random, double sigma) {
  const double x = random.gaussian(), y = random.gaussian();
  return sigma * Vec3(x, y, random.gaussian());
}

// `turns` equal ones about any axis through any point.
ExactSymmetry random_symmetry(sim::Random& random, int turns) {
  ExactSymmetry symmetry;
  symmetry.center = random_vector(random, 0.3);
  const Vec3 axis = random_vector(random, 1).normalized();
  for (int i = 0; i < turns; ++i) symmetry.turns.emplace_back(Eigen::AngleAxisd(2 * kPi * i / turns, axis));
  return symmetry;
}

BenchmarkSet random_set(sim::Random& random) {
  BenchmarkSet set;
  for (int body = 0; body < 4; ++body) {
    TrueBody truth{format("body_%d", body), "plain", "", 0.5 + 2 * random.uniform(), random_symmetry(random, 1 + body), {}};
    for (int scan = 0; scan < 12; ++scan)
      truth.scans.push_back(
          {format("s%02d", scan), {random_turn(random), random_vector(random, 1) + Vec3(0, 0, 6)}, random.uniform() < 0.7});
    set.truth.push_back(truth);
  }
  return set;
}

Mat6 random_covariance(sim::Random& random) {
  const double scale = std::pow(10, random.uniform(-1, 1));
  Mat6 A;
  for (int i = 0; i < 36; ++i) A(i / 6, i % 6) = scale * random.gaussian() * (i / 6 < 3 ? 2e-3 : 5e-3);
  return A * A.transpose() + 1e-10 * Mat6::Identity();
}

// Off any of the poses that look the same, by what is near or far of the limits; refused or without a row now and then.
ProgramPoses random_poses(const BenchmarkSet& set, bool covariances, sim::Random& random) {
  ProgramPoses poses{"mine", covariances, {}};
  for (const TrueBody& body : set.truth) {
    for (const TrueScan& scan : body.scans) {
      if (random.uniform() < 0.1) continue;
      const Quat& turn = body.symmetry.turns[random.bits() % body.symmetry.turns.size()];
      const double turned_rad = 0.01 * std::pow(10, random.uniform(-1, 1)), moved_m = 0.01 * std::pow(10, random.uniform(-1, 1));
      Pose pose = scan.T_sensor_target * Pose{turn, body.symmetry.center - turn * body.symmetry.center};
      pose.q = exp_so3(random_vector(random, turned_rad)) * pose.q;
      pose.p += random_vector(random, moved_m);
      ProgramPose row{body.name, scan.scan, random.uniform() < 0.85, pose, Mat6::Zero(), 0.001 * random.uniform()};
      if (covariances) row.covariance = random_covariance(random);
      poses.rows.push_back(row);
    }
  }
  return poses;
}

// Those of a round body by steps of a hundredth of a degree.
std::vector<Quat> all_turns(const ExactSymmetry& symmetry) {
  if (!symmetry.axis) return symmetry.turns;
  std::vector<Quat> turns;
  constexpr int kSteps = 36000;
  for (int i = 0; i < kSteps; ++i) turns.emplace_back(Eigen::AngleAxisd(2 * kPi * i / kSteps, *symmetry.axis));
  return turns;
}

// The score by its definition, with matrices instead of quaternions, and a full inverse.
struct BruteForce {
  std::size_t scans = 0, determined = 0, right = 0, admitted = 0, wrong = 0, determined_wrong = 0, refused = 0, missing = 0;
  std::map<std::string, std::vector<double>> squared;  // of valid poses, by body

  void add(const TrueBody& body, const TrueScan& scan, const ProgramPose* row, bool covariances) {
    ++scans;
    determined += scan.determined ? 1U : 0U;
    missing += row == nullptr ? 1U : 0U;
    if (row == nullptr || !row->valid) {
      refused += scan.determined ? 1U : 0U;
      return;
    }
    double least_angle = 10, translation = 0, least_squared = 1e300;
    for (const Quat& turn : all_turns(body.symmetry)) {
      const Mat3 image = scan.T_sensor_target.q.toRotationMatrix() * turn.toRotationMatrix();
      const Vec3 origin =
          scan.T_sensor_target.q.toRotationMatrix() * (body.symmetry.center - turn.toRotationMatrix() * body.symmetry.center) +
          scan.T_sensor_target.p;
      const Eigen::AngleAxisd between(row->T_sensor_target.q.toRotationMatrix() * image.transpose());
      Vec6 error;
      error << between.angle() * between.axis(), row->T_sensor_target.p - origin;
      if (covariances) least_squared = std::min(least_squared, double{error.transpose() * row->covariance.fullPivLu().inverse() * error});
      if (between.angle() >= least_angle) continue;
      least_angle = between.angle();
      translation = error.tail<3>().norm();
    }
    const bool near = least_angle <= kPi / 180 && translation <= 0.015 * body.size_m;
    const bool is_wrong = !near && (!covariances || least_squared > 25);
    squared[body.name].push_back(least_squared);
    wrong += is_wrong ? 1U : 0U;
    if (!scan.determined) return;
    right += near ? 1U : 0U;
    determined_wrong += is_wrong ? 1U : 0U;
    admitted += !near && !is_wrong ? 1U : 0U;
  }
};

BruteForce brute_force(const BenchmarkSet& set, const ProgramPoses& poses) {
  BruteForce result;
  for (const TrueBody& body : set.truth) {
    for (const TrueScan& scan : body.scans) {
      const auto row = std::find_if(poses.rows.begin(), poses.rows.end(),
                                    [&](const ProgramPose& pose) { return pose.body == body.name && pose.scan == scan.scan; });
      result.add(body, scan, row == poses.rows.end() ? nullptr : &*row, poses.covariances);
    }
  }
  return result;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

TEST(Score, CountsAsBruteForceDoes) {
  VERIFIES("LASSO-GND-122~1");
  sim::Random random(20);
  std::size_t right = 0, wrong = 0, admitted = 0, refused = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const BenchmarkSet set = random_set(random);
    const bool covariances = trial % 2 == 0;
    const ProgramPoses poses = random_poses(set, covariances, random);
    const Score found = score(set, poses);
    const BruteForce expected = brute_force(set, poses);
    EXPECT_EQ(found.counts.scans, expected.scans);
    EXPECT_EQ(found.counts.determined, expected.determined);
    EXPECT_EQ(found.counts.right, expected.right);
    EXPECT_EQ(found.counts.wrong, expected.wrong);
    EXPECT_EQ(found.counts.determined_wrong, expected.determined_wrong);
    EXPECT_EQ(found.counts.admitted, expected.admitted);
    EXPECT_EQ(found.counts.refused, expected.refused);
    EXPECT_EQ(found.missing, expected.missing);
    EXPECT_EQ(found.timed, poses.rows.size());
    for (const BodyScore& body : found.bodies) {
      const auto squared = expected.squared.find(body.name);
      if (covariances && squared != expected.squared.end())
        EXPECT_NEAR(body.nees, mean(squared->second), 1e-6 * body.nees);
      else
        EXPECT_TRUE(std::isnan(body.nees));
    }
    right += expected.right;
    wrong += expected.wrong;
    admitted += expected.admitted;
    refused += expected.refused;
  }
  for (const std::size_t count : {right, wrong, admitted, refused}) EXPECT_GT(count, 50u) << "each kind is met often";
}

TEST(Score, OfARoundBodyEachTurnAboutItsAxisIsTried) {
  VERIFIES("LASSO-GND-122~1");
  sim::Random random(21);
  BenchmarkSet set = random_set(random);
  TrueBody round = set.truth.at(0);
  round.symmetry.axis = random_vector(random, 1).normalized();
  round.symmetry.turns = all_turns(round.symmetry);  // from which the poses are drawn
  set.truth = {round};
  const ProgramPoses poses = random_poses(set, true, random);
  set.truth[0].symmetry.turns = {Quat::Identity()};
  const Score found = score(set, poses);
  const BruteForce expected = brute_force(set, poses);
  EXPECT_EQ(found.counts.right, expected.right);
  EXPECT_EQ(found.counts.wrong, expected.wrong);
  EXPECT_EQ(found.counts.refused, expected.refused);
  EXPECT_GT(found.counts.right, 0u);
  EXPECT_GT(found.counts.wrong, 0u);
  EXPECT_NEAR(found.bodies[0].nees, mean(expected.squared.at("body_0")), 0.01 * found.bodies[0].nees);
}

TEST(Score, ThoseDeterminedAddUp) {
  VERIFIES("LASSO-GND-122~1");
  sim::Random random(4);
  for (int trial = 0; trial < 10; ++trial) {
    const BenchmarkSet set = random_set(random);
    const Score found = score(set, random_poses(set, true, random));
    ScoreCounts sum;
    for (const BodyScore& body : found.bodies) {
      const ScoreCounts& c = body.counts;
      EXPECT_EQ(c.right + c.admitted + c.determined_wrong + c.refused, c.determined);
      sum.scans += c.scans;
      sum.wrong += c.wrong;
      sum.right += c.right;
    }
    EXPECT_EQ(sum.scans, found.counts.scans);
    EXPECT_EQ(sum.wrong, found.counts.wrong);
    EXPECT_EQ(sum.right, found.counts.right);
    EXPECT_EQ(found.scans.size(), found.counts.scans);
  }
}

// Errors drawn from the covariance that is stated have a NEES of 6; of sigmas stated half as large, 24.
TEST(Score, NeesOfAnHonestProgramIsSix) {
  VERIFIES("LASSO-GND-122~1");
  sim::Random random(8);
  BenchmarkSet set;
  set.truth.push_back({"body_0", "plain", "", 100, random_symmetry(random, 1), {}});
  ProgramPoses honest{"honest", true, {}}, bold{"bold", true, {}};
  for (int i = 0; i < 2000; ++i) {
    const TrueScan scan{format("s%04d", i), {random_turn(random), random_vector(random, 1)}, true};
    set.truth[0].scans.push_back(scan);
    const Mat6 covariance = random_covariance(random);
    Vec6 unit;
    for (int k = 0; k < 6; ++k) unit[k] = random.gaussian();
    const Vec6 error = covariance.llt().matrixL() * unit;
    const Pose pose{exp_so3(error.head<3>()) * scan.T_sensor_target.q, scan.T_sensor_target.p + error.tail<3>()};
    honest.rows.push_back({"body_0", scan.scan, true, pose, covariance, std::nullopt});
    bold.rows.push_back({"body_0", scan.scan, true, pose, 0.25 * covariance, std::nullopt});
  }
  EXPECT_NEAR(score(set, honest).nees_median, 6, 0.35);  // five sigmas of a mean of 2000
  EXPECT_NEAR(score(set, bold).nees_median, 4 * score(set, honest).nees_median, 1e-6);
  EXPECT_EQ(score(set, honest).timed, 0u);
}

TEST(Score, TheWorstBodyHasMostWrongPosesThenFewestRightOnes) {
  VERIFIES("LASSO-GND-122~1");
  BenchmarkSet set;
  ProgramPoses poses{"mine", false, {}};
  const Pose truth{Quat::Identity(), Vec3(0, 0, 5)}, off{Quat::Identity(), Vec3(0, 0.2, 5)};
  for (const char* body : {"body_0", "body_1", "body_2"}) {
    TrueBody of{body, "plain", "", 1, {}, {{"s01", truth, true}, {"s02", truth, true}}};
    of.symmetry.turns = {Quat::Identity()};
    set.truth.push_back(of);
    for (const char* scan : {"s01", "s02"}) poses.rows.push_back({body, scan, true, truth, Mat6::Zero(), std::nullopt});
  }
  poses.rows[3].valid = false;
  EXPECT_EQ(score(set, poses).worst_body, 1u);
  poses.rows[4].T_sensor_target = off;
  const Score found = score(set, poses);
  EXPECT_EQ(found.worst_body, 2u);
  EXPECT_EQ(found.counts.wrong, 1u);
  EXPECT_STREQ(to_string(found.scans[3].verdict), "refused");
  EXPECT_STREQ(to_string(found.scans[4].verdict), "wrong");
  EXPECT_STREQ(to_string(found.scans[5].verdict), "right");
  EXPECT_TRUE(std::isnan(found.scans[4].error.squared));
  EXPECT_NEAR(found.scans[4].error.translation_m, 0.2, 1e-12);
}

}  // namespace
}  // namespace lasso::mdat
