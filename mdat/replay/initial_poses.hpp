// Tables of poses: those that replay starts from, and those that are true. Columns `scan,qx,qy,qz,qw,x_m,y_m,z_m`, in any order and among
// others, one row a scan, T_sensor_target. What mdat writes of poses is such a table.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "fsw/geometry/se3.hpp"
#include "hal_sim/csv_table.hpp"

namespace lasso::mdat {

constexpr double kQuaternionLengthTolerance = 1e-3;

// Where a table has what a pose needs.
class PoseColumns {
 public:
  // Throws ScanFileError where one is missing.
  explicit PoseColumns(const sim::CsvTable& table);

  // Of the present row, normalised. Throws ScanFileError or InputError with file:line:column: not a number, NaN or infinity, a quaternion
  // whose length differs from 1 by more than the tolerance.
  Pose read(const sim::CsvTable& table) const;
  // The stem of the scan's file, which a row names by it or as a file. Throws InputError where none stands there.
  std::string scan(const sim::CsvTable& table) const;
  std::string scan_place(const sim::CsvTable& table) const { return table.place(scan_); }

 private:
  std::size_t scan_;
  std::array<std::size_t, 7> values_;  // qx, qy, qz, qw, x, y, z
};

struct InitialPose {
  std::string scan;  // the stem of the scan's file
  Pose T_sensor_target;
  bool valid = true;  // as its row says, where the table has a column `valid` or `outcome`
};

// Reads the file whole (hal_sim/csv_table.hpp). Throws InputError or ScanFileError with file:line:column: wrong header, ragged row, not a
// number, NaN or infinity, an empty or double name, a quaternion whose length differs from 1 by more than the tolerance (the returned one
// is normalised), no row.
std::vector<InitialPose> read_initial_poses(const std::filesystem::path& file);

// The pose of a scan, null where there is none.
const InitialPose* find_pose(const std::vector<InitialPose>& poses, const std::string& scan);

// The same; throws InputError that names both files.
const Pose& pose_of(const std::vector<InitialPose>& poses, const std::string& scan, const std::filesystem::path& file);

// Of a pose whose (qw, qx, qy, qz) stood where (qx, qy, qz, qw) is expected.
inline Pose scalar_first(const Pose& pose) { return {Quat(pose.q.x(), pose.q.y(), pose.q.z(), pose.q.w()), pose.p}; }

}  // namespace lasso::mdat
