// What a search says of the scans that it was given.
#pragma once

#include "fsw/core/fixed_vector.hpp"
#include "fsw/core/time.hpp"
#include "fsw/geometry/se3.hpp"

namespace lasso {

constexpr std::size_t kMaxSearchCandidates = 6;  // in the result

enum class SearchOutcome : std::uint8_t { kNone, kAccepted, kAmbiguous, kRejected };

enum class SearchReason : std::uint8_t {
  kNotDone,        // idle, or still at work
  kDistinct,       // accepted: the best pose explains the scans, and no other does
  kCompetitor,     // ambiguous: another pose explains them nearly as well
  kTooFewReturns,  // rejected
  kUnexplained,    // rejected: the best pose leaves too much unexplained
  kNotRegistered,  // rejected: the registration of the best pose failed
  kUnfinished,     // ambiguous: the scan's work was used up before every other pose was excluded
};
const char* to_string(SearchOutcome outcome);
const char* to_string(SearchReason reason);

struct SearchCandidate {
  Pose T_sensor_target;
  double disagreement = 1;
  double score = 0;  // smaller is better
};

struct SearchResult {
  SearchOutcome outcome = SearchOutcome::kNone;
  SearchReason reason = SearchReason::kNotDone;
  std::uint32_t scan_id = 0;       // the last scan's
  TimeUs t_us = 0;                 // its reference time, at which all poses are stated
  Pose T_sensor_target;            // the best candidate's, whatever the outcome
  Twist rates;                     // from its poses in the last two scans; zero from a single one
  Mat6 covariance = Mat6::Zero();  // of the pose: (rotation in sensor axes [rad], translation [m])
  double disagreement = 1;
  double ratio = 0;  // (score of the best candidate more than 15 deg off + 0.01) / (score of the best + 0.01); 0 without one
  std::uint32_t scans = 0;
  std::uint32_t returns = 0;                                      // of all scans that were looked at
  std::uint32_t work = 0;                                         // in units (work_units.hpp), all scans
  FixedVector<SearchCandidate, kMaxSearchCandidates> candidates;  // the best, and those that the ratio does not exclude
};

}  // namespace lasso
