#include "mdat/replay/pose_errors.hpp"

#include <algorithm>
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

struct TruthReading {
  const char* meaning;
  Pose (*pose)(const Pose&);
};
Pose as_given(const Pose& pose) { return pose; }
Pose inverse_of(const Pose& pose) { return inverse(pose); }
Pose inverse_scalar_first(const Pose& pose) { return inverse(scalar_first(pose)); }
template <int kPerThousand>
Pose in_unit(const Pose& pose) {
  return {pose.q, 1e-3 * kPerThousand * pose.p};
}
constexpr TruthReading kReadings[] = {{"as given", as_given},
                                      {"as T_target_sensor: inverse poses", inverse_of},
                                      {"scalar first: columns of qw,qx,qy,qz", scalar_first},
                                      {"as T_target_sensor, scalar first", inverse_scalar_first},
                                      {"in millimetres", in_unit<1>},
                                      {"in centimetres", in_unit<10>},
                                      {"in kilometres", in_unit<1000000>}};

// Medians over the poses; `whole_m`, by which readings are compared, is the translation and, at the pose's range, the rotation.
struct MedianErrors {
  double translation_m = 0, rotation_rad = 0, whole_m = 0;
};

MedianErrors median_errors(const std::vector<InitialPose>& truth, const std::vector<FoundPose>& found, const TruthReading& reading) {
  std::vector<double> translation_m, rotation_rad, whole_m;
  for (const FoundPose& pose : found) {
    const InitialPose* const known = find_pose(truth, pose.scan);
    if (known == nullptr) continue;
    const Vec6 difference = pose_difference(pose.T_sensor_target, reading.pose(known->T_sensor_target));
    translation_m.push_back(difference.tail<3>().norm());
    rotation_rad.push_back(difference.head<3>().norm());
    whole_m.push_back(translation_m.back() + rotation_rad.back() * pose.T_sensor_target.p.norm());
  }
  if (whole_m.empty()) return {};
  return {median(translation_m), median(rotation_rad), median(whole_m)};
}

std::string errors_text(const MedianErrors& errors) {
  return format("%.3g m and %.3g deg", errors.translation_m, errors.rotation_rad / kRadPerDeg);
}

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<std::string> truth_notes(const std::vector<InitialPose>& truth, const std::vector<FoundPose>& found) {
  constexpr double kMuchCloser = 0.2;
  const MedianErrors given = median_errors(truth, found, kReadings[0]);
  MedianErrors best = given;
  const char* meaning = nullptr;
  for (const TruthReading& reading : kReadings) {
    const MedianErrors errors = median_errors(truth, found, reading);
    if (!(errors.whole_m < kMuchCloser * given.whole_m) || errors.whole_m >= best.whole_m) continue;
    best = errors;
    meaning = reading.meaning;
  }
  if (meaning == nullptr) return {};
  return {"warning: --truth: poses are " + errors_text(given) + " off (medians), and " + errors_text(best) + " if it is read " + meaning};
}

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
