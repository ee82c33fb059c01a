// The acquisition task of the executive: plans a scan, collects it in one of two range images, and at the boundary says what it is worth.
// An image that was handed over stays as it is: swap_images() makes the next scan fill the other one.
#pragma once

#include <cstdint>

#include "fsw/core/time.hpp"
#include "fsw/core/voted.hpp"
#include "fsw/exec/scan_faults.hpp"
#include "fsw/geometry/se3.hpp"
#include "fsw/mission/image_slot.hpp"
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
  Span<const AimedRay> rays;  // that leave the pattern; not those of a full-field scan, nor for a sensor that cannot aim
};

struct ScanEnd {
  bool asked = false;   // a sensor was asked for the scan
  ScanVerdict verdict;  // of what it gave
};

constexpr std::uint8_t kOwnCalibration = 0xFF;

// The scans of one sensor since the component was made.
struct ScanTally {
  std::uint32_t scans = 0;               // that it was asked for
  std::uint32_t lost[kScanLosses] = {};  // of them, by ScanLoss; none under kNone
  ScanLoss last_loss = ScanLoss::kNone;
  std::uint8_t calibration = kOwnCalibration;  // of the image's, that the last one went by
};

class AcquisitionTask {
 public:
  // The sensors outlive the task; there is one at least.
  explicit AcquisitionTask(const SensorBank& sensors) : sensors_(sensors) {}

  // Plans scan `scan_id` on the aim and arms the sensor. A refusal is what finish() then says. `mission` is as this sensor's scans see it.
  // `plan` is written even then, as far as it was made.
  void start(SensorNumber sensor, const Mission& mission, const Aim& aim, std::uint32_t scan_id, TimeUs t_start_us, ScanPlan& plan);
  // Takes what the sensor has. Loop bound: kMaxRays / kMaxSamplesPerPoll polls.
  void poll(TimeUs now_us);
  // Ends the scan, which was planned so. Its image is filling(), until the next start().
  ScanEnd finish(const ScanPlan& plan);

  // To all sensors.
  void permit_laser(bool permitted);
  // Which of the image's calibrations of the sensor, below kMaxSensors, its scans go by from the next one on. Until this says otherwise:
  // the first.
  void choose_calibration(SensorNumber sensor, std::uint8_t index);
  // Of all sensors, for an image that comes back; 0: the first each.
  std::uint32_t choices() const;
  void set_choices(std::uint32_t choices) { choices_.set(choices); }
  // Before a scan of this sensor: what the image in this slot says of its optics, read anew each time, as the image is scrubbed and
  // repaired. A record that has decayed since it was checked is left until it is repaired: the sensor keeps what it has.
  void calibrate(SensorNumber sensor, const ImageSlot& image);

  const RangeImage& filling() const { return images_[filling_]; }
  std::size_t sensors() const { return sensors_.size(); }
  // Of one of the sensors.
  const ScanTally& tally(SensorNumber sensor) const { return Span<const ScanTally>(tallies_)[sensor]; }
  SensorCounters counters(SensorNumber sensor) const { return sensors_[sensor]->counters(); }
  // The next scan fills the other image: the present one has been handed over.
  void swap_images() { filling_ = 1 - filling_; }

 private:
  void keep(Span<const AimedRay> rays);
  std::uint8_t choice(SensorNumber sensor) const { return static_cast<std::uint8_t>(choices() >> 8U * sensor); }
  ScanLoss doubt(const ScanPlan& plan);
  void note(ScanLoss loss);

  SensorBank sensors_;
  SensorNumber sensor_ = 0;  // of the scan under way
  bool asked_ = false;       // for it
  Acquisition acquisition_;
  RangeImage images_[2];
  AimedRays aimed_;  // of the scan under way
  ScanTally tallies_[kMaxSensors];
  ScanTrace traces_[kMaxSensors];    // of the last scan each that could be estimated from
  Voted<std::uint32_t> choices_{0};  // of calibrations, a byte a sensor
  std::uint32_t filling_ = 0;
};

}  // namespace lasso
