#include "fsw/exec/report.hpp"

#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include "fsw/exec/faults.hpp"
#include "fsw/link/dictionary.hpp"
#include "fsw/sense/sensor_chooser.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

TEST(FilterReport, HoldsTheUpperTriangleByRows) {
  VERIFIES("LASSO-LNK-039~1");
  FilterState filter;
  filter.t_us = 77;
  filter.accepted = 3;
  filter.rejected = 4;
  for (int row = 0; row < 12; ++row) {
    for (int column = 0; column < 12; ++column) filter.covariance(row, column) = 100 * std::min(row, column) + std::max(row, column);
  }
  CommonErrors common;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 4; ++column) common(row, column) = 10 * row + column;
  }
  const FilterTelemetry report = make_filter_report(5, filter, common);
  for (std::size_t i = 0; i < kCommonTerms; ++i) EXPECT_EQ(report.common[i], static_cast<float>(10 * (i / 4) + i % 4)) << i;
  EXPECT_EQ(report.scan_id, 5u);
  EXPECT_EQ(report.t_us, 77);
  EXPECT_EQ(report.started, 0);
  EXPECT_EQ(report.accepted, 3u);
  EXPECT_EQ(report.rejected, 4u);
  std::size_t term = 0;
  for (int row = 0; row < 12; ++row) {
    for (int column = row; column < 12; ++column) EXPECT_EQ(report.covariance[term++], static_cast<float>(100 * row + column));
  }
  EXPECT_EQ(term, kFilterCovarianceTerms);
  filter.initialised = true;
  EXPECT_EQ(make_filter_report(5, filter, common).started, 1);
}

// Every value differs from every other, so that a swap shows.
TrackStep numbered_step() {
  TrackStep step;
  Registration& r = step.registration;
  r.scan_id = 1;
  r.t_us = 2000000;
  r.T_sensor_target.q = normalized(Quat(0.9, 0.1, -0.2, 0.3));
  r.T_sensor_target.p = Vec3(1.5, -2.5, 3.5);
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) r.covariance(row, column) = 10 * std::min(row, column) + std::max(row, column);
  }
  r.reason = PoseReason::kValid;
  r.stop = StopReason::kIterationLimit;
  r.iterations = 5;
  r.rays = 6;
  r.returns = 7;
  r.inliers = 8;
  r.labels = 9;
  r.weak = 2;
  r.rms_m = 0.011;
  r.normalized_residual = 0.012;
  r.inlier_share = 0.013;
  r.agreement = 0.014;
  r.weakest_sigma_m = 0.015;
  r.weakest_direction << 1, 2, 3, 4, 5, 6;
  step.after.mode = TrackingMode::kCoasting;
  step.after.filter.T_sensor_target.p = Vec3(7, 8, 9);
  step.after.filter.rates.omega_radps = Vec3(0.1, 0.2, 0.3);
  step.after.filter.rates.v_mps = Vec3(0.4, 0.5, 0.6);
  for (int i = 0; i < 12; ++i) step.after.filter.covariance(i, i) = (i + 1) * (i + 1);
  return step;
}

ScanPlan numbered_plan() {
  ScanPlan plan;
  plan.kind = PatternKind::kRaster;
  plan.points = 99;
  plan.phase_turns = 0.25;
  plan.center_x = 0.01;
  plan.center_y = 0.02;
  plan.half_x = 0.03;
  plan.half_y = 0.04;
  plan.duration_us = 150000;
  return plan;
}

PoseTelemetry numbered_report() {
  Mission mission;
  mission.image_crc = 0xABCDEF01;
  return make_report(mission, numbered_step(), numbered_plan(), 2310000);
}

