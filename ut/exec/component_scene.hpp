// The whole component before a simulated box, and its telemetry decoded.
#pragma once

#include <memory>
#include <vector>

#include "fsw/exec/component.hpp"
#include "ut/support/box_scene.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::test {

struct Report {
  PacketHeader header;
  PoseTelemetry pose;
};

inline std::vector<Report> decode_all(ConstBytes stream) {
  std::vector<Report> reports;
  std::size_t at = 0;
  while (at < stream.size()) {
    const std::size_t size = packet_size(stream.subspan(at, stream.size() - at));
    Report report;
    const PacketFault fault = decode_pose(stream.subspan(at, size), report.header, report.pose);
    EXPECT_TRUE(fault == PacketFault::kNone || fault == PacketFault::kUnknown) << to_string(fault);
    if (fault == PacketFault::kNone) reports.push_back(report);  // events are of the same frame
    at += size;
  }
  return reports;
}

class ComponentScene {
 public:
  explicit ComponentScene(const MissionParameters& parameters, const BoxScene& scene = default_scene())
      : scene_(scene),
        sensor(scene),
        component(std::make_unique<Component>(sensor)),
        image_(make_image(parameters, make_box_tables(scene.boxes()))) {}
  ComponentScene(const BoxScene& scene, const TestImage& image)
      : scene_(scene), sensor(scene), component(std::make_unique<Component>(sensor)), image_(image) {}

  LoadFailure load() { return component->load_image(Bytes(image_.data(), image_.size)); }
  void begin() {
    ASSERT_EQ(load().status, Status::kOk);
    ASSERT_EQ(component->begin(0), Status::kOk);
  }

  // The slots of one frame; `estimate` says whether the estimation thread keeps up.
  std::vector<Report> run_frame(bool estimate = true) {
    do {
      component->run_slot(component->next_slot_us());
      if (estimate) component->run_estimation();
    } while (!component->next_slot_is_boundary());
    std::vector<std::uint8_t> bytes(kTelemetryQueueBytes);
    bytes.resize(component->take_telemetry(Bytes(bytes.data(), bytes.size())));
    stream.insert(stream.end(), bytes.begin(), bytes.end());
    return decode_all(ConstBytes(bytes.data(), bytes.size()));
  }

  Vec6 error(const PoseTelemetry& t) const {
    Pose pose;
    pose.q = Quat(t.q_sensor_target[3], t.q_sensor_target[0], t.q_sensor_target[1], t.q_sensor_target[2]);
    pose.p = Vec3(t.p_sensor_target_m[0], t.p_sensor_target_m[1], t.p_sensor_target_m[2]);
    return pose_difference(pose, scene_.pose_at(t.t_measurement_us));
  }

 private:
  BoxScene scene_;

 public:
  BoxSensor sensor;
  std::unique_ptr<Component> component;
  std::vector<std::uint8_t> stream;

 private:
  TestImage image_;
};

}  // namespace lasso::test
