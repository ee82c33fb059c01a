// A host program around the flight component: no threads, memory of its own, telemetry on standard output.
// Usage: example_embedding IMAGE (a flight image of the box below; see README.md)
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "fsw/exec/lasso.hpp"
#include "fsw/sense/pattern.hpp"

// The driver of your scanner goes here. This one measures a box of 0.6 m x 0.4 m x 0.24 m that stands still.
class Scanner final : public lasso::Sensor {
 public:
  lasso::Status start(const lasso::ScanPlan& plan, lasso::TimeUs t_start_us) override {
    plan_ = plan;
    t_start_us_ = t_start_us;
    next_ = 0;
    return lasso::Status::kOk;
  }
  lasso::SensorPoll poll(lasso::TimeUs now_us, lasso::Span<lasso::RangeSample> out) override {
    lasso::SensorPoll poll;
    for (; next_ < plan_.points && poll.count < out.size(); ++next_, ++poll.count) {
      const lasso::TimeUs t_us = t_start_us_ + lasso::pattern_time_us(plan_, next_);
      if (t_us > now_us) break;
      out[poll.count] = measure(lasso::pattern_direction(plan_, next_), t_us);
    }
    poll.complete = next_ == plan_.points;
    return poll;
  }
  void abort() override { next_ = plan_.points; }

  lasso::Pose T_sensor_target{lasso::normalized(lasso::Quat(0.8, 0.3, -0.4, 0.35)), lasso::Vec3(0.05, -0.04, 2.5)};

 private:
  lasso::RangeSample measure(const lasso::Vec3& u, lasso::TimeUs t_us) const {
    const lasso::Pose T_target_sensor = lasso::inverse(T_sensor_target);
    const lasso::Vec3 d = lasso::rotate(T_target_sensor.q, u);
    const lasso::Vec3 to_center = lasso::Vec3(0.02, -0.01, 0.03) - T_target_sensor.p;
    const lasso::Vec3 half(0.30, 0.20, 0.12);
    const lasso::Vec3 a = (to_center - half).cwiseQuotient(d);
    const lasso::Vec3 b = (to_center + half).cwiseQuotient(d);
    const double range_m = a.cwiseMin(b).maxCoeff();
    lasso::RangeSample sample;
    for (int i = 0; i < 3; ++i) sample.direction[i] = static_cast<float>(u[i]);
    sample.t_us = t_us;
    sample.state = range_m < a.cwiseMax(b).minCoeff() ? lasso::RayState::kHit : lasso::RayState::kMiss;
    sample.range_m = sample.state == lasso::RayState::kHit ? static_cast<float>(range_m) : 0.0f;
    return sample;
  }
  lasso::ScanPlan plan_;
  lasso::TimeUs t_start_us_ = 0;
  std::uint16_t next_ = plan_.points;
};

// The host's answer to a bug in the component.
[[noreturn]] void lasso::on_invariant_failure(const char* what) {
  std::fprintf(stderr, "invariant failed: %s\n", what);
  std::abort();
}

int main(int argc, char** argv) {
  std::FILE* file = argc == 2 ? std::fopen(argv[1], "rb") : nullptr;
  if (file == nullptr) {
    std::fprintf(stderr, "usage: example_embedding IMAGE\n");
    return 2;
  }
  static std::uint64_t image[lasso::kMaxImageBytes / 8];  // stays the component's memory
  const std::size_t size = std::fread(image, 1, sizeof(image), file);
  std::fclose(file);

  Scanner scanner;
  std::vector<std::uint64_t> memory(lasso::required_memory() / 8 + 1);
  lasso::Component* component = lasso::create(memory.data(), memory.size() * 8, scanner);
  if (component == nullptr) return 1;
  const lasso::LoadFailure failure = lasso::load_image(*component, {reinterpret_cast<std::uint8_t*>(image), size});
  if (failure.status != lasso::Status::kOk) {
    std::fprintf(stderr, "%s: %s: %s\n", argv[1], lasso::to_string(failure.status), failure.what);
    return 2;
  }
  if (lasso::begin(*component, 0) != lasso::Status::kOk) return 1;
  lasso::Pose start = scanner.T_sensor_target;  // here: what another sensor or an operator says, some centimetres and degrees off
  start.q = lasso::normalized(lasso::Quat(1, 0.02, -0.03, 0.01) * start.q);
  start.p += lasso::Vec3(0.03, -0.02, 0.04);
  if (lasso::start_tracking(*component, start, lasso::Twist{}, 0) != lasso::Status::kOk) return 1;

  for (lasso::TimeUs now_us = 0; now_us < 2000000; now_us += 1000) {  // here: your clock
    while (lasso::step(*component, now_us)) {
    }
    std::uint8_t packet[lasso::kMaxPosePacketBytes];
    const std::size_t bytes = lasso::take_telemetry(*component, packet);  // here: your downlink
    lasso::PacketHeader header;
    lasso::PoseTelemetry pose;
    if (lasso::decode_pose({packet, bytes}, header, pose) != lasso::PacketFault::kNone) continue;
    const double* p = pose.p_sensor_target_m;
    std::printf("scan %u %s %.4f %.4f %.4f m\n", static_cast<unsigned>(pose.scan_id), pose.valid != 0 ? "valid" : "invalid", p[0], p[1],
                p[2]);
  }
  return 0;
}
