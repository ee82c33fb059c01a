// The whole component before a simulated box, with two image buffers, a store and code to watch.
#pragma once

#include <algorithm>
#include <cstring>
#include <memory>
#include <vector>

#include "fsw/exec/component.hpp"
#include "ut/exec/component_scene.hpp"
#include "ut/support/box_scene.hpp"
#include "ut/support/ram_store.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::test {

struct Event {
  EventId id = EventId::kNone;
  std::vector<std::uint8_t> items;
};

inline std::uint32_t crc_of(const TestImage& image) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(image.storage.data()) + image.size - 4;
  return static_cast<std::uint32_t>(bytes[0]) << 24 | static_cast<std::uint32_t>(bytes[1]) << 16 |
         static_cast<std::uint32_t>(bytes[2]) << 8 | bytes[3];
}

// The same image, of another mission id.
inline TestImage of_mission(TestImage image, std::uint8_t id) {
  image.data()[19] = id;
  repair_crcs(image);
  return image;
}

class MemoryScene {
 public:
  MemoryScene() : sensor(default_scene()), store(kBufferBytes + 64), code(40000, 0x4E) { restart(); }

  static MissionParameters parameters() {
    MissionParameters p = box_parameters(default_scene(), Vec6::Zero());
    p.image_trial_scans = 6;
    p.image_trial_valid_min = 3;
    return p;
  }

  void restart() {
    component = std::make_unique<Component>(sensor);
    for (auto& buffer : buffers) buffer.assign(kBufferBytes / 8, 0);
    BoardMemory memory;
    memory.image_buffers[0] = buffer(0);
    memory.image_buffers[1] = buffer(1);
    memory.store = &store;
    memory.code = ConstBytes(code.data(), code.size());
    ASSERT_EQ(component->use_memory(memory), Status::kOk);
  }
  Bytes buffer(std::size_t i) { return {reinterpret_cast<std::uint8_t*>(buffers[i].data()), kBufferBytes}; }

  void begin(const TestImage& image) {
    std::memcpy(buffer(0).data(), image.storage.data(), image.size);
    ASSERT_EQ(component->load_image(buffer(0).first(image.size)).status, Status::kOk);
    ASSERT_EQ(component->begin(0), Status::kOk);
  }

  std::vector<Report> run_frame(bool estimate = true) {
    do {
      component->run_slot(component->next_slot_us());
      if (estimate) component->run_estimation();
    } while (!component->next_slot_is_boundary());
    std::vector<std::uint8_t> bytes(kTelemetryQueueBytes);
    bytes.resize(component->take_telemetry(Bytes(bytes.data(), bytes.size())));
    take_events(ConstBytes(bytes.data(), bytes.size()));
    return decode_all(ConstBytes(bytes.data(), bytes.size()));
  }
  // Poses of so many frames.
  std::vector<PoseTelemetry> run_frames(std::uint32_t frames) {
    std::vector<PoseTelemetry> poses;
    for (std::uint32_t i = 0; i < frames; ++i) {
      for (const Report& report : run_frame()) poses.push_back(report.pose);
    }
    return poses;
  }

  void upload(const TestImage& image, bool estimate = true) {
    ASSERT_EQ(component->open_image(static_cast<std::uint32_t>(image.size), crc_of(image)), ImageRefusal::kNone);
    const ConstBytes bytes(reinterpret_cast<const std::uint8_t*>(image.storage.data()), image.size);
    ASSERT_EQ(component->put_image(0, bytes), ImageRefusal::kNone);
    ASSERT_EQ(component->check_image(), ImageRefusal::kNone);
    for (int i = 0; i < 200 && component->images().other().state() != ImageState::kReady; ++i) {
      ASSERT_NE(component->images().other().state(), ImageState::kRefused);
      run_frame(estimate);
    }
  }

  bool told(EventId id) const {
    return std::any_of(events.begin(), events.end(), [&](const Event& event) { return event.id == id; });
  }
  Event last(EventId id) const {
    Event found;
    for (const Event& event : events) found = event.id == id ? event : found;
    EXPECT_EQ(found.id, id);
    return found;
  }

  static constexpr std::size_t kBufferBytes = 1 << 20;
  BoxSensor sensor;
  RamStore store;
  std::vector<std::uint8_t> code;
  std::vector<std::uint64_t> buffers[2];
  std::unique_ptr<Component> component;
  std::vector<Event> events;

 private:
  void take_events(ConstBytes stream) {
    for (std::size_t at = 0; at < stream.size();) {
      const std::size_t size = packet_size(stream.subspan(at, stream.size() - at));
      const ConstBytes packet = stream.subspan(at, size);
      if (packet[7] == kServiceEvent && packet[8] <= 4) {
        Event event;
        event.id = static_cast<EventId>(packet[20] << 8 | packet[21]);
        event.items.assign(packet.begin() + 22, packet.end() - 2);
        events.push_back(event);
      }
      at += size;
    }
  }
};

// --- images of one target, and the component before it

inline TestImage image_of(const MissionParameters& parameters, const Boxes& boxes = {BoxModel{}}) {
  return make_image(parameters, make_box_tables(boxes));
}
inline const TestImage& first_image() {
  static const TestImage image = image_of(MemoryScene::parameters());
  return image;
}
// The same target, with other numbers.
inline const TestImage& better_image() {
  static const TestImage image = [] {
    MissionParameters p = MemoryScene::parameters();
    p.inliers_min = 50;
    return image_of(p);
  }();
  return image;
}
inline bool all_valid(const std::vector<PoseTelemetry>& poses) {
  return std::all_of(poses.begin(), poses.end(), [](const PoseTelemetry& pose) { return pose.valid != 0; });
}

class MemoryFixture : public ::testing::Test {
 protected:
  std::unique_ptr<MemoryScene> scene_ = std::make_unique<MemoryScene>();
  Component& component() { return *scene_->component; }
};

}  // namespace lasso::test
