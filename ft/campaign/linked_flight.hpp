// A component that flies in simulated time, for tests of operations: nothing of it can be reached but its link, and this header shows no
// more (cfg/quality/arrows.toml keeps it so).
#pragma once

#include <cstdint>
#include <memory>

#include "fsw/core/authenticator.hpp"
#include "fsw/core/time.hpp"
#include "fsw/geometry/se3.hpp"
#include "fsw/link/byte_link.hpp"

namespace lasso::campaign {

// The tenth-scale Hubble, spinning 4 m away, scanned by 256 rays with noise. The mission knows no pose to start from.
class LinkedFlight {
 public:
  // The link outlives the flight, and so does who says which commands are authentic; null: all are.
  explicit LinkedFlight(ByteLink& link, Authenticator* authenticator = nullptr);
  ~LinkedFlight();
  LinkedFlight(const LinkedFlight&) = delete;
  LinkedFlight& operator=(const LinkedFlight&) = delete;

  // What an operator knows of the target, at the first boundary: its pose, and when that is.
  static Pose first_T_sensor_target();
  static TimeUs first_us();

  // From one boundary to the next.
  void run_frame();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace lasso::campaign
