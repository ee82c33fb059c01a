// One of the board's lines, from the first byte of a start on: the end of the rig.
#pragma once

#include <poll.h>

#include <chrono>
#include <initializer_list>
#include <string>

#include "bsp/posix/serial_line.hpp"
#include "ft/pil/boards.hpp"

namespace lasso::pil {

constexpr std::chrono::seconds kPatience(30);  // for any sign of life: no result depends on it

class Line {
 public:
  // Throws mdat::RunError: the socket in `folder` cannot be made; nobody comes; the other end has gone.
  void listen(const std::string& folder, const std::string& name);
  void await();
  // Whatever has come, or can go, by now.
  void move();
  pollfd awaited() const { return {line_.descriptor(), static_cast<short>(unsent_.empty() ? POLLIN : POLLIN | POLLOUT), 0}; }

  bool has(std::size_t count) const { return bytes_.size() >= count; }
  // All up to the count that the board says.
  bool has_all(std::uint32_t sent) const { return has(sent - taken_); }
  Packet take(std::size_t count);
  Packet take_until(std::uint32_t sent) { return take(sent - taken_); }
  void give(const Packet& packet);

  std::uint32_t given() const { return given_; }
  std::uint32_t taken() const { return taken_; }
  void count_anew() { given_ = taken_ = 0; }
  // Counts as at another time of the flight; nothing is on its way.
  void go_back(std::uint32_t taken, std::uint32_t given);

 private:
  std::string name_;
  posix::LineServer server_;
  posix::SerialLine line_;
  Packet bytes_, unsent_;
  std::uint32_t taken_ = 0, given_ = 0;
};

// As the rig's line carries them (bsp/bare/rig_words.hpp).
Packet words(std::initializer_list<std::uint32_t> words);
// Throws mdat::RunError where it is none.
Report report_of(const Packet& bytes);

}  // namespace lasso::pil
