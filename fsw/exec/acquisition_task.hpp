// The acquisition task of the executive: plans a scan, collects it in one of two range images, and at the boundary says what it is worth.
// An image that was handed over stays as it is: swap_images() makes the next scan fill the other one.
#pragma once

#include <cstdint>

#include "fsw/core/time.hpp"
#include "fsw/geometry/se3.hpp"
#include "fsw/mission/mission.hpp"
#include "fsw/sense/acquisition.hpp"
#include "fsw/sense/range_image.hpp"
#include "fsw/sense/scan_plan.hpp"
#include "fsw/sense/sensor.hpp"

namespace lasso {

// Where the target is expected, and one sigma of how far off that may be; its attitude may be unknown, or it may be anywhere in the field
// of view.
struct Aim {
  Pose T_sensor_target;
  double uncertainty_m = 0;
  bool any_attitude = false;  // T_sensor_target says where the model's centre is, no more
  bool full_field = false;
  Span<const AimedRay> rays;  // that leave the pattern; not those of a full-field scan
};

class AcquisitionTask {
 public:
  explicit AcquisitionTask(Sensor& sensor) : sensor_(sensor) {}

  // Plans scan `scan_id` on the aim and arms the sensor. A refusal is what finish() then says. `plan` is written even then, as
  // far as it was made.
  void start(const Mission& mission, const Aim& aim, std::uint32_t scan_id, TimeUs t_start_us, ScanPlan& plan);
  // Takes what the sensor has. Loop bound: kMaxRays / kMaxSamplesPerPoll polls.
  void poll(TimeUs now_us);
  // Ends the scan: true when its image is fit for an estimate. The image is filling(), until the next start().
  bool finish();

  const RangeImage& filling() const { return images_[filling_]; }
  // The next scan fills the other image: the present one has been handed over.
  void swap_images() { filling_ = 1 - filling_; }

 private:
  void keep(Span<const AimedRay> rays);

  Sensor& sensor_;
  Acquisition acquisition_;
  RangeImage images_[2];
  AimedRays aimed_;  // of the scan under way
  std::uint32_t filling_ = 0;
};

}  // namespace lasso
