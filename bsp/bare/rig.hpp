// The board's end of the test rig (rig_words.hpp).
#pragma once

#include <cstdint>

#include "bsp/bare/rig_words.hpp"
#include "bsp/bare/serial_port.hpp"

namespace lasso::bare {

struct RigAnswer {
  std::uint32_t camera_bytes = 0, ground_bytes = 0;
  bool stop() const { return camera_bytes == kStopBytes; }
};

class Rig {
 public:
  Rig(SerialPort& port, Ring& in, Ring& out) : port_(port), in_(in), out_(out) {}
  // Waits for the answer. Interrupts are allowed.
  RigAnswer report(const std::uint32_t (&words)[kRigWords]);

 private:
  std::uint32_t take_word();

  SerialPort& port_;
  Ring& in_;
  Ring& out_;
};

}  // namespace lasso::bare
