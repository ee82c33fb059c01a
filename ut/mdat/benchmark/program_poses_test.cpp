#include "mdat/benchmark/program_poses.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "hal_sim/random.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/text.hpp"
#include "ut/mdat/benchmark/folder.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using test::error_of;
using test::PassingFolder;

constexpr char kHeader[] = "body,scan,valid,qx,qy,qz,qw,x_m,y_m,z_m,time_s\n";

Protocol two_bodies() {
  Protocol protocol;
  protocol.plan = {7, 2, 3, std::nullopt, 10};
  protocol.bodies = {{"body_7", SensorKind::kLaserCamera, {}, 1}, {"body_8", SensorKind::kLaserCamera, {}, 1}};
  return protocol;
}

ProgramPoses read(const PassingFolder& folder, const std::string& text) {
  write_file(folder / "mine.csv", text);
  return read_program_poses(folder / "mine.csv", two_bodies());
}

// A covariance that couples all six, of very different units.
Mat6 coupled_covariance(sim::Random& random) {
  Mat6 A;
  for (int i = 0; i < 36; ++i) A(i / 6, i % 6) = random.gaussian() * (i / 6 < 3 ? 1e-3 : 0.2);
  return A * A.transpose();
}

ProgramPoses random_table(sim::Random& random) {
  ProgramPoses poses{"mine", true, {}};
  for (const char* body : {"body_7", "body_8"}) {
    for (const char* scan : {"s01", "s02", "s03"}) {
      ProgramPose row{body, scan, random.uniform() < 0.7, {}, Mat6::Zero(), std::nullopt};
      if (row.valid) {
        row.T_sensor_target.q = normalized(Quat(random.gaussian(), random.gaussian(), random.gaussian(), random.gaussian()));
        row.T_sensor_target.p = Vec3(random.gaussian(), random.gaussian(), 5 + random.gaussian());
        row.covariance = coupled_covariance(random);
      }
      if (random.uniform() < 0.7) row.time_s = 0.001 * random.uniform();
      poses.rows.push_back(row);
    }
  }
  return poses;
}

TEST(ProgramPoses, ReadBackAsTheyWereWritten) {
  VERIFIES("LASSO-GND-124~1");
  const PassingFolder folder;
  sim::Random random(5);
  for (int trial = 0; trial < 50; ++trial) {
    const ProgramPoses written = random_table(random);
    const ProgramPoses back = read(folder, program_poses_csv(written));
    EXPECT_EQ(back.program, "mine");
    EXPECT_TRUE(back.covariances);
    ASSERT_EQ(back.rows.size(), written.rows.size());
    for (std::size_t i = 0; i < back.rows.size(); ++i) {
      const ProgramPose &a = back.rows[i], &b = written.rows[i];
      EXPECT_EQ(a.body + a.scan, b.body + b.scan);
      EXPECT_EQ(a.valid, b.valid);
      EXPECT_EQ(a.time_s.has_value(), b.time_s.has_value());
      EXPECT_NEAR(a.time_s.value_or(0), b.time_s.value_or(0), 1e-9);
      EXPECT_LT(pose_difference(a.T_sensor_target, b.T_sensor_target).norm(), 1e-14);
      EXPECT_EQ(a.covariance, b.covariance);
    }
  }
}

// As a program would write it that knows nothing of ours: other order and names of pairs, remarks, spaces, file names of scans.
TEST(ProgramPoses, ColumnsComeInAnyOrderAndCovariancesByTheirNames) {
  VERIFIES("LASSO-GND-122~1");
  const PassingFolder folder;
  const std::vector<std::string> axes = {"rx", "ry", "rz", "x", "y", "z"};
  std::string header = "# from elsewhere\nremark, z,y,x, qw,qz,qy,qx, scan, body", row = "none,5,0.2,0.1,0.5,-0.5,0.5,0.5, s02.csv ,body_8";
  for (int a = 5; a >= 0; --a) {
    for (int b = a; b >= 0; --b) {  // the other half of the matrix than ours
      header += ",cov_" + axes[static_cast<std::size_t>(a)] + "_" + axes[static_cast<std::size_t>(b)];
      row += format(",%g", a == b ? 10.0 + a : 0.1 * a + 0.01 * b);
    }
  }
  const ProgramPoses poses = read(folder, header + "\n" + row + "\n");
  ASSERT_EQ(poses.rows.size(), 1u);
  const ProgramPose& pose = poses.rows[0];
  EXPECT_TRUE(pose.valid);
  EXPECT_EQ(pose.body + pose.scan, "body_8s02");
  EXPECT_FALSE(pose.time_s.has_value());
  EXPECT_EQ(pose.T_sensor_target.p, Vec3(0.1, 0.2, 5));
  EXPECT_EQ(pose.T_sensor_target.q.coeffs(), Eigen::Vector4d(0.5, 0.5, -0.5, 0.5));
  for (int a = 0; a < 6; ++a) {
    for (int b = 0; b <= a; ++b) {
      EXPECT_NEAR(pose.covariance(a, b), a == b ? 10.0 + a : 0.1 * a + 0.01 * b, 1e-12);
      EXPECT_EQ(pose.covariance(a, b), pose.covariance(b, a));
    }
  }
}

