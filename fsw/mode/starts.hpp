// The sources of a pose to start from: handed over by a long-range system, from a navigation system's stream, known a priori (mission
// file), sent by the ground, or recognised (fsw/mode/searcher.hpp). Each is validated, and moved to now; a scan has to confirm it before it
// is tracked.
#pragma once

#include <cstdint>

#include "fsw/core/time.hpp"
#include "fsw/geometry/se3.hpp"
#include "fsw/mission/mission.hpp"
#include "fsw/pose/tracking/bearing.hpp"
#include "fsw/pose/tracking/pose_filter.hpp"

namespace lasso {

enum class InitialPoseSource : std::uint8_t { kNone = 0, kHandover = 1, kNavigation = 2, kApriori = 3, kUplink = 4, kSearch = 5 };
constexpr std::size_t kInitialPoseSources = 6;  // kNone included

// T_sensor_target and its rates at t_us, with the covariance of (rotation in sensor axes [rad], translation of the origin [m]).
struct StartOffer {
  TimeUs t_us = 0;
  Pose T_sensor_target;
  Twist rates;
  Mat6 covariance = Mat6::Zero();
};

enum class StartRefusal : std::uint8_t {
  kNone = 0,
  kNotBegun = 1,       // the component has not begun
  kNoSuchSource = 2,   // kNone, or a number that is none
  kNotFinite = 3,      // a value is not a number
  kNotUnit = 4,        // the quaternion is not of unit length
  kBadCovariance = 5,  // not symmetric, not of variances and correlations, or so wide that it tells nothing
  kFromFuture = 6,     // stated later than the frame in which it would start
  kTooOld = 7,         // stated longer ago than start.age_max_s; or before the clock jumped, or another target's image became active
  kTooFast = 8,        // its rates since then have no meaning, or move the target too far within a scan
  kOutOfReach = 9,     // not in front of the sensor, or wholly outside the ranges that it measures
  kNotAtBearing = 10,  // not where the bearing sees the target
  kNotConfirmed = 11,  // no scan confirmed it within start.frames
  kNotFromHere = 12,   // the table of modes has no start from the present one
  kContradicted = 13,  // a search of the scan that confirmed it found another pose (start.check)
};
const char* to_string(InitialPoseSource source);  // never null
const char* to_string(StartRefusal refusal);      // never null

// What the filter starts from, and moves by, in this mission.
FilterStart filter_start(const MissionParameters& parameters, const StartOffer& offer);
FilterNoise filter_noise(const MissionParameters& parameters);

// Does the mission's order of sources name this one?
bool is_in_order(const MissionParameters& parameters, InitialPoseSource source);

// Believed as tracking.start_sigma_m and _deg say.
StartOffer rough_offer(const MissionParameters& parameters, const Pose& T_sensor_target, const Twist& rates, TimeUs t_us);

// kNone: `filter` is started from the offer and predicted to now_us. Otherwise why not, and `filter` is as it was. `bearing` counts unless
// it is older than bearing.memory_s.
StartRefusal start_from(const Mission& mission, const StartOffer& offer, TimeUs now_us, const BearingState& bearing, FilterState& filter);

// The last offer of each source that has not been tried. Search needs no offer: it is untried until its turn comes, and again once a track
// holds; where all else has been tried, its turn comes again.
class InitialPoseSources {
 public:
  void put(InitialPoseSource source, const StartOffer& offer);
  // The offer of the source; it counts as tried from now on.
  const StartOffer& take(InitialPoseSource source);
  // The first source in the mission's order that has not been tried; kNone if there is none. Search only where `may_search`.
  InitialPoseSource next(const MissionParameters& parameters, bool may_search) const;

 private:
  StartOffer offers_[kInitialPoseSources];
  bool fresh_[kInitialPoseSources] = {false, false, false, false, false, true};
};

}  // namespace lasso
