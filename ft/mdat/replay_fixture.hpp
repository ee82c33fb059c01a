// Scans of the tenth-scale Hubble at 4 m that the simulator wrote, with their true poses and those to start from, and tables of them.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <memory>

#include "ft/mdat/command.hpp"

namespace lasso::ft {

inline constexpr char kReplayHeader[] =
    "scan,qx,qy,qz,qw,x_m,y_m,z_m,t_s,valid,reason,iterations,inliers,rms_m,sigma_x_m,sigma_y_m,sigma_z_m,sigma_rx_rad,sigma_ry_rad,"
    "sigma_rz_rad,estimate_us";
constexpr std::size_t kReplayed = 8;

using Row = std::map<std::string, std::string>;

// Rows of a CSV file by the names in its header; what fields_of leaves out is empty at their end.
inline std::vector<Row> table(const std::string& text) {
  const std::vector<std::string> lines = lines_of(text);
  const std::vector<std::string> names = fields_of(lines.at(0));
  std::vector<Row> rows;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> fields = fields_of(lines[i]);
    Row row;
    for (std::size_t k = 0; k < names.size(); ++k) row[names[k]] = k < fields.size() ? fields[k] : "";
    rows.push_back(row);
  }
  return rows;
}

inline double value(const Row& row, const std::string& name) { return std::stod(row.at(name)); }

inline double distance_m(const Row& a, const Row& b) {
  return std::hypot(value(a, "x_m") - value(b, "x_m"), value(a, "y_m") - value(b, "y_m"), value(a, "z_m") - value(b, "z_m"));
}

// Angle between two attitudes.
inline double angle_rad(const Row& a, const Row& b) {
  double dot = 0;
  for (const char* name : {"qx", "qy", "qz", "qw"}) dot += value(a, name) * value(b, name);
  return 2 * std::acos(std::min(1.0, std::fabs(dot)));
}

class ReplayTest : public ::testing::Test {
 protected:
  // Recorded once, and copied for each test.
  static void SetUpTestSuite() {
    original = std::make_unique<WorkFolder>();
    original->record_scans("run missions/test.toml --scenario dropouts --frames 8", "rec/4m");
    const Answer compiled = original->mdat("mission compile missions/test.toml --scenario dropouts -o image.3dli");
    ASSERT_EQ(compiled.exit_code, 0) << compiled.err;
  }
  static void TearDownTestSuite() { original.reset(); }

  void SetUp() override {
    std::filesystem::copy(*original / "rec", work / "rec", std::filesystem::copy_options::recursive);
    std::filesystem::copy(*original / "image.3dli", work / "image.3dli");
  }

  std::vector<Row> replay(const std::string& mission, const std::string& scans, const std::string& options) const {
    const Answer answer =
        work.mdat("replay " + mission + " --scans " + scans + " --initial rec/4m/poses.csv --force --out out.csv " + options);
    EXPECT_EQ(answer.exit_code, 0) << answer.err;
    const std::string text = work.read("out.csv");
    EXPECT_EQ(lines_of(text).at(0), kReplayHeader);
    return table(text);
  }

  void expect_near_truth(const std::vector<Row>& rows, double limit_m, double limit_rad) const {
    const std::vector<Row> truth = table(work.read("rec/4m/truth.csv"));
    ASSERT_EQ(rows.size(), kReplayed);
    ASSERT_EQ(truth.size(), kReplayed);
    for (std::size_t i = 0; i < kReplayed; ++i) {
      EXPECT_EQ(rows[i].at("scan"), truth[i].at("scan"));
      EXPECT_EQ(rows[i].at("valid"), "1") << rows[i].at("reason");
      EXPECT_LT(distance_m(rows[i], truth[i]), limit_m);
      EXPECT_LT(angle_rad(rows[i], truth[i]), limit_rad);
      const double sigma_m = std::hypot(value(rows[i], "sigma_x_m"), value(rows[i], "sigma_y_m"), value(rows[i], "sigma_z_m"));
      EXPECT_LT(distance_m(rows[i], truth[i]), 6 * sigma_m) << "the covariance is honest";
      EXPECT_GT(value(rows[i], "inliers"), 300);
      EXPECT_NEAR(value(rows[i], "rms_m"), 16.0 / 9000, 0.3 * 16.0 / 9000) << "the noise of the camera at 4 m";
      EXPECT_GT(value(rows[i], "estimate_us"), 10);
    }
  }
  WorkFolder work;
  static inline std::unique_ptr<WorkFolder> original;
};

}  // namespace lasso::ft
