// Registers scans one by one, each from a start of its own that may be rough. What a single scan shows is also looked for without the
// start, as a flight does before it believes one: a pose that explains the scan as it stands may be a wrong one beside the right one.
#pragma once

#include <memory>

#include "fsw/geometry/portable_math.hpp"
#include "fsw/pose/estimator/estimator.hpp"
#include "fsw/pose/recognition/pose_search.hpp"

namespace lasso::mdat {

// How far from its start a pose is looked for: what a rough start may be off (StartPoint::wide).
constexpr double kRoughStart_rad = 20 * kRadPerDeg;
constexpr double kRoughStartShare = 0.25;  // of the target's size

class SingleScans {
 public:
  explicit SingleScans(const Mission& mission) : mission_(mission) {}

  // The registration from the start. With start.check the scan is searched as well: of the registrations from the start and from the
  // search's candidates within the reach of a rough start, the one that explains the scan best is given. kFarFromStart where the
  // only one lies beyond that reach. kContradicted where the search accepts another pose: the start is farther off than a rough one may be.
  // What a search cannot tell apart (the images of a symmetric target), the start does.
  Registration estimate(const RangeImage& image, const StartPoint& start);

 private:
  void search(const RangeImage& image, const Pose& T_sensor_target);
  bool is_within_reach(const Pose& T_sensor_target, const StartPoint& start) const;

  const Mission& mission_;
  std::unique_ptr<Estimator> estimator_ = std::make_unique<Estimator>();
  std::unique_ptr<PoseSearch> search_ = std::make_unique<PoseSearch>();
};

}  // namespace lasso::mdat
