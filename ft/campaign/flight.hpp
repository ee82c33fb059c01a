// The component flown by a campaign: on one thread, through its embedding interface, in simulated time. What it says is its telemetry.
#pragma once

#include <cstdint>
#include <vector>

#include "fsw/exec/lasso.hpp"

namespace lasso::campaign {

// Loads the image and passes boundary 0 at mdat::kEpochUs. Throws mdat::RunError where the component refuses.
void begin(Component& component, Bytes image);
void start_tracking(Component& component, const Pose& T_sensor_target);

// The slots of one frame, or one of them; then the packets that wait. Bounded whatever the component's state is.
void run_slot(Component& component);
std::vector<std::uint8_t> take_telemetry(Component& component);
std::vector<std::uint8_t> run_frame(Component& component);

// The poses of whole packets, in order; `broken` counts what cannot be decoded.
struct Decoded {
  std::vector<PoseTelemetry> poses;
  std::size_t broken = 0;
};
Decoded decode(ConstBytes stream);

}  // namespace lasso::campaign
