// The mode searching: the pose of a target whose bearing is known is looked for at any attitude, some work a frame. And the check of a
// start: the same search of the scan that would confirm it.
#pragma once

#include "fsw/mode/tracker.hpp"
#include "fsw/pose/recognition/pose_search.hpp"

namespace lasso {

// Units of work that a frame in mode searching takes on: search.slice, in fixed point a share of it.
std::uint32_t frame_work(const MissionParameters& parameters);

// What an accepted search offers as a start: its covariance, and what it may be off besides (1 deg and 0.75 % of the model's size, 1
// sigma).
StartOffer offer_of(const Mission& mission, const SearchResult& result);

class Searcher {
 public:
  // Other limits than those of a flight are for tests.
  explicit Searcher(const SearchLimits& limits = SearchLimits()) : limits_(limits) {}

  // One frame in mode searching. `step` is the bearing's (bearing_scan, track_without_scan) and is completed: search, registration
  // (kSearching), state and event. `scan` is null where it was lost; it is taken where none is being worked on and it was aimed by a
  // bearing; while one is, the first scan 2 s later waits for its turn. A new search begins when step.after.searches says so, and with a
  // scan that does not join the last one (PoseSearch::joins). At most frame_work units, and those of the step that uses them up
  // (kLargestStep). A pose that is accepted is offered as a start: kStarting, or step.refusal says why not. One from a single scan since
  // which the target may have turned by 5 deg waits for another scan, which shows its rate. It is offered again where the frame that said
  // so came too late.
  void work(const Mission& mission, const RangeImage* scan, Workspace& workspace, TrackStep& step);

  // One frame of a check (state.check of `step`, which track_scan or track_without_scan gave). The frame that says so gives its scan; from
  // the next one on half of frame_work is done on it in each. The search suspects the pose (PoseSearch::suspect), and end_check is told
  // what it makes of it. A check whose scan is gone (its frame came too late) ends without an answer (confirm_anew): the next scan that
  // confirms the start begins another.
  void check(const Mission& mission, const RangeImage* scan, Workspace& workspace, TrackStep& step);

 private:
  bool takes_check(const Mission& mission, const RangeImage* scan, Workspace& workspace, const TrackState& state);
  CheckOutcome outcome_of(const Mission& mission, const Pose& T_sensor_target, Workspace& workspace) const;
  void begin(std::uint32_t number, bool checks);
  void receive(const Mission& mission, const RangeImage& scan, Workspace& workspace);
  void keep(const RangeImage& scan);
  void take(const Mission& mission, const RangeImage& scan, Workspace& workspace);
  bool offer(const Mission& mission, TrackStep& step);
  bool stale(const MissionParameters& parameters, TimeUs now_us) const;
  bool found(const MissionParameters& parameters, TimeUs now_us) const {
    return !search_.busy() && search_.result().outcome == SearchOutcome::kAccepted && !stale(parameters, now_us);
  }

  SearchLimits limits_;
  PoseSearch search_;
  RangeImage next_;  // where one waits
  bool waiting_ = false;
  TimeUs taken_us_ = 0;       // time of the last scan that was taken
  std::uint32_t number_ = 0;  // of the search, in TrackState::searches
  bool checks_ = false;       // a start; such a search is none of mode searching's
};

}  // namespace lasso
