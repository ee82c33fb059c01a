// The changes of the mode in a flight, as telemetry states them.
#pragma once

#include "ut/exec/component_scene.hpp"

namespace lasso::test {

inline MissionParameters story_parameters() {
  MissionParameters p = box_parameters(default_scene());
  p.initial_present = 0;
  p.recover = 1;
  p.coast_frames = 2;
  p.reacquire_frames = 3;
  p.start_frames = 3;
  return p;
}

inline std::uint8_t code(TrackingMode mode) { return static_cast<std::uint8_t>(mode); }

struct Story {
  std::vector<PoseTelemetry> reports;
  std::vector<ModeChange> changes;

  void take(const PoseTelemetry& t) {
    reports.push_back(t);
    for (std::size_t k = 0; k < t.changes; ++k) {
      changes.push_back({static_cast<TrackingMode>(t.change_from[k]), static_cast<ModeEvent>(t.change_event[k]),
                         static_cast<TrackingMode>(t.change_to[k])});
    }
  }
  void run(ComponentScene& scene, int frames) {
    for (int i = 0; i < frames; ++i) {
      for (const Report& report : scene.run_frame()) take(report.pose);
    }
  }
  void expect(const std::vector<ModeChange>& expected) const {
    ASSERT_EQ(changes.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_EQ(changes[i].from, expected[i].from) << i << " " << to_string(changes[i].from);
      EXPECT_EQ(changes[i].event, expected[i].event) << i << " " << to_string(changes[i].event);
      EXPECT_EQ(changes[i].to, expected[i].to) << i << " " << to_string(changes[i].to);
    }
  }
  const PoseTelemetry& last() const { return reports.back(); }
};

// Runs the slots of `frames` frames with the clock `off_us` away from the nominal times of the first of them.
inline void run_shifted(ComponentScene& scene, Story& story, DurationUs off_us, int frames) {
  const TimeUs now_us = scene.component->next_slot_us() + off_us;
  EXPECT_TRUE(scene.component->slot_is_due(now_us));
  scene.component->run_slot(now_us);
  EXPECT_EQ(scene.component->next_slot_us(), now_us + 10'000) << "slots go on from the clock's time";
  scene.component->run_estimation();
  story.run(scene, frames);
}

}  // namespace lasso::test