TEST(Report, CarriesTheRegistration) {
  VERIFIES("LASSO-EXE-006~1 LASSO-LNK-025~2 LASSO-NEED-004~1");
  const PoseTelemetry t = numbered_report();
  const Quat q = numbered_step().registration.T_sensor_target.q;
  EXPECT_EQ(t.scan_id, 1u);
  EXPECT_EQ(t.t_measurement_us, 2000000);
  EXPECT_EQ(t.t_publication_us, 2310000);
  EXPECT_EQ(t.age_us, 310000u);
  EXPECT_EQ(t.valid, 1);
  EXPECT_EQ(t.reason, 0);
  EXPECT_EQ(t.stop, 1);
  EXPECT_EQ(t.mode, 3);
  EXPECT_EQ(t.q_sensor_target[0], q.x());
  EXPECT_EQ(t.q_sensor_target[1], q.y());
  EXPECT_EQ(t.q_sensor_target[2], q.z());
  EXPECT_EQ(t.q_sensor_target[3], q.w());
  EXPECT_EQ(t.p_sensor_target_m[1], -2.5);
  const float upper[] = {0, 1, 2, 3, 4, 5, 11, 12, 13, 14, 15, 22, 23, 24, 25, 33, 34, 35, 44, 45, 55};
  for (std::size_t i = 0; i < kPoseCovarianceTerms; ++i) EXPECT_EQ(t.covariance[i], upper[i]) << i;
}

TEST(Report, CarriesQualityAndFilter) {
  VERIFIES("LASSO-EXE-006~1 LASSO-LNK-025~2");
  const PoseTelemetry t = numbered_report();
  EXPECT_EQ(t.iterations, 5);
  EXPECT_EQ(t.rays, 6);
  EXPECT_EQ(t.returns, 7);
  EXPECT_EQ(t.inliers, 8);
  EXPECT_EQ(t.labels, 9);
  EXPECT_EQ(t.weak, 2);
  EXPECT_FLOAT_EQ(t.rms_m, 0.011f);
  EXPECT_FLOAT_EQ(t.normalized_residual, 0.012f);
  EXPECT_FLOAT_EQ(t.inlier_share, 0.013f);
  EXPECT_FLOAT_EQ(t.agreement, 0.014f);
  EXPECT_FLOAT_EQ(t.weakest_sigma_m, 0.015f);
  EXPECT_EQ(t.weakest_direction[5], 6.0f);
  EXPECT_EQ(t.filter_p_sensor_target_m[2], 9);
  EXPECT_EQ(t.filter_omega_radps[1], 0.2);
  EXPECT_EQ(t.filter_v_mps[0], 0.4);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(t.filter_sigma_pose[i], static_cast<float>(i + 1));
    EXPECT_EQ(t.filter_sigma_rates[i], static_cast<float>(i + 7));
  }
}

TEST(Report, AFilterThatHasNotStartedHasNoSigmas) {
  VERIFIES("LASSO-EXE-006~1");
  TrackStep step = numbered_step();
  step.after.filter = FilterState{};
  const PoseTelemetry t = make_report(Mission{}, step, ScanPlan{}, 0);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(t.filter_sigma_pose[i], 0);
    EXPECT_EQ(t.filter_sigma_rates[i], 0);
  }
}

TEST(Report, CarriesTheParts) {
  VERIFIES("LASSO-MOD-162~1");
  TrackStep step = numbered_step();
  step.parts.scanned = 3;
  step.parts.inconsistent = 5;
  step.parts.inconsistency_sigmas = 7.5;
  step.after.parts.of[1].rests_until = 2;  // the scan is number 1
  step.after.parts.of[4].rests_until = 3;
  step.after.parts.of[5].rests_until = 1;
  EXPECT_EQ(make_report(Mission{}, step, ScanPlan{}, 0).parts_resting, 0) << "in a mode that looks at the whole nobody rests";
  step.after.mode = TrackingMode::kShortRange;
  const PoseTelemetry t = make_report(Mission{}, step, ScanPlan{}, 0);
  EXPECT_EQ(t.part, 3);
  EXPECT_EQ(t.inconsistent_part, 5);
  EXPECT_EQ(t.inconsistency_sigmas, 7.5F);
  EXPECT_EQ(t.parts_resting, 0b10010);
}

