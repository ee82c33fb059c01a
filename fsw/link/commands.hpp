// Commands as plain values, and the decoder that makes them from packets. Their rows: command_rows.hpp.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/span.hpp"
#include "fsw/core/time.hpp"
#include "fsw/link/telecommand.hpp"

namespace lasso {

constexpr std::uint8_t kServiceFunction = 8;
constexpr std::uint8_t kSubservicePerform = 1;
constexpr std::uint8_t kServiceTest = 17;
constexpr std::uint8_t kSubservicePing = 1;
constexpr std::uint8_t kSubservicePong = 2;

enum class CommandKind : std::uint8_t { kPing = 0, kMode = 1, kHold = 2, kStart = 3 };  // the number of the function

struct ModeCommand {
  std::uint8_t mode = 0;  // TrackingMode
};
struct HoldCommand {
  std::uint8_t held = 0;
};
struct StartCommand {
  std::uint8_t way = 0;  // StartWay
  TimeUs t_us = 0;       // at which the rest is stated
  double q_sensor_target[4] = {0, 0, 0, 1};
  double p_sensor_target_m[3] = {};
  double omega_radps[3] = {};  // sensor axes
  double v_mps[3] = {};
  float covariance[21] = {};  // upper triangle, row by row: rotation [rad], translation [m]; sensor axes
};

struct Command {
  CommandHeader header;
  CommandKind kind = CommandKind::kPing;
  ModeCommand mode;  // the one of `kind` holds
  HoldCommand hold;
  StartCommand start;
};

constexpr std::size_t kMaxCommandBytes = 256;

// Checks packet and arguments. `command` is untouched when it is refused.
PacketFault decode_command(ConstBytes packet, Command& command);

}  // namespace lasso
