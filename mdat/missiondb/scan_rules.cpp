#include <algorithm>
#include <cmath>
#include <numeric>

#include "cfg/capacities.hpp"
#include "fsw/pose/recognition/search_limits.hpp"
#include "mdat/missiondb/pattern_coverage.hpp"
#include "mdat/missiondb/rule.hpp"
#include "mdat/missiondb/value_row.hpp"

namespace lasso::mdat {
namespace {

constexpr double kIdlePeriods = 10;    // of a scan, between two of them
constexpr double kWidestMargin = 2;    // a quarter of the rays falls on what the target is predicted to fill
constexpr double kSearchWork = 1.2e6;  // of most searches
constexpr double kUsualReturns = 1.0 / 3;
constexpr double kReturningShare = 0.3;  // of the rays of a scan around a target of unknown attitude
constexpr double kGapOverEven = 2.5;  // over that of rays that lie evenly: Lissajous figures of 19 and 12 cycles have 3.1, the rosette 1.9
constexpr double kMostSwept = 0.6;    // of the period, by a raster
constexpr double kWidestGap = 0.2;    // in half extents

PatternKind kind_of(const MissionParameters& p) { return static_cast<PatternKind>(static_cast<int>(p.pattern)); }

double most_returns(const MissionParameters& p) { return std::floor(p.points * (1 - p.dropout_probability)); }

bool searches(const MissionParameters& p) { return is_in_order(p, kSearchSource) || checks_starts(p); }

// Of one scan: what a search looks at.
double most_looked_at(const MissionParameters& p) { return std::min(static_cast<double>(kSubsetHits), most_returns(p)); }

std::string points_fault(const Subject& s) {
  if (s.p.points <= static_cast<double>(kMaxRays)) return "";
  return "the flight component has room for " + std::to_string(kMaxRays) + " rays";
}

std::string inliers_fault(const Subject& s) {
  if (s.p.inliers_min <= most_returns(s.p)) return "";
  const std::string drops = s.p.dropout_probability > 0 ? ", of which " + number_text(most_returns(s.p)) + " return at most" : "";
  return "expected at most scan.points, which is " + number_text(s.p.points) + drops;
}

std::string many_inliers_fault(const Subject& s) {
  const double usual = std::floor(kUsualReturns * most_returns(s.p));
  if (s.p.inliers_min <= usual || s.p.inliers_min > most_returns(s.p)) return "";
  return "of a slender target no more than a third of " + number_text(s.p.points) + " rays may return, about " + number_text(usual) +
         ": poses with fewer inliers are not valid";
}

std::string lines_fault(const Subject& s) {
  if (kind_of(s.p) != PatternKind::kRaster || s.p.points >= 2 * s.p.cycles_a) return "";
  return "a raster needs at least 2 points a line: fewer lines, or more scan.points";
}

std::string common_divisor_fault(const Subject& s) {
  const int a = static_cast<int>(s.p.cycles_a), b = static_cast<int>(s.p.cycles_b);
  if (kind_of(s.p) == PatternKind::kRaster || (a != b && std::gcd(a, b) == 1)) return "";
  return "expected a count that differs from scan.cycles_a, which is " + std::to_string(a) +
         ", and has no common divisor with it; otherwise the curve repeats itself";
}

std::string cycles_fault(const MissionParameters& p, double cycles) {
  if (cycles <= pattern_rays(p) / 2) return "";
  return "expected at most half of the pattern's " + number_text(pattern_rays(p)) + " rays: every scan would be refused in flight";
}

std::string cycles_a_fault(const Subject& s) {
  return kind_of(s.p) == PatternKind::kRaster && s.p.points < 2 * s.p.cycles_a ? "" : cycles_fault(s.p, s.p.cycles_a);
}

std::string cycles_b_fault(const Subject& s) { return kind_of(s.p) == PatternKind::kRaster ? "" : cycles_fault(s.p, s.p.cycles_b); }

std::string duration_fault(const Subject& s) {
  if (s.p.duration_s < s.p.period_s) return "";
  return "expected less than filter.period_s, which is " + number_text(s.p.period_s) + " s: a scan ends before the next begins";
}

std::string idle_fault(const Subject& s) {
  if (s.p.period_s <= kIdlePeriods * s.p.duration_s) return "";
  return "a scan takes " + figure(s.p.duration_s) + " s (scan.duration_s), so that the sensor rests " +
         percent_text(1 - s.p.duration_s / s.p.period_s) + " of the time; is it meant in Hz? " + figure(s.p.period_s) +
         " Hz are a period of " + figure(1 / s.p.period_s) + " s";
}

std::string aimed_fault(const Subject& s) {
  if (s.p.aimed_share == 0 || s.p.silhouettes > 0.5) return "";
  return "no ray is aimed, as estimation.silhouettes is false: nothing would use what it measures";
}

std::string margin_fault(const Subject& s) {
  if (s.p.margin >= 1 && s.p.margin <= kWidestMargin) return "";
  if (s.p.margin < 1) {
    return "the outer " + percent_text(1 - s.p.margin) + " of the target on each side are not scanned" +
           (s.p.silhouettes > 0.5 ? ", nor is its outline, which estimation.silhouettes measures" : "");
  }
  return "the target fills " + percent_text(1 / (s.p.margin * s.p.margin)) +
         " of such a scan, and gets no more of its rays; 1.1 is a margin of 10 %";
}

// The tenth-scale Hubble at rest, 60 frames: NEES 6.0 at 0.6 of the period, 26 at 0.7 and 178 at 0.9; without deskewing 5.5.
std::string skew_fault(const Subject& s) {
  const double share = s.p.duration_s / s.p.period_s;
  if (kind_of(s.p) != PatternKind::kRaster || s.p.deskew < 0.5 || share <= kMostSwept) return "";
  return "a raster goes over the target once in a scan of " + figure(s.p.duration_s) + " s, " + percent_text(share) +
         " of filter.period_s: with estimation.deskew an error of the predicted rates bends it, and the pose that follows makes the error "
         "larger; covariances are too small, and poses are refused. Scans of at most " +
         figure(kMostSwept * s.p.period_s) + " s, or a rosette, are free of it";
}

std::string gap_fault(const Subject& s) {
  const double gap = largest_gap(s.p), even = even_gap(pattern_rays(s.p));
  if (gap <= kWidestGap && gap <= kGapOverEven * even) return "";
  const double half_m = s.p.margin * s.target->half_m();
  return "its rays leave gaps of up to " + figure(2 * gap * half_m) + " m across on the target of " + figure(s.target->longest_m()) +
         " m, " + figure(gap / even) + " times those of " + number_text(pattern_rays(s.p)) + " rays that lie evenly (" +
         figure(2 * even * half_m) + " m): parts of it stay unseen; a rosette of 19 and 12 cycles with 1024 rays leaves " +
         figure(2 * 0.083 * half_m) + " m";
}

constexpr double kSearchHits = SearchLimits().hits_min;

bool has_too_few(const MissionParameters& p) { return kSearchHits > most_looked_at(p); }

std::string search_hits_fault(const Subject& s) {
  if (!searches(s.p) || !has_too_few(s.p)) return "";
  return "a search looks at " + number_text(most_looked_at(s.p)) + " returns of a scan of " + number_text(s.p.points) +
         " rays at most, needs " + number_text(kSearchHits) + ", and joins no scan to one with too few: no pose would be recognised";
}

std::string few_returns_fault(const Subject& s) {
  const double expected = std::floor(kReturningShare * most_returns(s.p));
  if (!searches(s.p) || kSearchHits <= expected || has_too_few(s.p)) return "";
  return "of a target of unknown attitude some " + number_text(expected) + " of " + number_text(s.p.points) +
         " rays return, and a search needs " + number_text(kSearchHits) + ": most scans would be rejected as too_few_returns; take more";
}

std::string search_work_fault(const Subject& s) {
  const double work = s.p.search_slice * s.p.search_frames;
  if (!is_in_order(s.p, kSearchSource) || work >= kSearchWork) return "";
  return "in search.frames, which are " + number_text(s.p.search_frames) + ", a search does " + figure(work) +
         " units of work, and most take " + figure(kSearchWork) + ": it is given up before it ends";
}

std::string bearing_returns_fault(const Subject& s) {
  if (s.p.bearing_returns_min <= most_returns(s.p)) return "";
  return "expected at most the " + number_text(most_returns(s.p)) +
         " returns that a scan of scan.points can have: there would be no bearing";
}

std::string bearing_memory_fault(const Subject& s) {
  if (s.p.bearing_memory_s > s.p.period_s) return "";
  return "expected more than filter.period_s, which is " + number_text(s.p.period_s) + " s: each scan would begin the bearing anew";
}

}  // namespace

const Rules& scan_rules() {
  using enum Severity;
  using enum Scope;
  using enum Needs;
  // clang-format off
  static const Rules rules = {
    {kError, kParameters, kValues, {"scan.points"}, points_fault},
    {kError, kParameters, kValues, {"tracking.inliers_min", "scan.points", "sensor.dropout_probability"}, inliers_fault},
    {kWarning, kParameters, kValues, {"tracking.inliers_min", "scan.points", "sensor.dropout_probability"}, many_inliers_fault},
    {kError, kParameters, kValues, {"scan.cycles_a", "scan.points", "scan.pattern"}, lines_fault},
    {kError, kParameters, kValues, {"scan.cycles_b", "scan.cycles_a", "scan.pattern"}, common_divisor_fault},
    {kError, kParameters, kValues, {"scan.cycles_a", "scan.points", "scan.aimed_share"}, cycles_a_fault},
    {kError, kParameters, kValues, {"scan.cycles_b", "scan.points", "scan.aimed_share"}, cycles_b_fault},
    {kError, kParameters, kValues, {"scan.duration_s", "filter.period_s"}, duration_fault},
    {kWarning, kParameters, kValues, {"filter.period_s", "scan.duration_s"}, idle_fault},
    {kWarning, kParameters, kValues, {"scan.aimed_share", "estimation.silhouettes"}, aimed_fault},
    {kWarning, kParameters, kValues, {"scan.margin"}, margin_fault},
    {kWarning, kParameters, kValues, {"scan.pattern", "scan.duration_s", "filter.period_s", "estimation.deskew"}, skew_fault},
    {kWarning, kParameters, kTarget, {"scan.pattern", "scan.cycles_a", "scan.cycles_b", "scan.points", "scan.aimed_share", "scan.phase_step_turns", "scan.margin"}, gap_fault},
    {kError, kParameters, kValues, {"scan.points", "sensor.dropout_probability", "start.check", "start.first", "start.second", "start.third", "start.fourth", "start.fifth"}, search_hits_fault},
    {kWarning, kParameters, kValues, {"scan.points", "sensor.dropout_probability", "start.check", "start.first", "start.second", "start.third", "start.fourth", "start.fifth"}, few_returns_fault},
    {kWarning, kParameters, kValues, {"search.slice", "search.frames", "start.first", "start.second", "start.third", "start.fourth", "start.fifth"}, search_work_fault},
    {kError, kParameters, kValues, {"bearing.returns_min", "scan.points"}, bearing_returns_fault},
    {kWarning, kParameters, kValues, {"bearing.memory_s", "filter.period_s"}, bearing_memory_fault},
  };
  // clang-format on
  return rules;
}

}  // namespace lasso::mdat
