#include "hal_sim/lcs_direct.hpp"

#include <utility>

#include "fsw/sense/pattern.hpp"
#include "hal_lcs/driver.hpp"

namespace lasso::sim {
namespace {

// What is left of a message at the other end of a line.
template <typename Message>
Message carried(const Message& message) {
  const lcs::FrameBytes bytes = lcs::encode(0, message);
  lcs::FrameDecoder decoder;
  lcs::Frame frame;
  Message received;
  static_cast<void>(decoder.step(bytes.span(), frame));
  static_cast<void>(decode(frame, received));
  return received;
}

ScanPlan carried_plan(const ScanPlan& plan) {
  lcs::StartCommand command;
  command.plan = plan;
  ScanPlan received = carried(command).plan;
  received.aimed = plan.aimed;
  return received;
}

lcs::RawSample carried_sample(const lcs::RawSample& raw) {
  lcs::Samples samples;
  samples.samples[samples.count++] = raw;
  return carried(samples).samples[0];
}

}  // namespace

LcsDirect::LcsDirect(const RayCaster& target, const Trajectory& trajectory, const ScannerModel& model, std::uint64_t seed,
                     const LcsCamera& camera, OtherBodies others)
    : scanner_(target, trajectory, model, seed, std::move(others)), camera_(camera), made_(optics_of(camera)), optics_(made_) {
  use_calibration(nullptr);
}

void LcsDirect::use_calibration(const TriangulationCalibration* calibration) {
  optics_ = calibration == nullptr ? made_ : made_.calibrated(*calibration);
  optics_.set_temperature(static_cast<double>(camera_.temperature_degC));
}

Status LcsDirect::start(const ScanPlan& plan, TimeUs t_start_us) {
  Status status = validate(plan);
  if (status != Status::kOk) return status;
  const ScanPlan received = carried_plan(plan);
  status = scanner_.start(received, t_start_us + lcs::kStartDelayUs);
  if (status != Status::kOk) return status;
  plan_ = received;
  next_ = 0;
  return status;
}

SensorPoll LcsDirect::poll(TimeUs now_us, Span<RangeSample> out) {
  const SensorPoll poll = scanner_.poll(now_us, out);
  for (std::size_t i = 0; i < poll.count; ++i) {
    const lcs::RawSample raw = raw_of(camera_, pattern_direction(plan_, next_++), out[i]);
    static_cast<void>(optics_.convert(carried_sample(raw), out[i].t_us, out[i]));
  }
  return poll;
}

}  // namespace lasso::sim
