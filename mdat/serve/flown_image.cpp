#include "mdat/serve/flown_image.hpp"

#include <algorithm>
#include <cmath>

#include "fsw/geometry/symmetric6.hpp"
#include "fsw/link/choices.hpp"
#include "fsw/pose/registration/integrity.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/text.hpp"
#include "mdat/recording/recording_head.hpp"

namespace lasso::mdat::serve {
namespace {

struct GateRow {
  const char* name;
  const char* unit;
  bool at_least;
  PoseReason reason;  // that names it
  double (*value)(const PoseTelemetry&);
  double (*limit)(const PoseTelemetry&, const MissionParameters&);
};

double inliers_min(const PoseTelemetry& /*told*/, const MissionParameters& p) { return p.inliers_min; }
double is_converged(const PoseTelemetry& told) { return static_cast<StopReason>(told.stop) == StopReason::kConverged ? 1 : 0; }
double most_residual(const PoseTelemetry& told, const MissionParameters& p) {
  return std::sqrt(most_noise(p, std::max<std::uint32_t>(told.inliers, static_cast<std::uint32_t>(p.inliers_min)), 0));
}

// In the order of judge().
constexpr GateRow kGates[] = {
    {"returns", "1", true, PoseReason::kTooFewReturns, [](const PoseTelemetry& told) { return double{1} * told.returns; }, inliers_min},
    {"inliers", "1", true, PoseReason::kTooFewInliers, [](const PoseTelemetry& told) { return double{1} * told.inliers; }, inliers_min},
    {"converged", "1", true, PoseReason::kNotConverged, is_converged, [](const PoseTelemetry&, const MissionParameters&) { return 1.0; }},
    {"inlier share", "1", true, PoseReason::kLowInlierShare,
     [](const PoseTelemetry& told) { return static_cast<double>(told.inlier_share); },
     [](const PoseTelemetry&, const MissionParameters& p) { return p.inlier_share_min; }},
    {"agreement of the rays", "1", true, PoseReason::kModelMismatch,
     [](const PoseTelemetry& told) { return static_cast<double>(told.agreement); },
     [](const PoseTelemetry&, const MissionParameters& p) { return p.agreement_min; }},
    {"normalised residual", "1", false, PoseReason::kHighResidual,
     [](const PoseTelemetry& told) { return static_cast<double>(told.normalized_residual); }, most_residual}};

ValidityGate gate_of(const GateRow& row, const PoseTelemetry& told, const MissionParameters& parameters, bool reached) {
  ValidityGate gate{row.name, row.unit, row.value(told), row.limit(told, parameters), row.at_least, false};
  const auto reason = static_cast<PoseReason>(told.reason);
  const bool within = row.at_least ? gate.value >= gate.limit : gate.value <= gate.limit;
  const bool excused = row.reason == PoseReason::kHighResidual && reached;  // by the target's unknown motion
  gate.pass = reason != row.reason && (within || excused);
  return gate;
}

template <std::size_t kCount>
const Choice* choice_at(const Choice (&choices)[kCount], std::size_t at) {
  return at < kCount ? &choices[at] : nullptr;
}

std::string figures_of(const ValidityGate& gate) {
  return format("%s %.4g, %s %.4g", gate.name.c_str(), gate.value, gate.at_least ? "at least" : "at most", gate.limit);
}

}  // namespace

std::shared_ptr<const LoadedImage> flown_image(const mcap::IndexedFile& file) {
  const std::optional<std::string> bytes = file.attachment(kImageAttachment);
  if (!bytes) return nullptr;
  try {
    return std::make_shared<const LoadedImage>(kImageAttachment, std::vector<std::uint8_t>(bytes->begin(), bytes->end()));
  } catch (const InputError&) {
    return nullptr;
  }
}

std::vector<ValidityGate> validity_gates(const PoseTelemetry& told, const MissionParameters& parameters) {
  std::vector<ValidityGate> gates;
  if (static_cast<StopReason>(told.stop) == StopReason::kNotRun) return gates;
  bool reached = true;  // all gates before are passed
  for (const GateRow& row : kGates) {
    gates.push_back(gate_of(row, told, parameters, reached));
    reached = reached && gates.back().pass;
  }
  return gates;
}

std::vector<WeakDirection> weak_directions(const Mat6& covariance, const LoadedImage& image) {
  const double radius_m = image.mission().radius_m;
  const MissionParameters& p = image.mission().parameters;
  const double limit_m = std::min(p.sigma_attitude_max_rad * radius_m, p.sigma_position_max_m);
  std::vector<WeakDirection> weak;
  if (!covariance.allFinite()) return weak;
  const Eigen6 eigen = axes_at_radius(covariance, radius_m);
  for (int i = 5; i >= 0; --i) {
    if (!(eigen.values[i] > limit_m * limit_m)) continue;
    Vec6 direction;
    direction << eigen.vectors.col(i).tail<3>(), eigen.vectors.col(i).head<3>();
    weak.push_back({direction, std::sqrt(eigen.values[i])});
  }
  return weak;
}

std::string why_text(const PoseTelemetry& told, const std::vector<ValidityGate>& gates) {
  const Choice* reason = choice_at(kPoseReasons, told.reason);
  if (reason == nullptr) return format("the reason is %u, which this program does not know", told.reason);
  if (told.valid != 0) return "valid: " + std::string(reason->meaning);
  const auto mode = static_cast<TrackingMode>(told.mode);
  if (mode == TrackingMode::kSafe || mode == TrackingMode::kStandby) {
    const Choice* at_rest = choice_at(kTrackingModes, told.mode);
    return std::string("not valid: the component is in mode ") + at_rest->name + ": " + at_rest->meaning;
  }
  std::string text = std::string("not valid, ") + reason->name + ": " + reason->meaning;
  for (const ValidityGate& gate : gates) {
    if (!gate.pass) {
      text += " (" + figures_of(gate) + ")";
      break;
    }
  }
  return reason->action[0] != '\0' ? text + ". What helps: " + reason->action : text;
}

}  // namespace lasso::mdat::serve
