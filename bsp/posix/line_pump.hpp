// Between a line of Linux and the rings of a driver: the interrupt of this board. A thread carries bytes both ways as they come.
#pragma once

#include <atomic>
#include <thread>

#include "bsp/posix/serial_line.hpp"
#include "hal_lcs/driver.hpp"

namespace lasso::posix {

class LinePump {
 public:
  // Both outlive the pump, which alone uses `line` until it ends. Bytes for which a ring has no room stay on the line.
  LinePump(SerialLine& line, lcs::Line& rings);
  ~LinePump();
  LinePump(const LinePump&) = delete;
  LinePump& operator=(const LinePump&) = delete;

  bool broken() const { return broken_; }  // the other end has gone

 private:
  void work();
  void wait();
  void receive();
  void send();

  SerialLine& line_;
  lcs::Line& rings_;
  std::uint8_t unsent_[256] = {};
  std::size_t unsent_at_ = 0, unsent_size_ = 0;
  std::atomic<bool> ending_{false}, broken_{false};
  std::thread thread_;  // last: uses all of the above
};

}  // namespace lasso::posix
