#include "fsw/exec/report.hpp"

#include "fsw/exec/wire_values.hpp"
#include "fsw/geometry/portable_math.hpp"

#ifndef LASSO_BUILD_ID
#define LASSO_BUILD_ID 0
#endif

namespace lasso {
namespace {

constexpr std::uint32_t kMajor = 0;
constexpr std::uint32_t kMinor = 2;
constexpr std::uint32_t kPatch = 0;
constexpr char kVersion[] = "0.2.0";
constexpr std::int64_t kMaxAgeUs = 0xFFFFFFFF;

float sigma_of(double variance) { return static_cast<float>(square_root(variance)); }

void describe_registration(const Registration& r, PoseTelemetry& out) {
  out.scan_id = r.scan_id;
  out.t_measurement_us = r.t_us;
  out.valid = r.valid() ? 1 : 0;
  out.reason = static_cast<std::uint8_t>(r.reason);
  out.stop = static_cast<std::uint8_t>(r.stop);
  copy_pose(r.T_sensor_target, out.q_sensor_target, out.p_sensor_target_m);
  copy_upper_triangle(r.covariance, Span<double>(out.covariance));
}

void describe_quality(const Registration& r, PoseTelemetry& out) {
  out.rays = r.rays;
  out.returns = r.returns;
  out.inliers = r.inliers;
  out.labels = r.labels;
  out.iterations = r.iterations;
  out.weak = r.weak;
  out.rms_m = static_cast<float>(r.rms_m);
  out.normalized_residual = static_cast<float>(r.normalized_residual);
  out.inlier_share = static_cast<float>(r.inlier_share);
  out.agreement = static_cast<float>(r.agreement);
  out.weakest_sigma_m = static_cast<float>(r.weakest_sigma_m);
  for (int i = 0; i < 6; ++i) out.weakest_direction[i] = static_cast<float>(r.weakest_direction[i]);
}

void describe_filter(const FilterState& filter, PoseTelemetry& out) {
  copy_pose(filter.T_sensor_target, out.filter_q_sensor_target, out.filter_p_sensor_target_m);
  for (int i = 0; i < 3; ++i) {
    out.filter_omega_radps[i] = filter.rates.omega_radps[i];
    out.filter_v_mps[i] = filter.rates.v_mps[i];
  }
  for (int i = 0; i < 6; ++i) {
    out.filter_sigma_pose[i] = sigma_of(filter.covariance(i, i));
    out.filter_sigma_rates[i] = sigma_of(filter.covariance(i + 6, i + 6));
  }
}

void describe_plan(const ScanPlan& plan, PoseTelemetry& out) {
  out.plan_center[0] = plan.center_x;
  out.plan_center[1] = plan.center_y;
  out.plan_half_extents[0] = plan.half_x;
  out.plan_half_extents[1] = plan.half_y;
  out.plan_phase_turns = plan.phase_turns;
  out.plan_points = plan.points;
  out.plan_duration_us = static_cast<std::uint32_t>(plan.duration_us);
  out.plan_pattern = static_cast<std::uint8_t>(plan.kind);
}

void describe_bearing(const Bearing& bearing, PoseTelemetry& out) {
  out.bearing_reason = static_cast<std::uint8_t>(bearing.reason);
  out.bearing_returns = bearing.returns;
  out.bearing_used = bearing.used;
  out.bearing_scans = bearing.scans;
  out.t_bearing_us = bearing.t_us;
  for (int i = 0; i < 6; ++i) {
    out.bearing[i] = bearing.value[i];
    out.bearing_sigma[i] = sigma_of(bearing.covariance(i, i));
  }
}

void describe_candidate(const SearchCandidate& candidate, std::size_t index, PoseTelemetry& out) {
  double q[4], p[3];
  copy_pose(candidate.T_sensor_target, q, p);
  for (std::size_t i = 0; i < 4; ++i) out.candidate_q_sensor_target[4 * index + i] = static_cast<float>(q[i]);
  for (std::size_t i = 0; i < 3; ++i) out.candidate_p_sensor_target_m[3 * index + i] = static_cast<float>(p[i]);
}

void describe_search(const SearchResult& search, PoseTelemetry& out) {
  out.search_outcome = static_cast<std::uint8_t>(search.outcome);
  out.search_reason = static_cast<std::uint8_t>(search.reason);
  out.search_scans = static_cast<std::uint8_t>(search.scans);
  out.search_ratio = static_cast<float>(search.ratio);
  out.search_disagreement = static_cast<float>(search.disagreement);
  out.search_work = search.work;
  out.t_search_us = search.t_us;
  for (const SearchCandidate& candidate : search.candidates) {
    if (out.search_candidates < kTelemetryCandidates) describe_candidate(candidate, out.search_candidates++, out);
  }
}

static_assert(kMaxParts <= 8, "a bit of parts_resting each");
void describe_parts(const TrackStep& step, PoseTelemetry& out) {
  out.part = step.parts.scanned;
  out.inconsistent_part = step.parts.inconsistent;
  out.inconsistency_sigmas = static_cast<float>(step.parts.inconsistency_sigmas);
  if (!properties(step.after.mode).by_parts) return;
  for (std::size_t i = 0; i < kMaxParts; ++i) {
    if (rests(step.after.parts.of[i], step.registration.scan_id))
      out.parts_resting = static_cast<std::uint8_t>(out.parts_resting | 1U << i);
  }
}

std::uint32_t bounded_age(DurationUs age_us) {
  if (age_us < 0) return 0;
  return static_cast<std::uint32_t>(age_us < kMaxAgeUs ? age_us : kMaxAgeUs);
}

}  // namespace

std::uint32_t software_version() { return kMajor << 24 | kMinor << 16 | kPatch; }

std::uint32_t software_build() { return LASSO_BUILD_ID; }

const char* version() { return kVersion; }

PoseTelemetry make_report(const Mission& mission, const TrackStep& step, const ScanPlan& plan, TimeUs t_publication_us) {
  PoseTelemetry out;
  describe_registration(step.registration, out);
  describe_quality(step.registration, out);
  describe_filter(step.after.filter, out);
  describe_plan(plan, out);
  describe_bearing(step.bearing, out);
  describe_search(step.search, out);
  describe_parts(step, out);
  out.t_publication_us = t_publication_us;
  out.age_us = bounded_age(t_publication_us - out.t_measurement_us);
  out.mode = static_cast<std::uint8_t>(step.after.mode);
  out.held = step.after.held ? 1 : 0;
  out.start_source = static_cast<std::uint8_t>(step.after.source);
  out.image_crc = mission.image_crc;
  out.software_version = software_version();
  out.software_build = software_build();
  return out;
}

FilterTelemetry make_filter_report(std::uint32_t scan_id, const FilterState& filter, const CommonErrors& common) {
  FilterTelemetry report;
  report.scan_id = scan_id;
  report.t_us = filter.t_us;
  report.started = filter.initialised ? 1 : 0;
  report.accepted = filter.accepted;
  report.rejected = filter.rejected;
  copy_upper_triangle(filter.covariance, Span<float>(report.covariance));
  const Span<float> terms(report.common);
  std::size_t term = 0;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 4; ++column) {
      terms[term] = static_cast<float>(common(row, column));
      ++term;
    }
  }
  return report;
}

}  // namespace lasso
