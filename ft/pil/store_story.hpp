// What the ground does to try the board's store (docs/pil.md), over three starts: it saves a parameter and is cut off in the middle of
// loading an image; then the parameter and the log are asked for, a word of the active image is damaged by the emulator's debug port, and
// the image is loaded again, whole, and made active; then, with that image from the store, the one before is taken back.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ft/pil/gdb_stub.hpp"
#include "ft/pil/world.hpp"

namespace lasso::pil {

constexpr std::uint32_t kStoryStarts = 3;

class StoreStory {
 public:
  // `image`: to be loaded. `buffer`: where the board has its first image buffer. `memory`: where its memory begins. `folder`: of the
  // emulator's memory and debug port.
  StoreStory(std::vector<std::uint8_t> image, std::uint32_t buffer, std::uint32_t memory, std::string folder);

  // What the ground sends before a slot of a start (boards.hpp).
  Packet commands(std::uint32_t start, std::uint32_t slot, std::uint16_t& count);
  // Frames from the last start on, after which all has been said.
  static constexpr std::uint32_t kLastFrames = 5;
  // Whether the damaged word is again as it was.
  bool repaired();

 private:
  using Values = std::vector<std::pair<std::string, std::string>>;
  void send(const std::string& command, const Values& values = {});
  void send_armed(const std::string& command, const Values& values = {});
  void begin_image();
  void load_some();
  void first_start(std::uint32_t frame);
  void second_start(std::uint32_t frame);
  void third_start(std::uint32_t frame);
  void damage();
  std::uint8_t byte_of_memory() const;

  std::vector<std::uint8_t> image_;
  std::uint32_t place_, memory_;
  std::string folder_;
  GdbStub gdb_;
  std::uint8_t right_ = 0;  // the byte before it was damaged
  std::size_t loaded_ = 0;
  std::uint32_t end_frame_ = 0;  // of the second start: everything is loaded, and the scrub has been all over memory
  std::uint16_t count_ = 0;      // of the next command
  Packet packets_;
};

// What telemetry says of it, of one start: a line for ft/pil/faults.
std::string told_of_store(const Packet& telemetry);

}  // namespace lasso::pil
