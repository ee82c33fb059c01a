// Who listens to a run while it flies: a recorder, a live view. It changes nothing of the run.
#pragma once

#include <cstdint>
#include <vector>

#include "fsw/link/pose_telemetry.hpp"
#include "fsw/sense/range_image.hpp"
#include "hal_sim/trajectory.hpp"
#include "mdat/run/taken_pair.hpp"

namespace lasso::mdat {

// A scan that the component reported on, and what is true of it.
struct FlownFrame {
  const PoseTelemetry& telemetry;
  const sim::TruthState& truth;             // at the scan's reference time
  const std::vector<RangeSample>& samples;  // as the sensor gave them; empty where the scan was lost
};

// Calls come in the order of the run, from its own thread. What is thrown ends the run.
class RunListener {
 public:
  virtual ~RunListener() = default;
  // All packets of one frame's boundary, as they leave the component.
  virtual void on_packets(TimeUs boundary_us, ConstBytes packets) = 0;
  virtual void on_frame(const FlownFrame& frame) = 0;
  // What an operator's link gave for the slot that was to begin at `slot_us`: bytes of a stream, or one datagram.
  virtual void on_commands(TimeUs /*slot_us*/, ConstBytes /*bytes*/) {}
  // Once the scan has begun that it is taken for.
  virtual void on_pair(const TakenPair& /*pair*/) {}
};

}  // namespace lasso::mdat