TEST(ProgramPoses, OfARefusedScanNothingElseIsRead) {
  VERIFIES("LASSO-GND-122~1");
  const PassingFolder folder;
  const ProgramPoses poses = read(folder, std::string(kHeader) + "body_7,s01,0,nan,,0,3,x,,,0.5\nbody_7,s02,1,0,0,0,1,0,0,3,\n");
  ASSERT_EQ(poses.rows.size(), 2u);
  EXPECT_FALSE(poses.rows[0].valid);
  EXPECT_EQ(poses.rows[0].time_s, 0.5);
  EXPECT_TRUE(poses.rows[1].valid);
  EXPECT_FALSE(poses.covariances);
}

TEST(ProgramPoses, BadRowsAreRefusedWithFileLineAndColumn) {
  VERIFIES("LASSO-GND-123~1");
  const PassingFolder folder;
  const std::string file = (folder / "mine.csv").string(), good = "body_7,s01,1,0,0,0,1,0,0,3,0.1\n";
  const struct {
    const char *row, *place, *says;
  } cases[] = {
      {"body_9,s01,1,0,0,0,1,0,0,3,0.1", ":3:1", "the set has no 'body_9'; did you mean body_7?"},
      {"body_7,s04,1,0,0,0,1,0,0,3,0.1", ":3:8", "the set has no 's04', it has s01 to s03"},
      {"body_7,s1,1,0,0,0,1,0,0,3,0.1", ":3:8", "the set has no 's1'"},
      {"body_7,s01,1,0,0,0,1,0,0,3,0.1", ":3:8", "'s01' of body_7 has a row already"},
      {"body_7,,1,0,0,0,1,0,0,3,0.1", ":3:8", "scan: empty"},
      {"body_7,s02,2,0,0,0,1,0,0,3,0.1", ":3:12", "valid is \"2\", expected 1"},
      {"body_7,s02,1,0,0,0,0.9,0,0,3,0.1", ":3:14", "length 0.900000, expected a quaternion of unit length"},
      {"body_7,s02,1,nan,0,0,1,0,0,3,0.1", ":3:14", "qx"},
      {"body_7,s02,1,0,0,0,1,0,inf,3,0.1", ":3:24", "y_m"},
      {"body_7,s02,1,0,0,0,1,,0,3,0.1", ":3:22", "x_m"},
      {"body_7,s02,1,0,0,0,1,0,0,3,-0.1", ":3:28", "time_s: -0.1, expected seconds from 0 on"},
      {"body_7,s02,1,0,0,0,1,0,0,3", ":3", "10 fields, expected 11"},
  };
  for (const auto& c : cases) {
    const std::string said = error_of([&] { read(folder, kHeader + good + c.row + "\n"); });
    EXPECT_EQ(said.rfind(file + c.place + ": ", 0), 0u) << c.row << "\n" << said;
    EXPECT_NE(said.find(c.says), std::string::npos) << c.row << "\n" << said;
  }
}

TEST(ProgramPoses, BadTablesAreRefused) {
  VERIFIES("LASSO-GND-123~1");
  const PassingFolder folder;
  EXPECT_NE(error_of([&] { read(folder, ""); }).find("the file is empty"), std::string::npos);
  EXPECT_NE(error_of([&] { read(folder, kHeader); }).find("mine.csv:1: no row follows the header"), std::string::npos);
  EXPECT_NE(error_of([&] { read(folder, "scan,qx,qy,qz,qw,x,y,z\ns01,0,0,0,1,0,0,3\n"); }).find("mine.csv:1:1: the header is"),
            std::string::npos);
  EXPECT_NE(error_of([&] { read_program_poses(folder / "none.csv", two_bodies()); }).find("none.csv: no such file"), std::string::npos);
}

TEST(ProgramPoses, ACovarianceIsWholeAndPositiveDefinite) {
  VERIFIES("LASSO-GND-123~1");
  const PassingFolder folder;
  sim::Random random(3);
  ProgramPoses poses{"mine", true, {{"body_7", "s01", true, {}, coupled_covariance(random), std::nullopt}}};
  std::string partial = program_poses_csv(poses);
  partial.replace(partial.find("cov_rx_ry"), 9, "other_one");
  EXPECT_NE(error_of([&] { read(folder, partial); }).find("mine.csv:1: has 20 of the 21 columns of the covariance, but not cov_rx_ry"),
            std::string::npos);
  // An eigenvalue below zero, and a variance that is none.
  Eigen::SelfAdjointEigenSolver<Mat6> solved(poses.rows[0].covariance);
  Vec6 values = solved.eigenvalues();
  values[0] = -values[1];
  poses.rows[0].covariance = solved.eigenvectors() * values.asDiagonal() * solved.eigenvectors().transpose();
  EXPECT_NE(error_of([&] { read(folder, program_poses_csv(poses)); }).find("not positive definite"), std::string::npos);
  poses.rows[0].covariance = Mat6::Identity();
  poses.rows[0].covariance(4, 4) = 0;
  EXPECT_NE(error_of([&] { read(folder, program_poses_csv(poses)); }).find("mine.csv:2:"), std::string::npos);
  poses.rows[0].valid = false;
  EXPECT_FALSE(read(folder, program_poses_csv(poses)).rows[0].valid);
}

}  // namespace
}  // namespace lasso::mdat
