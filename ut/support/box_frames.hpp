// Flight images with named frames.
#pragma once

#include "fsw/mission/named_frame.hpp"
#include "ut/support/box_sensors.hpp"

namespace lasso::test {

constexpr std::size_t kNamedFramesTable = 19;  // in BoxTables

// A grapple point on the target, and a port beside the sensor.
inline NamedFrame grapple_in_port() {
  return {{normalized(Quat(0.6, 0.3, 0.6, -0.4)), Vec3(-0.4, 0.3, 0.1)}, {normalized(Quat(0.7, -0.4, 0.2, 0.5)), Vec3(-0.1, 0.4, 0.9)}};
}

inline void append_named_frame(const NamedFrame& frame, Words& words) {
  for (const Pose* pose : {&frame.T_target_of, &frame.T_in_sensor}) {
    for (const double term : {pose->q.x(), pose->q.y(), pose->q.z(), pose->q.w(), pose->p.x(), pose->p.y(), pose->p.z()})
      append_value(term, words);
  }
}

inline BoxTables with_frames(BoxTables tables, const std::vector<NamedFrame>& frames) {
  for (const NamedFrame& frame : frames) append_named_frame(frame, tables[kNamedFramesTable]);
  return tables;
}

}  // namespace lasso::test
