#include "cfs/bus_sensor.hpp"

#include <algorithm>

namespace lasso::cfs {
namespace {

RangeSample to_sample(const LASSO_Sample_t& message) {
  RangeSample sample;
  std::copy_n(message.direction, 3, sample.direction);
  sample.range_m = message.range_m;
  sample.t_us = message.t_us;
  sample.sigma_factor = message.sigma_factor;
  const bool known = message.state <= static_cast<std::uint32_t>(RayState::kLost);
  sample.state = known ? static_cast<RayState>(message.state) : RayState::kInvalid;
  return sample;
}

template <class From, class To, std::size_t N>
void copy(const From (&from)[N], To (&to)[N]) {
  std::copy_n(from, N, to);
}

}  // namespace

LASSO_Scan_Payload_t to_order(const ScanPlan& plan, TimeUs t_start_us) {
  LASSO_Scan_Payload_t order{};
  order.order = LASSO_ORDER_START;
  order.scan_id = plan.scan_id;
  order.start_us = t_start_us;
  order.duration_us = plan.duration_us;
  order.phase_turns = plan.phase_turns;
  order.center[0] = plan.center_x;
  order.center[1] = plan.center_y;
  order.half[0] = plan.half_x;
  order.half[1] = plan.half_y;
  order.pattern = static_cast<std::uint16_t>(plan.kind);
  order.points = plan.points;
  order.cycles_a = plan.cycles_a;
  order.cycles_b = plan.cycles_b;
  for (const AimedRay& ray : plan.aimed) {
    order.aimed[order.aimed_count][0] = ray.x;
    order.aimed[order.aimed_count][1] = ray.y;
    ++order.aimed_count;
  }
  return order;
}

ScanPlan to_plan(const LASSO_Scan_Payload_t& order, AimedRays& aimed) {
  ScanPlan plan;
  plan.scan_id = order.scan_id;
  plan.kind = static_cast<PatternKind>(std::min<std::uint16_t>(order.pattern, 0xFF));
  plan.points = order.points;
  plan.cycles_a = order.cycles_a;
  plan.cycles_b = order.cycles_b;
  plan.phase_turns = order.phase_turns;
  plan.center_x = order.center[0];
  plan.center_y = order.center[1];
  plan.half_x = order.half[0];
  plan.half_y = order.half[1];
  plan.duration_us = order.duration_us;
  aimed.clear();
  const std::size_t count = std::min<std::size_t>(order.aimed_count, kMaxAimedRays);
  for (std::size_t i = 0; i < count; ++i) static_cast<void>(aimed.push_back({order.aimed[i][0], order.aimed[i][1]}));
  plan.aimed = aimed.span();
  return plan;
}

LASSO_Sample_t to_message(const RangeSample& sample) {
  LASSO_Sample_t message{};
  message.t_us = sample.t_us;
  copy(sample.direction, message.direction);
  message.range_m = sample.range_m;
  message.sigma_factor = sample.sigma_factor;
  message.state = static_cast<std::uint32_t>(sample.state);
  return message;
}

LASSO_Pose_Payload_t to_message(const PoseTelemetry& pose) {
  LASSO_Pose_Payload_t message{};
  message.t_measurement_us = pose.t_measurement_us;
  message.t_publication_us = pose.t_publication_us;
  copy(pose.q_sensor_target, message.q_sensor_target);
  copy(pose.p_sensor_target_m, message.p_sensor_target_m);
  copy(pose.covariance, message.covariance);
  copy(pose.filter_q_sensor_target, message.filter_q_sensor_target);
  copy(pose.filter_p_sensor_target_m, message.filter_p_sensor_target_m);
  copy(pose.filter_omega_radps, message.filter_omega_radps);
  copy(pose.filter_v_mps, message.filter_v_mps);
  message.scan_id = pose.scan_id;
  message.image_crc = pose.image_crc;
  message.weak = pose.weak;
  message.valid = pose.valid;
  message.reason = pose.reason;
  message.mode = pose.mode;
  return message;
}

bool BusSensor::take(const LASSO_Samples_Payload_t& message) {
  const bool fits = message.count <= LASSO_SAMPLES_PER_MESSAGE && message.count + samples_.size() <= points_;
  if (!running_ || complete_ || message.scan_id != scan_id_ || !fits) return false;
  for (std::size_t i = 0; i < message.count; ++i) static_cast<void>(samples_.push_back(to_sample(message.samples[i])));
  complete_ = message.complete != 0;
  status_ = static_cast<Status>(message.status);
  return true;
}

Status BusSensor::start(const ScanPlan& plan, TimeUs t_start_us) {
  if (running_) return Status::kBusy;
  if (!permitted_) return Status::kMissing;
  samples_.clear();
  handed_over_ = 0;
  scan_id_ = plan.scan_id;
  points_ = plan.points;
  status_ = Status::kOk;
  complete_ = false;
  running_ = true;
  port_.send(to_order(plan, t_start_us));
  return Status::kOk;
}

SensorPoll BusSensor::poll(TimeUs /*now_us*/, Span<RangeSample> out) {
  SensorPoll poll;
  if (!running_) {
    poll.status = permitted_ ? Status::kNoData : Status::kMissing;
    return poll;
  }
  poll.status = status_;
  if (status_ == Status::kOk) {
    poll.count = std::min(out.size(), samples_.size() - handed_over_);
    std::copy_n(samples_.begin() + handed_over_, poll.count, out.data());
    handed_over_ += poll.count;
    poll.complete = complete_ && handed_over_ == samples_.size();
  }
  running_ = poll.status == Status::kOk && !poll.complete;
  return poll;
}

void BusSensor::abort() {
  if (running_) order(LASSO_ORDER_ABORT);
  running_ = false;
}

// The scanner is told each time: one that has not heard it may be told again.
void BusSensor::permit_laser(bool permitted) {
  permitted_ = permitted;
  if (!permitted) running_ = false;
  order(permitted ? LASSO_ORDER_PERMIT_LASER : LASSO_ORDER_INHIBIT_LASER);
}

void BusSensor::order(std::uint32_t order) {
  LASSO_Scan_Payload_t message{};
  message.order = order;
  message.scan_id = scan_id_;
  port_.send(message);
}

}  // namespace lasso::cfs
