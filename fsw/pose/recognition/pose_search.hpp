// Autonomous recognition: the target's pose from one scan, or a few, without any prior attitude. docs/decisions/search.md says why it is
// done like this.
//
// begin(), then for each scan add_scan() and advance() until it answers true; result() then says whether the pose is accepted, ambiguous
// (with its candidates) or rejected, and why. A further scan may join (joins()) where it is ambiguous, or to see how it turns: candidates
// are carried to it with the rate that their own poses show, nothing else is looked for there, and the scores of all scans are added. A
// target may turn by some 15 deg between two scans. All state is in the object and is forgotten by begin(); the workspace holds nothing
// between two calls.
//
// Work is done in steps and counted in units of some 75 PowerPC 603e instructions (work_units.hpp). advance() ends with the step that
// uses the budget up; no step takes more than kLargestStep. The first scan of 1024 rays takes some 1.2 million units, some 80 million
// instructions, in all, a later one some 0.6 million (docs/search.md): most hypotheses are looked at no longer than until others promise
// more. Once limits.work_max of them are used, four fifths where further scans may join the first, nothing more is refined: what was found
// so far is the result, as ambiguous. The best one's near-symmetries are measured while anything is left of them all.
#pragma once

#include "fsw/pose/recognition/acceptance.hpp"
#include "fsw/pose/recognition/hypothesis_list.hpp"
#include "fsw/pose/recognition/hypothesis_refinement.hpp"
#include "fsw/pose/recognition/robust_refinement.hpp"
#include "fsw/pose/recognition/search_limits.hpp"
#include "fsw/pose/recognition/search_result.hpp"
#include "fsw/pose/scan/work_units.hpp"

namespace lasso {

// At estimation.iterations_max 12: a registration on the whole subset, which is then weighed by regions and scored; or a hypothesis that
// is aligned from farther away, refined fast, scored, and weighed as it was aligned.
constexpr std::uint32_t kLargestRobustStep =
    look_work(kSubsetHits, 14) + regions_work(kSubsetHits, kRegions) + score_work(kSubsetHits, kSubsetMisses);
constexpr std::uint32_t kLargestFastRefine = distance_alignment_work(kFastRefinePoints) + ray_alignment_work(kFastRefinePoints) +
                                             look_work(kFastRefinePoints, 14) + score_work(kSubsetHits, kSubsetMisses) +
                                             weigh_work(kFastRefinePoints);
constexpr std::uint32_t kLargestStep = kLargestRobustStep > kLargestFastRefine ? kLargestRobustStep : kLargestFastRefine;

class PoseSearch {
 public:
  enum class Stage : std::uint8_t {
    kIdle,
    kSubset,
    kViewMatching,
    kAlignOnDistances,
    kAlignOnRays,
    kFastRefine,
    kRefine,
    kLineSearch,
    kRobustRefine,
    kSymmetryTest,
    kAcceptance
  };

  void begin(const SearchLimits& limits);

  // The quarter turns of a pose at the time of the first scan are hypotheses, too, and it itself. Between begin() and the first scan.
  void suspect(const Pose& T_sensor_target);

  // May a further scan join those so far, once result() stands? Not beyond limits.scans_max, after a rejection (nothing is worth carrying
  // on with), or where it is ambiguous and too little of the work is left. What begins anew then is another search.
  bool joins() const;

  // Takes what it needs of the scan. kBusy while the last one is being worked on; kBadOrder where it does not join(), or is not later than
  // the last one; kNoData for a scan without returns. Where it is refused nothing changes. Its work is part of the next
  // advance()'s.
  Status add_scan(const Mission& mission, const RangeImage& scan, Workspace& workspace);

  // Works until the budget is used up; true when the result for the scans so far stands.
  bool advance(const Mission& mission, Workspace& workspace, std::uint32_t budget);

  // Does the best pose, of a search that is done, explain the last scan better than this one, T_sensor_target at the scan's time, as the
  // same returns register it (one look, unless that leads more than 5 deg away)? By limits.ratio_min where they are more than 5 deg apart,
  // at all where it is accepted and they are more than 15 deg apart: the search is to suspect() the pose, so that it was a candidate.
  bool contradicts(const Mission& mission, const Pose& T_sensor_target, Workspace& workspace) const;

  // Has a search that is done accepted this pose, T_sensor_target at the scan's time, to within 5 deg?
  bool agrees(const Pose& T_sensor_target) const;

  // The poses that a search that is done was judged by, the best first: what pose i is compared with that one by. False where it does not
  // compete, within 15 deg of it.
  std::size_t poses() const { return tracks_.size(); }
  bool find_competitor(std::size_t i, Competitor& competitor) const;

  bool busy() const { return stage_ != Stage::kIdle; }
  Stage stage() const { return stage_; }  // of the next step
  const SearchResult& result() const { return result_; }

