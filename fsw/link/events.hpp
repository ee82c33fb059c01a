// Events (service 5): their numbers and severities. What each one says, how often at most, and its texts: event_rows.hpp.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/span.hpp"
#include "fsw/core/time.hpp"
#include "fsw/link/packet.hpp"

namespace lasso {

constexpr std::uint8_t kServiceEvent = 5;
constexpr std::uint8_t kSubserviceEnableEvent = 5;
constexpr std::uint8_t kSubserviceDisableEvent = 6;
constexpr std::uint8_t kSubserviceReportDisabled = 7;
constexpr std::uint8_t kSubserviceDisabledEvents = 8;

// The number is the subservice of the event's packet.
enum class Severity : std::uint8_t {
  kNone = 0,  // of no event
  kInformative = 1,
  kLow = 2,     // an anomaly that the component deals with
  kMedium = 3,  // one that costs poses
  kHigh = 4,    // one that needs somebody
};

// The numbers are on the wire, in the order of the rows, and never used again for something else.
enum class EventId : std::uint16_t {
  kNone = 0,
  kBegun = 1,
  kModeChanged = 2,
  kStartRefused = 3,
  kCommandRefused = 4,
  kCommandFailed = 5,
  kBytesSkipped = 6,
  kPacketsDropped = 7,
  kSensorChanged = 8,
  kSensorFailed = 9,
  kSensorBack = 10,
  kScanLost = 11,
  kEstimateLate = 12,
  kSlotLate = 13,
  kPartInconsistent = 14,
  kEventsSuppressed = 15,
  kEventsDropped = 16,
  kCommandArmed = 17,
  kArmExpired = 18,
  kLaserEnabled = 19,
  kLaserInhibited = 20,
  kTimeCorrelated = 21,
  kImageReady = 22,
  kImageRefused = 23,
  kImageActive = 24,
  kImageConfirmed = 25,
  kMemoryCorrupt = 26,
  kFaultConfirmed = 27,
  kFaultCleared = 28,
  kParameterChanged = 29,
  kParametersReverted = 30,
  kParametersRepaired = 31,
  kParametersLost = 32,
  kParametersSaved = 33,
  kParametersRestored = 34,
  kResetCommanded = 35,
  kCalibrationSelected = 36,
  kKeyOnTrial = 37,
  kKeyConfirmed = 38,
  kKeyGivenUp = 39,
  kEnd = 40  // behind the last one
};
constexpr std::size_t kEvents = static_cast<std::size_t>(EventId::kEnd);  // with kNone
constexpr std::size_t kMaxEventItems = 6;
constexpr std::size_t kMaxEventBytes = 32;  // of all items together
constexpr std::size_t kEventMaskBytes = 16;
static_assert(kEvents <= 8 * kEventMaskBytes, "a bit each");

// One that was raised: its items, as they are on the wire.
struct EventRecord {
  EventId id = EventId::kNone;
  Severity severity = Severity::kNone;
  std::uint8_t size = 0;  // of `items`
  bool reported = true;   // false: it is disabled, and for the stored log alone
  TimeUs t_us = 0;
  std::uint8_t items[kMaxEventBytes] = {};
};
constexpr std::size_t kMaxEventPacketBytes = kPacketHeaderBytes + kPacketNumberBytes + kMaxEventBytes + kPacketTrailerBytes;

// A whole packet; `header` says counts and time. The size, 0 when `out` is too small.
std::size_t encode_event(const EventRecord& event, PacketHeader header, Bytes out);

// One that was reported before, as the board's store has kept it.
constexpr std::uint8_t kSubserviceReportStored = 128;
constexpr std::uint8_t kSubserviceStoredEvent = 129;
struct StoredEventTelemetry {
  std::uint32_t sequence = 0;
  std::uint32_t start = 0;
  TimeUs t_us = 0;
  std::uint16_t event = 0;
  std::uint8_t severity = 0;
  std::uint8_t size = 0;
  std::uint8_t items[kMaxEventBytes] = {};
};

// Bit i % 8 of byte i / 8: event i is disabled.
struct DisabledEvents {
  std::uint8_t mask[kEventMaskBytes] = {};
};

}  // namespace lasso
