#include "mdat/replay/pose_errors.hpp"

#include <cmath>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

struct Spread {
  double sum2 = 0, largest = -1;
  std::string worst;
  std::size_t count = 0;
  void add(double value, const std::string& scan) {
    sum2 += value * value;
    ++count;
    if (value <= largest) return;
    largest = value;
    worst = scan;
  }
  double rms() const { return std::sqrt(sum2 / static_cast<double>(count)); }
};

}  // namespace

KnownError error_of(const std::vector<InitialPose>& truth, const std::string& scan, const Pose& T_sensor_target) {
  const InitialPose* const true_pose = find_pose(truth, scan);
  if (true_pose == nullptr) return std::nullopt;
  const Vec6 difference = pose_difference(T_sensor_target, true_pose->T_sensor_target);
  return TruthError{difference.tail<3>().norm(), difference.head<3>().norm()};
}

std::string error_summary(const std::vector<JudgedScan>& scans) {
  Spread translation, rotation;
  for (const JudgedScan& scan : scans) {
    if (!scan.error) continue;
    translation.add(1e3 * scan.error->translation_m, scan.scan);
    rotation.add(scan.error->rotation_rad / kRadPerDeg, scan.scan);
  }
  if (translation.count == 0) return "";
  return format("errors of %zu %s: translation rms %.4g mm, largest %.4g mm (%s)\n", translation.count,
                translation.count == 1 ? "pose" : "poses", translation.rms(), translation.largest, translation.worst.c_str()) +
         format("                    rotation rms %.4g deg, largest %.4g deg (%s)\n", rotation.rms(), rotation.largest,
                rotation.worst.c_str());
}

std::string error_fields(const KnownError& error) {
  return error ? format(",%.6g,%.6g", error->translation_m, error->rotation_rad / kRadPerDeg) : ",,";
}

}  // namespace lasso::mdat
