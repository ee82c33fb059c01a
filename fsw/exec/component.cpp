#include "fsw/exec/component.hpp"

#include "fsw/core/renew.hpp"
#include "fsw/exec/report.hpp"

namespace lasso {

Component::Component(const SensorBank& sensors, const Identity& identity)
    : identity_(identity), acquisition_(sensors), telemetry_(identity.apid), commands_(identity.apid, context_, modes_, command_services_) {
  invariant(is_valid(identity), "an APID that a component can have");
}

Component::Component(Sensor& sensor, const Identity& identity) : Component(only(sensor), identity) {}

LoadFailure Component::load_image(Bytes image) {
  const Running running(identity_);
  if (executive_.begun()) return {Status::kBadOrder, 0, 0, "the component has begun"};
  return images_.start(image, acquisition_.sensors());
}

LoadFailure Component::load_stored_image() {
  const Running running(identity_);
  if (executive_.begun()) return {Status::kBadOrder, 0, 0, "the component has begun"};
  return images_.start_stored(acquisition_.sensors());
}

Status Component::use_memory(const BoardMemory& memory) {
  if (executive_.begun()) return Status::kBadOrder;
  Status status = images_.use_buffers(memory.image_buffers[0], memory.image_buffers[1]);
  if (status == Status::kOk) status = images_.watch_code(memory.code);
  if (status != Status::kOk || memory.store == nullptr) return status;
  parameters_.use_store(*memory.store);
  images_.use_store(*memory.store);
  telemetry_.stored_log().use(*memory.store);
  return status;
}

void Component::use_authenticator(Authenticator& authenticator) {
  commands_.use_authenticator(authenticator);
  authenticate_images(authenticator);
  command_services_.use_authenticator(authenticator);
}

Status Component::begin(TimeUs boundary_0_us) {
  const Running running(identity_);
  if (!images_.started()) return Status::kMissing;
  if (executive_.begun()) return Status::kBadOrder;
  invariant(executive_.begin(boundary_0_us, to_us(mission().parameters.period_s)) == Status::kOk, "slots of a valid period");
  telemetry_.events().set_time(boundary_0_us);
  interlocks_.inhibit_laser();
  telemetry_.raise<EventId::kBegun>(software_version(), software_build(), mission().image_crc, health_.reset_cause());
  static_cast<void>(parameters_.restore());
  health_.begin();
  modes_.begin(boundary_0_us);
  return Status::kOk;
}

StartRefusal Component::offer_start(InitialPoseSource source, const StartOffer& offer) {
  const Running running(identity_);
  return modes_.offer_start(source, offer);
}

Status Component::start_tracking(const Pose& T_sensor_target, const Twist& rates, TimeUs t_us) {
  const StartRefusal refusal = offer_start(InitialPoseSource::kUplink, rough_offer(mission().parameters, T_sensor_target, rates, t_us));
  if (refusal == StartRefusal::kNone) return Status::kOk;
  if (refusal == StartRefusal::kNotBegun) return Status::kBadOrder;
  return refusal == StartRefusal::kNotFinite ? Status::kNotFinite : Status::kBadValue;
}

Status Component::stop_tracking() { return command_mode(TrackingMode::kStandby) == ModeRefusal::kNone ? Status::kOk : Status::kBadOrder; }

std::size_t Component::receive(ConstBytes bytes, TimeUs now_us) {
  const Running running(identity_);
  return commands_.receive(bytes, now_us);
}

bool Component::receive_packet(ConstBytes packet, TimeUs now_us) {
  const Running running(identity_);
  return commands_.receive_packet(packet, now_us);
}

void Component::run_estimation() {
  const Running running(identity_);
  estimation_.run();
}

void Component::run_slot(TimeUs now_us) {
  const Running running(identity_);
  invariant(executive_.begun(), "slot before begin");
  telemetry_.events().set_time(now_us);
  if (executive_.jumped(now_us)) follow_jump(now_us);
  executive_.note_start(now_us);
  const std::uint32_t slot = executive_.next_slot();
  for (const SlotRow& row : slot_table()) {
    if (is_due(row, slot)) run_task(row.task, now_us);
  }
  health_.note_slot(slot);
  executive_.advance();
}

void Component::run_task(TaskId task, TimeUs now_us) {
  if (task == TaskId::kPollSensor) return acquisition_.poll(now_us);
  if (task == TaskId::kTendMemory) return image_service_.run_slot();
  pass_boundary(now_us);
}

void Component::pass_boundary(TimeUs now_us) {
  check_memory();
  publish_estimate(now_us);
  health_.feed_watchdog(estimation_.idle());
  commands_.pass_boundary(now_us);
  update_settings(now_us);
  schedule_scans(now_us);
  publish_states(now_us);
}

// What lies in copies, before anybody uses it.
void Component::check_memory() {
  modes_.check_mode();
  if (!interlocks_.check_laser()) {
    health_.see(Fault::kLaserCorrupt);
    commands_.note_change();
  }
  health_.see(Fault::kImageCorrupt, !images_.keep_selection());
}

void Component::publish_estimate(TimeUs now_us) {
  TrackStep step;
  const bool in_time = estimation_.collect(step);
  scans_.follow_estimate(in_time ? &estimation_ : nullptr);
  if (scans_.estimated().active) {
    if (!in_time) renew(step, [&] { return scans_.step_without_estimate(modes_.track()); });
    image_service_.note(step.registration);
    modes_.follow(step);
    publisher_.send_pose(step, now_us);
  } else if (publisher_.report_overdue()) {
    const std::uint32_t frame = executive_.frame();
    renew(step, [&] { return no_track(frame > kPipelineFrames ? frame - kPipelineFrames : 0, modes_.track()); });
    publisher_.send_pose(step, now_us);
  }
  publisher_.send_beside(step.registration, now_us);
}

// What was commanded, found or confirmed since the last boundary takes effect. An estimate that overran still reads the active image: what
// would change that waits.
void Component::update_settings(TimeUs now_us) {
  parameters_.check();
  if (estimation_.idle()) image_service_.pass_boundary();
  parameters_.apply(estimation_.idle());
  modes_.answer(health_.answer_faults(mission().parameters, now_us));
  modes_.apply_request();
}

void Component::schedule_scans(TimeUs now_us) {
  scans_.choose_sensor(modes_.track());
  hand_over_scan();
  scans_.start(modes_.track(), now_us);
}

void Component::hand_over_scan() {
  const ScanVerdict verdict = scans_.finish(modes_.mode());
  if (!scans_.estimated().active) return;
  if (verdict.loss == ScanLoss::kForeign) image_service_.note_foreign();
  if (!estimation_.idle()) return;  // an estimate that overran still runs: this scan is dropped with it
  modes_.use_sensor(scans_.estimated().sensor.sensor);
  estimation_.submit(scans_.job(modes_.track(), verdict.usable));
  if (verdict.usable) acquisition_.swap_images();
}

void Component::publish_states(TimeUs now_us) {
  modes_.keep_mode();
  scans_.send_sensors(now_us);
  image_service_.send(now_us);
  health_.tell_counters(scans_.chooser().failed(executive_.frame()));
  command_services_.end_boundary();
  telemetry_.pass_boundary();
}

// The clock was set, or nobody ran the slots for long: states keep their age, and what is on its way is of another time.
void Component::follow_jump(TimeUs now_us) {
  modes_.follow_jump(executive_.follow_jump(now_us));
  scans_.drop_scans();
  estimation_.drop();
  telemetry_.downlink().forget_time();
  health_.note_clock_jump();
}

}  // namespace lasso
