// Single scans of a body at rest, from any side, as its mission's sensor takes them.
#pragma once

#include <memory>

#include "fsw/mission/mission.hpp"
#include "fsw/sense/range_image.hpp"
#include "ft/bodies/subject.hpp"
#include "hal_sim/random.hpp"

namespace lasso::bodies {

class StillScans {
 public:
  // What is scanned may be another surface than the model's. Keeps references.
  StillScans(const Subject& subject, std::uint64_t stream);

  // Any attitude, one to twice the nearest range, up to 2 % of it beside the boresight.
  Pose draw_pose();
  // The pose turned by `turn_rad` about an axis through the body's middle, and moved by `shift_m`, both in a random direction.
  Pose draw_start(const Pose& T_sensor_target, double turn_rad, double shift_m);
  // As planned for the pose `expected`. Valid until the next one.
  const RangeImage& scan(const sim::RayCaster& surface, const Pose& T_sensor_target, const Pose& expected);

  const Mission& mission() const { return image_->mission(); }
  sim::Random& random() { return random_; }

 private:
  Vec3 draw_direction();

  const Subject& subject_;
  sim::Random random_;
  Vec3 middle_m_;
  std::unique_ptr<mdat::LoadedImage> image_;
  std::unique_ptr<RangeImage> scan_ = std::make_unique<RangeImage>();
};

}  // namespace lasso::bodies
