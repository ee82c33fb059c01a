#include "fsw/exec/acquisition_task.hpp"

#include "fsw/sense/planner.hpp"

namespace lasso {
namespace {

constexpr std::size_t kMaxPolls = kMaxRays / kMaxSamplesPerPoll;

// The ball that the model lies in at any attitude, by the ends of its axes.
Status plan_around(const Mission& mission, const Aim& aim, ScanPlan& plan) {
  HullPoint ends[6] = {};
  for (std::size_t i = 0; i < 6; ++i) ends[i].p[i / 2] = FlightNumber::to_length(i % 2 == 0 ? mission.radius_m : -mission.radius_m);
  const TargetOutline ball{Span<const HullPoint>(ends), Vec3::Zero(), aim.uncertainty_m};
  return plan_scan(mission.parameters, ball, aim.T_sensor_target, plan.scan_id, plan);
}

Status plan_aimed(const Mission& mission, const Aim& aim, ScanPlan& plan) {
  if (aim.any_attitude) return plan_around(mission, aim, plan);
  const TargetOutline outline{mission.hull, mission.center_m, aim.uncertainty_m};
  return plan_scan(mission.parameters, outline, aim.T_sensor_target, plan.scan_id, plan);
}

}  // namespace

void AcquisitionTask::start(SensorNumber sensor, const Mission& mission, const Aim& aim, std::uint32_t scan_id, TimeUs t_start_us,
                            ScanPlan& plan) {
  plan.scan_id = scan_id;
  sensor_ = sensor;
  const Status status = aim.full_field ? plan_full_field(mission.parameters, scan_id, plan) : plan_aimed(mission, aim, plan);
  if (status != Status::kOk) return;
  aimed_.clear();
  if (!aim.full_field && sensors_[sensor]->can_aim()) keep(aim.rays);
  plan.aimed = aimed_.span();
  asked_ = true;
  // A refusal comes back as the verdict of finish().
  static_cast<void>(acquisition_.start(*sensors_[sensor_], plan, t_start_us, images_[filling_]));
}

void AcquisitionTask::keep(Span<const AimedRay> rays) {
  for (const AimedRay& ray : rays) invariant(aimed_.push_back(ray), "more aimed rays than a scan can have");
}

void AcquisitionTask::poll(TimeUs now_us) {
  RangeImage& image = images_[filling_];
  for (std::size_t i = 0; i < kMaxPolls && acquisition_.under_way(); ++i) {
    const std::size_t before = image.samples.size();
    acquisition_.step(*sensors_[sensor_], now_us, image);
    if (image.samples.size() < before + kMaxSamplesPerPoll) return;  // the sensor has no more
  }
}

void AcquisitionTask::permit_laser(bool permitted) {
  for (Sensor* sensor : sensors_) sensor->permit_laser(permitted);
}

void AcquisitionTask::choose_calibration(SensorNumber sensor, std::uint8_t index) {
  const std::uint32_t place = 8U * sensor;
  choices_.set((choices() & ~(0xFFU << place)) | std::uint32_t{index} << place);
}

// Where no two copies agree: the first ones.
std::uint32_t AcquisitionTask::choices() const {
  std::uint32_t choices = 0;
  static_cast<void>(choices_.get(choices));
  return choices;
}

void AcquisitionTask::calibrate(SensorNumber sensor, const ImageSlot& image) {
  choices_.set(choices());  // all copies say again what two of them do
  TriangulationCalibration calibration;
  const std::uint8_t index = choice(sensor);
  const bool found = image.find_calibration(sensor, index, calibration);
  if (found && validate(calibration) != Status::kOk) return;
  sensors_[sensor]->use_calibration(found ? &calibration : nullptr);
  Span<ScanTally>(tallies_)[sensor].calibration = found ? index : kOwnCalibration;
}

ScanEnd AcquisitionTask::finish(const ScanPlan& plan) {
  ScanEnd end{asked_, acquisition_.finish(*sensors_[sensor_], images_[filling_])};
  if (end.verdict.usable) end.verdict.loss = doubt(plan);
  if (end.verdict.loss != ScanLoss::kNone) end.verdict.usable = false;
  if (asked_) note(end.verdict.loss);
  asked_ = false;
  return end;
}

// Mirrors that stand still, and a scan that is given again, leave an image that a pose could be read into. Of a sensor that cannot aim
// neither can be told: an empty field looks the same whatever the plan.
ScanLoss AcquisitionTask::doubt(const ScanPlan& plan) {
  if (!sensors_[sensor_]->can_aim()) return ScanLoss::kNone;
  const RangeImage& image = images_[filling_];
  if (mirrors_stuck(plan, image)) return ScanLoss::kStuck;
  ScanTrace& before = Span<ScanTrace>(traces_)[sensor_];
  const ScanTrace scan = trace_of(plan, image);
  const bool repeated = is_repeated(before, scan);
  before = scan;
  return repeated ? ScanLoss::kFrozen : ScanLoss::kNone;
}

void AcquisitionTask::note(ScanLoss loss) {
  ScanTally& tally = Span<ScanTally>(tallies_)[sensor_];
  ++tally.scans;
  if (loss == ScanLoss::kNone) return;
  ++Span<std::uint32_t>(tally.lost)[static_cast<std::size_t>(loss)];
  tally.last_loss = loss;
}

}  // namespace lasso
