#include "mdat/replay/initial_poses.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "hal_sim/scan_file.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"

namespace lasso::mdat {
namespace {

constexpr char kHeader[] = "scan,qx,qy,qz,qw,x_m,y_m,z_m";

Quat attitude(const std::array<double, 7>& values, const std::string& place) {
  const Quat q(values[3], values[0], values[1], values[2]);
  const double length = q.norm();
  if (std::fabs(length - 1) > kQuaternionLengthTolerance) {
    throw InputError(place + ": qx,qy,qz,qw: length " + std::to_string(length) + ", expected a quaternion of unit length");
  }
  return normalized(q);
}

// What a table says besides of its poses.
struct Words {
  std::optional<std::size_t> valid, outcome;

  explicit Words(const sim::CsvTable& table) : valid(table.find({"valid"})), outcome(table.find({"outcome"})) {}
  bool say_valid(const sim::CsvTable& table) const {
    return !(valid && !table.yes_or_no(*valid)) && !(outcome && table.field(*outcome) != "accepted");
  }
};

}  // namespace

PoseColumns::PoseColumns(const sim::CsvTable& table)
    : scan_(table.need({"scan"})), values_{table.need({"qx"}),       table.need({"qy"}),       table.need({"qz"}),      table.need({"qw"}),
                                           table.need({"x_m", "x"}), table.need({"y_m", "y"}), table.need({"z_m", "z"})} {}

Pose PoseColumns::read(const sim::CsvTable& table) const {
  std::array<double, 7> values{};
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = table.number(values_[i]);
  return {attitude(values, table.place(values_[0])), Vec3(values[4], values[5], values[6])};
}

std::string PoseColumns::scan(const sim::CsvTable& table) const {
  const std::string stem = sim::scan_stem(std::string(table.field(scan_)));
  if (stem.empty()) throw InputError(scan_place(table) + ": scan: empty, expected the stem of a scan's file");
  return stem;
}

std::vector<InitialPose> read_initial_poses(const std::filesystem::path& file) {
  const std::string text = file_content(file);
  sim::CsvTable table(file.string(), text, kHeader);
  const PoseColumns columns(table);
  const Words words(table);
  std::vector<InitialPose> poses;
  std::set<std::string> named;
  while (table.next()) {
    const std::string scan = columns.scan(table);
    poses.push_back({scan, columns.read(table), words.say_valid(table)});
    if (named.insert(poses.back().scan).second) continue;
    throw InputError(columns.scan_place(table) + ": scan: '" + poses.back().scan + "' has a row already");
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
