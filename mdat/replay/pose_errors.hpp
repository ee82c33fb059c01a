// How far poses are from the true ones.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mdat/replay/initial_poses.hpp"

namespace lasso::mdat {

struct TruthError {
  double translation_m = 0;  // of the target's origin
  double rotation_rad = 0;
};
using KnownError = std::optional<TruthError>;  // none: the true pose is not known

KnownError error_of(const std::vector<InitialPose>& truth, const std::string& scan, const Pose& T_sensor_target);

// A scan whose pose counts: valid, or accepted.
struct JudgedScan {
  std::string scan;
  KnownError error;
};
// Root mean square and the largest, a line each for translation and rotation; empty where no error is known.
std::string error_summary(const std::vector<JudgedScan>& scans);

// 0 of none.
double median(std::vector<double> values);

struct FoundPose {
  std::string scan;
  Pose T_sensor_target;
};
// Would true poses be much closer, by less than a fifth, if they were read otherwise: inverse, scalar first, lengths in another unit? By
// the medians of the errors of the poses that count. A warning with the figures of both.
std::vector<std::string> truth_notes(const std::vector<InitialPose>& truth, const std::vector<FoundPose>& found);

// The columns `error_m,error_deg` with a comma before them.
constexpr char kErrorColumns[] = ",error_m,error_deg";
std::string error_fields(const KnownError& error);

}  // namespace lasso::mdat
