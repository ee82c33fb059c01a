#include <cmath>
#include <iterator>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/missiondb/mission_checks.hpp"
#include "mdat/missiondb/rule.hpp"
#include "mdat/missiondb/value_row.hpp"

namespace lasso::mdat {
namespace {

// Of half of the target's length: a length of the estimation above it is one in other units.
constexpr double kLargestShare = 0.25;
constexpr double kTightestKernel = 3;
constexpr double kLostShare = 0.05;         // of good poses, by a gate on their normalised square
constexpr double kMostContradicting = 0.1;  // of the returns: what moves fewer of them is no other configuration
constexpr double kMostInitialTurn_rad = 15 * kRadPerDeg;

std::string inlier_share_fault(const Subject& s) {
  const double begins = s.p.inlier_share_min + s.p.hysteresis;
  if (begins <= 1) return "";
  return "expected at most " + figure(1 - s.p.hysteresis) + ": with tracking.hysteresis, which is " + figure(s.p.hysteresis) +
         ", a track begins with " + percent_text(begins) + " of the returns explained";
}

std::string agreement_fault(const Subject& s) {
  const double contradicting = 1 - s.p.agreement_min;
  if (s.scenario != nullptr || contradicting <= kMostContradicting) return "";
  return "as many rays as " + percent_text(contradicting) +
         " of the returns may contradict a pose: a target that is not as modelled is then not reported; the preset is " +
         figure(preset_parameters().agreement_min);
}

std::string start_share_fault(const Subject& s) {
  if (s.p.start_inlier_share_min >= s.p.inlier_share_min) return "";
  return "has no effect below tracking.inlier_share_min, which is " + figure(s.p.inlier_share_min) +
         ": the scan that confirms a start has to be valid as well";
}

std::string trial_fault(const Subject& s) {
  if (s.p.image_trial_scans == 0 || s.p.image_trial_valid_min <= s.p.image_trial_scans) return "";
  return "expected at most image.trial_scans, which is " + number_text(s.p.image_trial_scans) +
         ": every image that takes over would be taken back";
}

std::string silhouette_band_fault(const Subject& s) {
  if (s.p.silhouettes < 0.5 || s.p.silhouette_sigma_m <= s.p.silhouette_band_m) return "";
  return "a contour is less certain than estimation.silhouette_band_m, which is " + figure(s.p.silhouette_band_m) +
         " m, is wide: no ray tells on which side of it it passed";
}

std::string probe_fault(const Subject& s) {
  if (s.p.silhouettes < 0.5 || s.p.probe_step_m <= s.p.silhouette_band_m) return "";
  return "contours are confirmed farther off than estimation.silhouette_band_m, which is " + figure(s.p.silhouette_band_m) + " m";
}

std::string age_fault(const Subject& s) {
  if (s.p.start_age_max_s >= s.p.period_s) return "";
  return "a pose that comes over the link waits for the next frame, up to filter.period_s, which is " + figure(s.p.period_s) +
         " s: it would be refused as too old";
}

std::string kernel_fault(const Subject& s) {
  if (s.p.kernel_width >= kTightestKernel) return "";
  return "returns more than " + figure(s.p.kernel_width) + " sigmas off do not count: good ones go with the bad, and poses are refused";
}

// Of good poses, those whose normalised square, chi-square of 6 degrees of freedom, is beyond the gate: in closed form.
double refused_share(double gate) { return std::exp(-gate / 2) * (1 + gate / 2 + gate * gate / 8); }

std::string gate_text(double gate) {
  return "the normalised square of a good pose's difference is 6 on average, and beyond " + figure(gate) + " in " +
         percent_text(refused_share(gate)) + " of them, which would be refused";
}

std::string innovation_fault(const Subject& s) {
  const double gate = s.p.innovation_max * s.p.innovation_max;
  return refused_share(gate) <= kLostShare ? "" : gate_text(gate);
}

std::string fast_start_fault(const Subject& s) {
  const double rate_radps = std::hypot(s.p.initial_wx_radps, s.p.initial_wy_radps, s.p.initial_wz_radps);
  const double turn_rad = rate_radps * s.p.duration_s;
  if (s.p.initial_present == 0 || turn_rad <= kMostInitialTurn_rad) return "";
  return "the target of [tracking.initial] turns by " + degrees_text(turn_rad) + " in a scan: no such scan was registered";
}

std::string silence_fault(const Subject& s) {
  if (s.p.link_silence_max_s == 0 || s.p.link_silence_max_s >= s.p.period_s) return "";
  return "is less than filter.period_s, which is " + figure(s.p.period_s) +
         " s: link_silent would be reported between any two commands; 0 is never";
}

template <int kTurn>
std::string repeated_fault(const Subject& s) {
  static constexpr const char* kKeys[] = {"start.first", "start.second", "start.third", "start.fourth", "start.fifth"};
  const double sources[] = {s.p.start_first, s.p.start_second, s.p.start_third, s.p.start_fourth, s.p.start_fifth};
  for (int i = 0; i < kTurn; ++i) {
    if (sources[kTurn] != 0 && sources[i] == sources[kTurn])
      return std::string("expected another source than that of ") + kKeys[i] + ", or none";
  }
  return "";
}

double quaternion_length(const MissionParameters& p) {
  return std::sqrt(p.initial_qx * p.initial_qx + p.initial_qy * p.initial_qy + p.initial_qz * p.initial_qz + p.initial_qw * p.initial_qw);
}

std::string quaternion_fault(const Subject& s) {
  const double length = quaternion_length(s.p);
  if (std::fabs(length - 1) <= kQuaternionTolerance) return "";
  return "expected a quaternion of unit length (within " + number_text(kQuaternionTolerance) + "), that of [" +
         number_text(s.p.initial_qx) + ", " + number_text(s.p.initial_qy) + ", " + number_text(s.p.initial_qz) + ", " +
         number_text(s.p.initial_qw) + "] is " + number_text(length);
}

std::string behind_fault(const Subject& s) {
  return s.p.initial_present == 0 || s.p.initial_z_m > 0 ? "" : "expected more than 0: the target is in front";
}

std::string unused_start_fault(const Subject& s) {
  if (s.p.initial_present == 0 || is_in_order(s.p, kAprioriSource)) return "";
  return "the pose in [tracking.initial] is not used: \"apriori\" is none of start.first to start.fifth";
}

std::string missing_start_fault(const Subject& s) {
  if (s.p.initial_present != 0 || !is_in_order(s.p, kAprioriSource)) return "";
  for (const double source : {s.p.start_first, s.p.start_second, s.p.start_third, s.p.start_fourth, s.p.start_fifth}) {
    if (source != 0 && source != kAprioriSource) return "";
  }
  return "expected true: the only source of a start, \"apriori\", needs the pose in [tracking.initial]";
}

std::string short_range_fault(const Subject& s) {
  if (s.p.short_range_enter_m <= 0 || s.p.short_range_leave_m > s.p.short_range_enter_m) return "";
  return "expected more than short_range.enter_m, which is " + number_text(s.p.short_range_enter_m) + " m";
}

std::string no_parts_fault(const Subject& s) {
  if (s.p.short_range_enter_m <= 0 || !s.source.parts.empty()) return "";
  return "the mission has no parts to look at: add them as [part.NAME], or set it to 0";
}

std::string unused_parts_fault(const Subject& s) {
  if (s.source.parts.empty() || s.p.short_range_enter_m > 0) return "";
  return "the parts of the target are never looked at: set the range within which they are, as 1.5 times the largest of their range_m";
}

template <double EstimationParameters::*kMember>
std::string length_fault(const Subject& s) {
  const double value_m = s.p.*kMember, half_m = s.target->half_m();
  if (value_m <= kLargestShare * half_m) return "";
  return "is " + percent_text(value_m / s.target->longest_m()) + " of the target's length, which is " + figure(s.target->longest_m()) +
         " m; in millimetres? " + figure(value_m) + " mm are " + figure(1e-3 * value_m) + " m";
}

}  // namespace

const Rules& estimation_rules() {
  using enum Severity;
  using enum Scope;
  using enum Needs;
  using P = MissionParameters;
  // clang-format off
  static const Rules rules = {
    {kError, kParameters, kValues, {"tracking.inlier_share_min", "tracking.hysteresis"}, inlier_share_fault},
    {kWarning, kParameters, kValues, {"tracking.agreement_min"}, agreement_fault},
    {kWarning, kParameters, kValues, {"start.inlier_share_min", "tracking.inlier_share_min"}, start_share_fault},
    {kError, kParameters, kValues, {"image.trial_valid_min", "image.trial_scans"}, trial_fault},
    {kWarning, kParameters, kValues, {"estimation.silhouette_sigma_m", "estimation.silhouette_band_m"}, silhouette_band_fault},
    {kWarning, kParameters, kValues, {"estimation.probe_step_m", "estimation.silhouette_band_m"}, probe_fault},
    {kWarning, kParameters, kValues, {"start.age_max_s", "filter.period_s"}, age_fault},
    {kWarning, kParameters, kValues, {"estimation.kernel_width"}, kernel_fault},
    {kWarning, kParameters, kValues, {"tracking.innovation_max"}, innovation_fault},
    {kWarning, kParameters, kValues, {"tracking.initial.wx_degps", "tracking.initial.wy_degps", "tracking.initial.wz_degps"}, fast_start_fault},
    {kWarning, kParameters, kValues, {"link.silence_max_s", "filter.period_s"}, silence_fault},
    {kError, kParameters, kValues, {"start.second", "start.first"}, repeated_fault<1>},
    {kError, kParameters, kValues, {"start.third", "start.first", "start.second"}, repeated_fault<2>},
    {kError, kParameters, kValues, {"start.fourth", "start.first", "start.second", "start.third"}, repeated_fault<3>},
    {kError, kParameters, kValues, {"start.fifth", "start.first", "start.second", "start.third", "start.fourth"}, repeated_fault<4>},
    {kError, kParameters, kValues, {"tracking.initial.qw", "tracking.initial.qx", "tracking.initial.qy", "tracking.initial.qz"}, quaternion_fault},
    {kError, kParameters, kValues, {"tracking.initial.z_m", "tracking.initial.present"}, behind_fault},
    {kWarning, kParameters, kValues, {"tracking.initial.present", "start.first"}, unused_start_fault},
    {kError, kParameters, kValues, {"tracking.initial.present", "start.first"}, missing_start_fault},
    {kError, kParameters, kValues, {"short_range.leave_m", "short_range.enter_m"}, short_range_fault},
    {kError, kMission, kValues, {"short_range.enter_m"}, no_parts_fault},
    {kWarning, kMission, kValues, {"short_range.enter_m"}, unused_parts_fault},
    {kWarning, kParameters, kTarget, {"estimation.gate_first_m"}, length_fault<&P::gate_first_m>},
    {kWarning, kParameters, kTarget, {"estimation.silhouette_sigma_m"}, length_fault<&P::silhouette_sigma_m>},
    {kWarning, kParameters, kTarget, {"estimation.silhouette_band_m"}, length_fault<&P::silhouette_band_m>},
    {kWarning, kParameters, kTarget, {"estimation.edge_gap_min_m"}, length_fault<&P::edge_gap_min_m>},
    {kWarning, kParameters, kTarget, {"estimation.edge_depth_m"}, length_fault<&P::edge_depth_m>},
    {kWarning, kParameters, kTarget, {"estimation.probe_step_m"}, length_fault<&P::probe_step_m>},
    {kWarning, kParameters, kTarget, {"estimation.surface_sigma_m"}, length_fault<&P::surface_sigma_m>},
    {kWarning, kParameters, kTarget, {"estimation.stop_translation_m"}, length_fault<&P::stop_translation_m>},
  };
  // clang-format on
  return rules;
}

}  // namespace lasso::mdat
