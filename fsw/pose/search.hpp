// Autonomous recognition: the target's pose from one scan, or a few, without any prior attitude. docs/decisions/search.md says why it is
// done like this.
//
// begin(), then for each scan add_scan() and advance() until it answers true; result() then says whether the pose is accepted, ambiguous
// (with its candidates) or rejected, and why. A further scan may be added, up to limits.scans_max, where it is not accepted, or to see how
// it turns: the scores of all scans are added, and candidates are carried from scan to scan with the rate that their own poses show. A
// target may turn by some 15 deg between two scans. All state is in the object and is forgotten by begin(); the workspace holds nothing
// between two calls.
//
// Work is done in steps and counted in look-ups of some 90 PowerPC 603e instructions (60 to 125, by the stage). advance() ends with the
// step that uses the budget up; no step takes more than kLargestStep, few more than 180,000. A scan of 1024 rays takes some 4.5 million
// look-ups, 380 million instructions, in all (docs/search.md).
#pragma once

#include "fsw/pose/coarse.hpp"
#include "fsw/pose/fit.hpp"

namespace lasso {

constexpr std::size_t kMaxSearchScans = 3;
constexpr std::size_t kMaxSearchCandidates = 6;  // in the result
constexpr std::uint32_t kLargestStep = 300'000;  // look-ups, at estimation.iterations_max 12

struct SearchLimits {
  double hits_min = 80;  // returns looked at
  double disagreement_max = 0.20;
  double ratio_min = 1.3;  // score of the best distinct competitor over that of the pose
  std::uint32_t scans_max = kMaxSearchScans;
};

enum class SearchOutcome : std::uint8_t { kNone, kAccepted, kAmbiguous, kRejected };

enum class SearchReason : std::uint8_t {
  kNotDone,        // idle, or still at work
  kDistinct,       // accepted: the best pose explains the scans, and no other does
  kCompetitor,     // ambiguous: another pose explains them nearly as well
  kTooFewReturns,  // rejected
  kUnexplained,    // rejected: the best pose leaves too much unexplained
  kNotRegistered,  // rejected: the registration of the best pose failed
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
  std::uint32_t work = 0;                                         // look-ups, all scans
  FixedVector<SearchCandidate, kMaxSearchCandidates> candidates;  // the best, and those that the ratio does not exclude
};

class Search {
 public:
  void begin(const SearchLimits& limits);

  // Takes what it needs of the scan. kBusy while the last one is being worked on; kBadOrder beyond limits.scans_max, or where the scan is
  // not later than the last one; kNoData for a scan without returns. Where it is refused nothing changes.
  Status add_scan(const Mission& mission, const RangeImage& scan, Workspace& workspace);

  // Works until the budget is used up; true when the result for the scans so far stands.
  bool advance(const Mission& mission, Workspace& workspace, std::uint32_t budget);

  bool busy() const { return stage_ != Stage::kIdle; }
  const SearchResult& result() const { return result_; }

 private:
  enum class Stage : std::uint8_t { kIdle, kEvidence, kCoarse, kPull, kSettle, kTwins, kExplore, kRecall, kVerdict };
  struct Pulled {
    Pose T_target_sensor;
    double score = 0;
  };
  // A pose in each scan, as far as known.
  struct Track {
    Pose T_target_sensor[kMaxSearchScans];
    Fit fits[kMaxSearchScans];
    bool known[kMaxSearchScans] = {};
    Fit total;
    Mat6 H = Mat6::Zero();  // information of the registration in the last scan, target axes
  };
  // The line on which a track is explored: from its pose along its least certain direction.
  struct Line {
    Pose from;
    Vec6 direction = Vec6::Zero();
    Pose best;
    Fit fit;
    int next = 0;  // place to look at, in steps
    bool begun = false;
  };
  static constexpr std::size_t kFinalists = 6;
  static constexpr std::size_t kCarried = 6;
  static constexpr std::size_t kExplored = 3;
  static constexpr std::size_t kTracks = kCarried + (kMaxSymmetries > kFinalists ? kMaxSymmetries : kFinalists);

  std::uint32_t step(const Mission& mission, Workspace& workspace);
  std::uint32_t pull(const Mission& mission, Workspace& workspace);
  std::uint32_t settle_next(const Mission& mission, Workspace& workspace);
  std::uint32_t explore_next(const Mission& mission);
  void begin_line(const Mission& mission);
  void look_along(const Mission& mission, const Evidence& evidence);
  void end_line();
  std::uint32_t recall_next(const Mission& mission, Workspace& workspace);
  std::uint32_t settle(const Mission& mission, std::size_t scan, const Pose& start, Track& track, Workspace& workspace) const;
  std::uint32_t conclude();
  bool is_apart(const Pose& T_target_sensor, double cos_half_angle) const;
  const Pulled* best_pulled(double cos_half_angle) const;
  void choose_finalists();
  void add_twins(const Mission& mission);
  void add_track(const Pose& T_target_sensor);
  void prune();
  Pose carry(const Track& track, std::size_t from, std::size_t to, const Twist& rates) const;
  Twist rates_of(const Track& track, std::size_t scan) const;
  bool describe_covariance(const Track& best);
  void describe_candidates();
  void judge(bool registered);
  std::size_t last() const { return scans_ - 1; }

  SearchLimits limits_;
  Stage stage_ = Stage::kIdle;
  std::size_t scans_ = 0;
  std::size_t next_ = 0;   // of the stage's items
  std::size_t first_ = 0;  // track of the last scan's own finalists
  EvidenceMaker maker_;
  CoarseSearch coarse_;
  Evidence evidence_[kMaxSearchScans];
  FixedVector<Pulled, kShortList> pulled_;
  FixedVector<Track, kTracks> tracks_;
  Line line_;
  SearchResult result_;
};

}  // namespace lasso
