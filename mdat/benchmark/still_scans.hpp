// Single scans of a body at rest, from any side, as its mission's sensor takes them.
#pragma once

#include <memory>

#include "fsw/mission/mission.hpp"
#include "fsw/sense/range_image.hpp"
#include "hal_sim/random.hpp"
#include "mdat/benchmark/subject.hpp"

namespace lasso::mdat {

// Who looks at a body draws from a stream of its own: the first three are those of make bodies (docs/bodies.md).
enum class ScanStream : std::uint64_t { kStarts = 1, kSearches = 2, kChanges = 3, kBenchmark = 4 };

class StillScans {
 public:
  // What is scanned may be another surface than the model's. Keeps references.
  StillScans(const Subject& subject, ScanStream stream);

  // Any attitude, one to twice the nearest range, up to 2 % of it beside the boresight.
  Pose draw_pose();
  // The pose turned by `turn_rad` about an axis through the body's middle, and moved by `shift_m`, both in a random direction.
  Pose draw_start(const Pose& T_sensor_target, double turn_rad, double shift_m);
  // As planned for the pose `expected`, one period of the mission after the scan before. Valid until the next one.
  const RangeImage& scan(const sim::RayCaster& surface, const Pose& T_sensor_target, const Pose& expected);

  const Mission& mission() const { return image_->mission(); }
  sim::Random& random() { return random_; }

 private:
  Vec3 draw_direction();

  const Subject& subject_;
  sim::Random random_;
  Vec3 middle_m_;
  std::unique_ptr<LoadedImage> image_;
  std::unique_ptr<RangeImage> scan_ = std::make_unique<RangeImage>();
};

}  // namespace lasso::mdat
