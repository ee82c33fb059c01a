#include "ft/port/flight.hpp"

#include <algorithm>

#include "docs/embedding/box.hpp"
#include "fsw/core/crc.hpp"
#include "ft/port/board.hpp"

namespace lasso::port {
namespace {

alignas(required_alignment()) std::uint8_t memory[required_memory()];

test::TestImage image_of_the_box() {
  MissionParameters parameters = preset_parameters();
  parameters.start_check = 0;  // poses from the first frames on
  return test::make_box_image(parameters);
}

}  // namespace

Status NoisyBox::start(const ScanPlan& plan, TimeUs t_start_us) {
  plan_ = plan;
  t_start_us_ = t_start_us;
  next_ = 0;
  return Status::kOk;
}

SensorPoll NoisyBox::poll(TimeUs now_us, Span<RangeSample> out) {
  SensorPoll poll;
  for (; next_ < plan_.points && poll.count < out.size(); ++next_, ++poll.count) {
    const TimeUs t_us = t_start_us_ + pattern_time_us(plan_, next_);
    if (t_us > now_us) break;
    RangeSample& sample = out[poll.count] = measure_box(box_pose(), pattern_direction(plan_, next_), t_us);
    if (sample.state == RayState::kHit) sample.range_m += noise_m();
  }
  poll.complete = next_ == plan_.points;
  return poll;
}

// Even, within a millimetre, the same everywhere: the generator of Numerical Recipes, its upper bits.
float NoisyBox::noise_m() {
  random_ = random_ * 1664525U + 1013904223U;
  const int steps = static_cast<int>(random_ >> 21);  // 0 to 2047
  return static_cast<float>(steps - 1024) / 1048576.0F;
}

Flight::Flight() : image_(image_of_the_box()) {
  Component* component = create(memory, sizeof memory, box_);
  if (load_image(*component, {image_.data(), image_.size}).status != Status::kOk) return;
  if (begin(*component, 0) != Status::kOk) return;
  if (start_tracking(*component, box_pose(), Twist{}, 0) == Status::kOk) component_ = component;
}

void Flight::fly(int frames) {
  for (int i = 0; i < frames; ++i) {
    do run_slot();
    while (!component_->next_slot_is_boundary());
    take_telemetry();
  }
}

void Flight::run_slot() {
  const TimeUs begun_us = now_us();
  component_->run_slot(component_->next_slot_us());
  const TimeUs ran_us = now_us();
  longest_.slot_us = std::max(longest_.slot_us, ran_us - begun_us);
  if (!component_->estimation_pending()) return;
  component_->run_estimation();
  longest_.estimate_us = std::max(longest_.estimate_us, now_us() - ran_us);
}

void Flight::take_telemetry() {
  static std::uint8_t packets[kTelemetryQueueBytes];
  ConstBytes rest(packets, component_->take_telemetry(packets));
  digest_ = crc32c(rest, digest_);
  for (std::size_t size = 0; !rest.empty(); rest = rest.subspan(size, rest.size() - size)) {
    size = packet_size(rest);
    PacketHeader header;
    PoseTelemetry pose;
    if (decode_pose(rest.first(size), header, pose) == PacketFault::kNone) valid_poses_ += pose.valid;
  }
}

}  // namespace lasso::port
