#include "mdat/replay/initial_poses.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>

#include "hal_sim/csv_table.hpp"
#include "hal_sim/scan_file.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"

namespace lasso::mdat {
namespace {

constexpr char kHeader[] = "scan,qx,qy,qz,qw,x_m,y_m,z_m";

// Where a table has what a pose needs.
struct Columns {
  std::size_t scan;
  std::array<std::size_t, 7> values;  // qx, qy, qz, qw, x, y, z
  std::optional<std::size_t> valid, outcome;

  explicit Columns(const sim::CsvTable& table)
      : scan(table.need({"scan"})),
        values{table.need({"qx"}),       table.need({"qy"}),       table.need({"qz"}),      table.need({"qw"}),
               table.need({"x_m", "x"}), table.need({"y_m", "y"}), table.need({"z_m", "z"})},
        valid(table.find({"valid"})),
        outcome(table.find({"outcome"})) {}
};

Quat attitude(const std::array<double, 7>& values, const std::string& place) {
  const Quat q(values[3], values[0], values[1], values[2]);
  const double length = q.norm();
  if (std::fabs(length - 1) > kQuaternionLengthTolerance) {
    throw InputError(place + ": qx,qy,qz,qw: length " + std::to_string(length) + ", expected a quaternion of unit length");
  }
  return normalized(q);
}

InitialPose read_row(const sim::CsvTable& table, const Columns& columns) {
  InitialPose result;
  result.scan = sim::scan_stem(std::string(table.field(columns.scan)));  // a file, or its stem
  if (result.scan.empty()) throw InputError(table.place(columns.scan) + ": scan: empty, expected the stem of a scan's file");
  std::array<double, 7> values{};
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = table.number(columns.values[i]);
  result.T_sensor_target.q = attitude(values, table.place(columns.values[0]));
  result.T_sensor_target.p = Vec3(values[4], values[5], values[6]);
  result.valid = !(columns.valid && !table.yes_or_no(*columns.valid)) && !(columns.outcome && table.field(*columns.outcome) != "accepted");
  return result;
}

}  // namespace

std::vector<InitialPose> read_initial_poses(const std::filesystem::path& file) {
  const std::string text = file_content(file);
  sim::CsvTable table(file.string(), text, kHeader);
  const Columns columns(table);
  std::vector<InitialPose> poses;
  std::set<std::string> named;
  while (table.next()) {
    poses.push_back(read_row(table, columns));
    if (named.insert(poses.back().scan).second) continue;
    throw InputError(table.place(columns.scan) + ": scan: '" + poses.back().scan + "' has a row already");
  }
  if (poses.empty()) throw InputError(table.place() + ": no row follows the header");
  return poses;
}

const InitialPose* find_pose(const std::vector<InitialPose>& poses, const std::string& scan) {
  const auto found = std::find_if(poses.begin(), poses.end(), [&](const InitialPose& pose) { return pose.scan == scan; });
  return found == poses.end() ? nullptr : &*found;
}

const Pose& pose_of(const std::vector<InitialPose>& poses, const std::string& scan, const std::filesystem::path& file) {
  const InitialPose* const found = find_pose(poses, scan);
  if (found == nullptr) throw InputError(file.string() + ": no row for the scan '" + scan + "'");
  return found->T_sensor_target;
}

}  // namespace lasso::mdat
