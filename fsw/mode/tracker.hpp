// Tracking: one scan after another, from the prediction through registration and filter to the next mode; or, where no attitude is known,
// to a bearing. All state is the explicit struct TrackState; a step takes one and gives the next, so that a step whose result comes too
// late can be forgotten whole.
#pragma once

#include <cstdint>

#include "fsw/core/time.hpp"
#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/se3.hpp"
#include "fsw/mission/mission.hpp"
#include "fsw/mode/modes.hpp"
#include "fsw/mode/parts.hpp"
#include "fsw/mode/starts.hpp"
#include "fsw/pose/estimator/estimator.hpp"
#include "fsw/pose/recognition/pose_search.hpp"
#include "fsw/pose/scan/result.hpp"
#include "fsw/pose/silhouette/ray_placement.hpp"
#include "fsw/pose/tracking/bearing.hpp"
#include "fsw/pose/tracking/pose_filter.hpp"
#include "fsw/sense/range_image.hpp"

namespace lasso {

// How far the mode verifying has come with a start that a scan has confirmed (start.check): is there another pose, that explains this scan
// better? The track is followed meanwhile. kNone: no scan is searched. Where the search of the first scan contradicts nothing, but does not
// accept the start's pose either (`undecided`), the next valid scan is searched as well. kPassed: a search accepts the start's pose, or two
// contradict nothing and accept nothing (a symmetric target, few returns). The next valid pose is then believed.
struct StartCheck {
  enum class Stage : std::uint8_t { kNone, kSearching, kPassed };
  Stage stage = Stage::kNone;
  bool undecided = false;  // the first search
  TimeUs t_us = 0;         // of the scan
  Pose T_sensor_target;    // in it
};
enum class CheckOutcome : std::uint8_t { kSure, kUndecided, kContradicted };

// A search tells poses apart that are more than 15 deg off each other: five sigmas of this. A start that is stated better excludes them
// all.
constexpr double kKnownAttitude_rad = 3 * kRadPerDeg;

struct TrackState {
  TrackingMode mode = TrackingMode::kStandby;
  std::uint16_t missed = 0;  // scans without a valid pose since the last one, or since the mode began; at most 65535
  bool held = false;         // no mode ends because its frames are used up
  InitialPoseSource source = InitialPoseSource::kNone;  // of the present track's start
  bool rough = false;       // its attitude was stated no better than kKnownAttitude_rad: other poses may lie within it
  StartCheck check;         // of that start, in mode verifying
  bool interrupts = false;  // a start: the track that it interrupted is kept by whoever keeps this state
  FilterState filter;
  SensorNumber sensor = 0;  // of the last scan: whose common errors the filter carries
  BearingState bearing;
  std::uint32_t searches = 0;  // that were begun, those of checks too
  PartsState parts;            // of the mode that looks at parts
  // Since near or far, by range or by command, no valid pose has been where the mode now is for: within short_range.leave_m in
  // short_range, not within short_range.enter_m otherwise. Until one is, the range does not change the mode back. A track that starts, or
  // is reacquired, goes by its range again.
  bool range_awaited = false;
};

// What one scan led to. `after.filter` is stated at the registration's time.
struct TrackStep {
  TrackState after;
  Registration registration;
  Bearing bearing;                             // of a full-field scan, or one around the bearing
  SearchResult search;                         // of the scans that it has joined so far; in mode searching, and where a check ends
  StartRefusal refusal = StartRefusal::kNone;  // of the pose that the search accepted; kContradicted: of the present start
  PartsReport parts;                           // of a scan of a part
  ModeEvent event = ModeEvent::kStart;         // of the scan; says nothing of a frame without one
};

// Takes the state along the table. What belongs to the mode that ends is forgotten: the check; its count of frames and the track that a
// start interrupted, unless both modes try the same start; for a bearing or a search, the filter; for a bearing, the bearing before; for
// parts, what was remembered of them. After kFallBack the filter is still that of the start that was given up.
void change_mode(ModeEvent event, TrackState& state);

// Takes up a track at t_us: kStarting. Where it interrupts a track, and no scan confirms it, the event is kFallBack. Refused as start_from
// says, and kNotFromHere where the mode takes no start: `state` is then as it was.
StartRefusal start_track(const Mission& mission, InitialPoseSource source, const StartOffer& offer, TimeUs t_us, TrackState& state);

// One scan: predict, register, join to the filter, next mode. In a mode that confirms, a valid registration has to agree with the
// prediction (kFarFromStart), and starts the filter anew, since the prediction may be far off; so does one that the filter
// cannot take. Where start.check is set, a start of another source than search is then checked (kVerifying, end_check): the scans that it
// takes are kUnchecked, but join the filter. One that the prediction of a filter with 5 scans excludes (tracking.innovation_max) is
// kImplausible and joins nothing; it ends a check, and the start has to be confirmed anew. A prediction less certain than the
// registration's gate is a rough start. Bounds: as Estimator::estimate.
TrackStep track_scan(const Mission& mission, Estimator& estimator, const RangeImage& scan, const TrackState& before);

// The same with a scan that was planned to look at a part (`part` != kWhole): it is compared with the other parts' before it joins.
TrackStep track_part(const Mission& mission, const Parts& parts, PartNumber part, Estimator& estimator, const RangeImage& scan,
                     const TrackState& before);

// At which part scan `scan_id`, whose middle is at t_us, is to look, as this step sees it; noted in the step's state. kWhole unless the
// mode looks at parts. `in_flight` is what the scan before it looks at. Bounds: as choose_part.
PartNumber next_part(const Mission& mission, const Parts& parts, PartNumber in_flight, std::uint32_t scan_id, TimeUs t_us, TrackStep& step);

// Where the rays of scan `scan_id`, whose middle is at t_us, are to leave its pattern, as this step sees it: nowhere unless the step gave a
// valid pose. Bounds: as aim_rays.
void aim_next(const Mission& mission, Estimator& estimator, const TrackStep& step, std::uint32_t scan_id, TimeUs t_us, AimedRays& rays);

// The word of one search. kContradicted: the start is refused (kContradicted), as if its frames were used up. kUndecided: another scan is
// searched, once: of a symmetric target no search is sure. Otherwise this scan confirms it if it is kUnchecked, or the next valid one does.
void end_check(const MissionParameters& parameters, CheckOutcome verdict, TrackStep& step);

// The check ends without an answer: kConfirmAnew. Nothing in other modes than verifying.
void confirm_anew(TrackStep& step);

// Counts a frame with or without a valid pose, and takes the step along the table.
void count_and_change(const MissionParameters& parameters, bool valid, TrackStep& step);

// One full-field scan. The registration says kOnlyBearing and no pose.
TrackStep bearing_scan(const Mission& mission, BearingFinder& finder, const RangeImage& scan, const TrackState& before);

// A frame without an estimate (kNoScan, kOverrun): the filter predicts to t_us, the mode coasts.
TrackStep track_without_scan(const Mission& mission, PoseReason reason, std::uint32_t scan_id, TimeUs t_us, const TrackState& before);

// A frame without a track: kNoTrack, the last pose with its own time, state unchanged.
TrackStep no_track(std::uint32_t scan_id, const TrackState& before);

}  // namespace lasso