TEST(Report, CarriesTheBearingAndTheTracksStart) {
  VERIFIES("LASSO-EXE-006~1 LASSO-MOD-101~3");
  TrackStep step = numbered_step();
  step.after.held = true;
  step.after.source = InitialPoseSource::kNavigation;
  Bearing& b = step.bearing;
  b.reason = BearingReason::kValid;
  b.t_us = 1900000;
  b.returns = 31;
  b.used = 32;
  b.scans = 33;
  for (int i = 0; i < 6; ++i) {
    b.value[i] = 40 + i;
    b.covariance(i, i) = (i + 2) * (i + 2);
  }
  const PoseTelemetry t = make_report(Mission{}, step, ScanPlan{}, 0);
  EXPECT_EQ(t.held, 1);
  EXPECT_EQ(t.start_source, 2);
  EXPECT_EQ(t.bearing_reason, 0);
  EXPECT_EQ(t.t_bearing_us, 1900000);
  EXPECT_EQ(t.bearing_returns, 31);
  EXPECT_EQ(t.bearing_used, 32);
  EXPECT_EQ(t.bearing_scans, 33u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(t.bearing[i], 40.0 + static_cast<double>(i));
    EXPECT_EQ(t.bearing_sigma[i], static_cast<float>(i + 2));
  }
  EXPECT_EQ(numbered_report().held, 0);
}

TEST(Report, CarriesTheSearchAndItsFirstCandidates) {
  VERIFIES("LASSO-MOD-124~1 LASSO-EXE-006~1 LASSO-MOD-120~2");
  TrackStep step;
  SearchResult& search = step.search;
  search.outcome = SearchOutcome::kAmbiguous;
  search.reason = SearchReason::kCompetitor;
  search.scans = 2;
  search.t_us = 1234567;
  search.ratio = 1.25;
  search.disagreement = 0.125;
  search.work = 3000000;
  for (int i = 0; i < 5; ++i) {
    SearchCandidate candidate;
    candidate.T_sensor_target.q = Quat(0.5, 0.5, -0.5, 0.5);
    candidate.T_sensor_target.p = Vec3(i, 10 + i, 20 + i);
    ASSERT_TRUE(search.candidates.push_back(candidate));
  }
  const PoseTelemetry t = make_report(Mission{}, step, ScanPlan{}, 0);
  EXPECT_EQ(t.search_outcome, 2);
  EXPECT_EQ(t.search_reason, 2);
  EXPECT_EQ(t.search_scans, 2);
  EXPECT_EQ(t.t_search_us, 1234567);
  EXPECT_EQ(t.search_ratio, 1.25F);
  EXPECT_EQ(t.search_disagreement, 0.125F);
  EXPECT_EQ(t.search_work, 3000000u);
  ASSERT_EQ(t.search_candidates, kTelemetryCandidates);
  EXPECT_EQ(t.candidate_q_sensor_target[4 * 3 + 1], -0.5F);
  EXPECT_EQ(t.candidate_q_sensor_target[4 * 3 + 3], 0.5F);
  EXPECT_EQ(t.candidate_p_sensor_target_m[3 * 2 + 1], 12.0F);
  EXPECT_EQ(numbered_report().search_candidates, 0);
}

TEST(Report, CarriesPlanImageAndVersion) {
  VERIFIES("LASSO-EXE-006~1 LASSO-LNK-025~2");
  const PoseTelemetry t = numbered_report();
  EXPECT_EQ(t.plan_center[0], 0.01);
  EXPECT_EQ(t.plan_center[1], 0.02);
  EXPECT_EQ(t.plan_half_extents[0], 0.03);
  EXPECT_EQ(t.plan_half_extents[1], 0.04);
  EXPECT_EQ(t.plan_phase_turns, 0.25);
  EXPECT_EQ(t.plan_points, 99);
  EXPECT_EQ(t.plan_duration_us, 150000u);
  EXPECT_EQ(t.plan_pattern, 2);
  EXPECT_EQ(t.image_crc, 0xABCDEF01u);
  const std::uint32_t v = t.software_version;
  const std::string text = std::to_string(v >> 24) + "." + std::to_string(v >> 16 & 0xFF) + "." + std::to_string(v & 0xFFFF);
  EXPECT_EQ(text, version());
  EXPECT_EQ(t.software_build, software_build());
}

