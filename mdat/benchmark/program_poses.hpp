// What a program found on a benchmark set: a table with a row a scan (docs/benchmark-protocol.md).
//
// Columns, in any order and among others: `body,scan,qx,qy,qz,qw,x_m,y_m,z_m`, T_sensor_target. Optional are `valid` (1 or 0; without it
// all are), `time_s` (processor time of the scan), and all 21 of the covariance, `cov_A_B` with A and B of x, y, z (of the target's origin,
// metres), rx, ry, rz (a rotation about it, radians), in sensor axes; cov_y_x is cov_x_y. Of a row that is not valid only body, scan and
// time are read.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fsw/geometry/se3.hpp"
#include "mdat/benchmark/protocol.hpp"

namespace lasso::mdat {

struct ProgramPose {
  std::string body, scan;
  bool valid = true;
  Pose T_sensor_target;
  Mat6 covariance = Mat6::Zero();  // of (rotation, translation) in sensor axes
  std::optional<double> time_s;
};

struct ProgramPoses {
  std::string program;       // the file's stem
  bool covariances = false;  // the program states them
  std::vector<ProgramPose> rows;
};

// Throws InputError or ScanFileError with file:line:column: a column missing, some of the covariance's without the others, no row, a scan
// that the set does not have or that has a row already, not a number, NaN or infinity, a quaternion not of unit length, a negative time, a
// covariance that is not positive definite.
ProgramPoses read_program_poses(const std::filesystem::path& file, const Protocol& protocol);

// The same as a table, each number with all its digits.
std::string program_poses_csv(const ProgramPoses& poses);

}  // namespace lasso::mdat
