// A large target close by, of which no scan sees the whole: scans look at parts of it in turn, each with a model of its own. A part's
// pose is stated in the target's frame and joins the one filter of the track; the last poses of the parts are compared with each other,
// and the inconsistent one is left out for 25 scans, as is a part that gave no pose. See docs/decisions/parts.md.
//
// Parts are numbered from 1, in the image's order; 0 is the target as a whole.
#pragma once

#include <cstdint>

#include "fsw/mission/mission.hpp"
#include "fsw/pose/estimator/estimator.hpp"
#include "fsw/pose/tracking/pose_filter.hpp"

namespace lasso {

using PartNumber = std::uint8_t;
constexpr PartNumber kWhole = 0;

// A symmetric matrix, its upper triangle by rows: the state of a track is copied from step to step.
struct PackedCovariance {
  float terms[21] = {};
};
PackedCovariance pack(const Mat6& covariance);
Mat6 unpack(const PackedCovariance& packed);

// What is remembered of a part.
struct PartRecord {
  bool measured = false;            // the following four hold
  std::uint32_t scan_id = 0;        // of its last valid pose
  Vec6 off = Vec6::Zero();          // of the target by that pose from the filter's prediction, as pose_difference()
  PackedCovariance covariance;      // of both
  bool reported = false;            // as inconsistent: it rests for that
  std::uint32_t rests_until = 0;    // first scan that may look at it again
  std::uint32_t last_asked_id = 0;  // last scan that was planned to look at it
};

struct PartsState {
  PartRecord of[kMaxParts];
};

// What the parts had to do with one scan.
struct PartsReport {
  PartNumber scanned = kWhole;
  PartNumber inconsistent = kWhole;  // that disagreed with the others and rests from now on; kWhole: none
  double inconsistency_sigmas = 0;   // how far from the one that it is farthest from
};

// Does the part rest when scan `scan_id` is planned?
bool rests(const PartRecord& record, std::uint32_t scan_id);

// Covariance of the part's pose by the filter's: rotation in sensor axes, translation of the part's origin.
Mat6 part_covariance(const Part& part, const FilterState& filter);

// Registers a scan of the part from the filter's prediction for its reference time; the result is that of the target's frame. Bounds: as
// Estimator::estimate.
Registration register_part(const Mission& mission, const Part& part, Estimator& estimator, const RangeImage& scan,
                           const FilterState& predicted);

// Notes the part's registration, valid or not, and compares it with the last ones of the other parts. kPartDisagrees if the scanned part
// is inconsistent; otherwise the registration's own reason. It is the part that disagrees with the most others; among equals the
// one of lower priority, then the scanned one. A part that rested because it disagreed with nobody but the inconsistent one rests no
// longer. Two poses disagree where their difference exceeds six sigmas; poses older than kFreshScans scans do not
// count. Loop bound: pairs of parts.
constexpr std::uint32_t kFreshScans = 25;
PoseReason compare_parts(const Parts& parts, const Registration& registration, const FilterState& predicted, PartsState& state,
                         PartsReport& report);

// The track refuses the pose that was compared last: it speaks of no other part, and the part rests.
void refuse_part(std::uint32_t scan_id, PartRecord& record);

// A scan that is to be planned.
struct NextScan {
  std::uint32_t scan_id = 0;
  FilterState predicted;          // for its middle
  PartNumber in_flight = kWhole;  // at which the scan before it looks, whose result is not there yet
};

// The part that the scan is to look at; kWhole if none can be seen. Seen is a part that does not rest, that the prediction places within
// its registration's gate (estimation.gate_first_m of its image), whose centre lies within its range band, that has the sensor in its view
// cone, and that kLeastMet of the rays over its outline in the field of view meet. Chosen is the one that, weighted by its priority, takes
// the largest share off the variance of the filter's least certain direction (rotation at the target's radius), with what the scan in
// flight will tell; one that was not asked for kLongestWait scans comes before, the longest first. Among equals the first. So no part that
// is seen waits for more than kLongestWait + kMaxParts scans. Bounds: kForecastRays walks a part.
constexpr std::uint32_t kLongestWait = 12;
constexpr int kLeastMet = 16;
PartNumber choose_part(const Mission& mission, const Parts& parts, const NextScan& next, PartsState& state);

}  // namespace lasso