TEST(Report, AgeIsNeverNegativeAndNeverWraps) {
  VERIFIES("LASSO-EXE-006~1 LASSO-LNK-025~2");
  EXPECT_EQ(make_report(Mission{}, numbered_step(), ScanPlan{}, 1999999).age_us, 0u);
  EXPECT_EQ(make_report(Mission{}, numbered_step(), ScanPlan{}, 2000000 + (1LL << 33)).age_us, 0xFFFFFFFFu);
}

// Of each value from 0 up, and no more.
template <class E>
void expect_names(const Enumeration& enumeration, E last) {
  ASSERT_EQ(enumeration.choices.size(), static_cast<std::size_t>(last) + 1) << enumeration.name;
  for (std::size_t i = 0; i < enumeration.choices.size(); ++i) {
    EXPECT_STREQ(enumeration.choices[i].name, to_string(static_cast<E>(i))) << enumeration.name << " " << i;
    EXPECT_STRNE(enumeration.choices[i].meaning, "") << enumeration.name << " " << i;
  }
}

TEST(Report, DictionaryNamesTheEnumerationsAsTheCodeDoes) {
  VERIFIES("LASSO-LNK-002~1");
  expect_names(kPoseReason, PoseReason::kContradicted);
  expect_names(kStopReason, StopReason::kNotRun);
  EXPECT_EQ(kFault.choices.size(), kFaults);
  expect_names(kFaultReaction, FaultReaction::kMakeSafe);
  expect_names(kTrackingMode, TrackingMode::kVerifying);
  expect_names(kModeEvent, ModeEvent::kConfirmAnew);
  expect_names(kStartSource, InitialPoseSource::kSearch);
  expect_names(kStartRefusal, StartRefusal::kContradicted);
  expect_names(kModeRefusal, ModeRefusal::kNoPrediction);
  expect_names(kBearingReason, BearingReason::kJump);
  expect_names(kSearchOutcome, SearchOutcome::kRejected);
  expect_names(kSearchReason, SearchReason::kUnfinished);
  expect_names(kSensorReason, SensorReason::kBusy);
  EXPECT_STREQ(kPattern.choices[static_cast<std::size_t>(PatternKind::kRaster)].name, "raster");
  EXPECT_EQ(kTrackingMode.choices.size(), mode_properties().size());
  for (const ModeProperties& mode : mode_properties()) {
    EXPECT_STREQ(kTrackingMode.choices[static_cast<std::size_t>(mode.mode)].meaning, mode.meaning);
  }
}

TEST(Report, DictionaryHasTheEnumerationOfEachItem) {
  VERIFIES("LASSO-LNK-002~1");
  const std::pair<const char*, const Enumeration*> expected[] = {{"valid", &kYesNo},
                                                                 {"reason", &kPoseReason},
                                                                 {"stop", &kStopReason},
                                                                 {"mode", &kTrackingMode},
                                                                 {"plan_pattern", &kPattern},
                                                                 {"held", &kYesNo},
                                                                 {"change_from", &kTrackingMode},
                                                                 {"change_event", &kModeEvent},
                                                                 {"change_to", &kTrackingMode},
                                                                 {"start_source", &kStartSource},
                                                                 {"refused_source", &kStartSource},
                                                                 {"refusal", &kStartRefusal},
                                                                 {"bearing_reason", &kBearingReason},
                                                                 {"search_outcome", &kSearchOutcome},
                                                                 {"search_reason", &kSearchReason},
                                                                 {"sensor_reason", &kSensorReason}};
  std::size_t next = 0;
  for (const ItemRow& row : kPackets[0].items) {
    if (row.enumeration == nullptr) continue;
    ASSERT_LT(next, std::size(expected));
    EXPECT_STREQ(row.name, expected[next].first);
    EXPECT_EQ(row.enumeration, expected[next].second) << row.name;
    ++next;
  }
  EXPECT_EQ(next, std::size(expected));
}

}  // namespace
}  // namespace lasso