 private:
  // A pose in each scan.
  struct Track {
    Pose T_target_sensor[kMaxSearchScans];
    HypothesisScore scores[kMaxSearchScans];
    HypothesisScore total;
    Pose start;                     // in the last scan
    bool fast_refined = false;      // in the last scan
    bool refined = false;           // the same
    bool robustly_refined = false;  // in the last scan
    double cost = kAnyScore;        // of the pose in the last scan, once it is: of its RegionCosts
    double whole_cost = kAnyScore;
    double explained_cost = kAnyScore;  // the same
    Mat6 H = Mat6::Zero();              // information of the registration in the last scan, target axes
  };
  // The line that is searched for a hypothesis: from its pose along its least certain direction.
  struct Line {
    Pose from;
    Vec6 direction = Vec6::Zero();
    Pose best;
    HypothesisScore fit;
    int next = 0;    // place to look at, in steps
    int middle = 0;  // the best of every other one
    bool begun = false;
  };
  static constexpr std::size_t kFinalists = 6;
  static constexpr std::size_t kCarried = 6;
  static constexpr std::size_t kLineSearched = 3;
  static constexpr std::size_t kTracks = kCarried + (kMaxSymmetries > kFinalists ? kMaxSymmetries : kFinalists);

  std::uint32_t step(const Mission& mission, Workspace& workspace);
  void carry_over();
  std::uint32_t gather_subset(const Mission& mission);
  std::uint32_t match_views(const Mission& mission);
  Pose hypothesis(const Mission& mission, std::size_t i) const;
  std::size_t hypotheses() const { return coarse_.short_list().size() + (suspects_ ? kQuarterTurns : 0); }
  std::uint32_t align_on_distances_next(const Mission& mission, Workspace& workspace);
  std::uint32_t align_on_rays_next(const Mission& mission, Workspace& workspace);
  double fast_refine_limit() const;
  std::uint32_t refine_fast_near(const Mission& mission, Track& track, Workspace& workspace);
  std::uint32_t refine_fast_afar(const Mission& mission, Track& track, Workspace& workspace);
  std::uint32_t refine_fast_next(const Mission& mission, Workspace& workspace);
  std::uint32_t refine_next(const Mission& mission, Workspace& workspace);
  std::uint32_t search_line_next(const Mission& mission);
  std::uint32_t refine_robustly_next(const Mission& mission, Workspace& workspace);
  std::uint32_t test_symmetry_next(const Mission& mission, Workspace& workspace);
  std::uint32_t image_before(const Mission& mission, const NearSymmetry<FlightNumber>& symmetry, Track& symmetric) const;
  std::uint32_t end_symmetry_test();
  bool is_new(const Pose& T_target_sensor, const HypothesisScore& fit) const;
  std::uint32_t conclude();
  void end_refining(const Mission& mission);
  std::uint32_t begin_line(const Mission& mission);
  std::uint32_t look_along(const Mission& mission, const ScanSubset& subset);
  void end_line();
  bool is_apart(const Pose& T_target_sensor, double cos_half_angle) const;
  const AlignedHypothesis* best_aligned(double cos_half_angle) const;
  void choose_finalists();
  void add_symmetric_hypotheses(const Mission& mission);
  void add_track(const Pose& T_target_sensor, const HypothesisScore& fit);
  void take(const RefinedHypothesis& refined, Track& track) const;
  const RobustSettings& robust_settings_of(std::size_t track) const;
  std::uint32_t take_robust(const Mission& mission, Track& track) const;
  void sum_up(Track& track) const;
  double best_score() const;
  bool is_hopeless(const Track& track) const;
  bool is_competitor(const Track& track) const;
  bool may_work();
  bool may_work_up_to(double share);
  bool is_next_searched() const { return next_ < tracks_.size() && next_ < kLineSearched; }
  bool is_distinct(const Track& track) const;
  bool outscores_all() const;
  void inherit(const Track& other, Track& symmetric) const;
  void prune();
  Pose carried(const Track& track) const;
  Twist rates_of(const Track& track, std::size_t scan) const;
  bool describe_covariance(const Track& best);
  void describe_candidates();
  void judge(bool registered);
  std::size_t last() const { return scans_ - 1; }

  SearchLimits limits_;
  Stage stage_ = Stage::kIdle;
  std::size_t scans_ = 0;
  bool suspects_ = false;
  Pose suspect_;                   // T_target_sensor
  std::size_t next_ = 0;           // of the stage's items
  bool symmetries_ = false;        // are there: of the first scan's best pose
  bool symmetry_tested_ = false;   // those of the best pose as it stands have been looked for
  bool working_ = false;           // on the next track
  bool unfinished_ = false;        // something that was worth it was not worked on
  std::uint32_t adding_work_ = 0;  // of adding it, until a slice has paid for it
  ScanSubsetMaker maker_;
  ViewMatcher coarse_;
  ScanSubset subsets_[kMaxSearchScans];
  HypothesisList aligned_;
  FixedVector<Track, kTracks> tracks_;
  HypothesisRefiner refiner_;
  Line line_;
  RobustRefiner robust_refiner_;
  SearchResult result_;
};

}  // namespace lasso
