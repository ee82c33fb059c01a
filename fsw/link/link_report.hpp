// What the link says of commands: verification (service 1), the answer to a test (service 17), and its own counters.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/span.hpp"
#include "fsw/link/housekeeping.hpp"
#include "fsw/link/packet.hpp"

namespace lasso {

constexpr std::uint8_t kServiceVerification = 1;
constexpr std::uint8_t kSubserviceAccepted = 1;
constexpr std::uint8_t kSubserviceRefused = 2;
constexpr std::uint8_t kSubserviceStarted = 3;
constexpr std::uint8_t kSubserviceCompleted = 7;
constexpr std::uint8_t kSubserviceFailed = 8;

// Of which command, and what became of it.
struct Verification {
  std::uint16_t packet_id = 0;         // first two octets of the command
  std::uint16_t sequence_control = 0;  // the two octets behind them
  std::uint8_t fault = 0;              // PacketFault
  std::uint8_t mode_refusal = 0;       // ModeRefusal
  std::uint8_t start_refusal = 0;      // StartRefusal
  std::uint8_t service_refusal = 0;    // ServiceRefusal
};

// The packet `parameter`.
struct ParameterTelemetry {
  std::uint16_t parameter = 0;
  double value = 0;        // in the parameter's unit
  double image_value = 0;  // the mission image's
  std::uint8_t changed = 0;
};

struct LinkTelemetry {
  std::uint32_t accepted_commands = 0;
  std::uint32_t refused_commands = 0;
  std::uint8_t last_fault = 0;      // PacketFault of the last one that was refused
  std::uint32_t skipped_bytes = 0;  // that belonged to no packet
  std::uint16_t queue_peak = 0;     // most bytes of telemetry that ever waited
  std::uint8_t armed = 0;           // 1: a hazardous command may be fired
  std::uint8_t laser_enabled = 0;   // 1: a command has enabled the laser
  TimeUs time_offset_us = 0;        // spacecraft time minus the component's
};

// The four octets by which an answer names its command, its first ones; 0 where they are not there.
std::uint32_t command_key(ConstBytes command);
// Is this telemetry of service 1? Then `key` becomes that of the command.
bool is_answer(ConstBytes telemetry, std::uint32_t& key);

constexpr std::size_t kMaxLinkReportBytes = 64;

// Whole packets; `header` says counts and time, service and subservice of a verification. The size, 0 when `out` is too small.
std::size_t encode_verification(const Verification& verification, const PacketHeader& header, Bytes out);
std::size_t encode_pong(PacketHeader header, Bytes out);
std::size_t encode_link(const LinkTelemetry& link, PacketHeader header, Bytes out);

}  // namespace lasso
