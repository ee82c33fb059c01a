// Everything around the board: the simulated camera at the end of its line, or the head beside the processor, and the ground, which enables
// the laser and asks now and then whether anybody is there. It moves from slot to slot as it is told; it has no clock.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "hal_lcs/driver.hpp"
#include "hal_lcs/head_memory.hpp"
#include "hal_sim/lcs_device.hpp"
#include "hal_sim/memory_head.hpp"
#include "mdat/run/camera.hpp"
#include "mdat/run/case.hpp"

namespace lasso::pil {

using Packet = std::vector<std::uint8_t>;

struct WorldSetup {
  mdat::CaseSetup flight;
  std::optional<std::uint64_t> camera_bytes;  // after as many its line is cut, be it in the middle of a frame
  bool ground_noise = false;                  // the ground's line begins in the middle of a packet, and brings a damaged one
};

class World {
 public:
  // `head`, which may be null: where the head beside the processor meets it; the camera's line then stays silent. It outlives this.
  explicit World(const WorldSetup& setup, lcs::HeadMemory* head = nullptr);

  TimeUs slot_us(std::uint32_t slot) const;  // since boundary 0, whose number is 0
  // Slot `slot` comes next: what the camera and the ground have said by then. Nothing has been sent to either before slot 0 but by a start.
  void move_to(std::uint32_t slot, ConstBytes to_camera);
  Packet from_camera();
  Packet from_ground();
  std::uint16_t& next_command() { return commands_; }  // its sequence count

 private:
  WorldSetup setup_;
  DurationUs period_us_;
  std::unique_ptr<sim::Trajectory> motion_;
  sim::LcsCamera camera_;
  sim::LcsDevice device_;
  sim::MemoryHead own_head_;
  lcs::HeadMemory* head_;
  lcs::Line line_;
  std::uint64_t carried_ = 0;
  std::uint16_t commands_ = 0;
  Packet ground_;
};

}  // namespace lasso::pil
