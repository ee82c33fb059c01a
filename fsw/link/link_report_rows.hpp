// The rows of what the link says of commands. For the ground: see row.hpp.
#pragma once

#include "fsw/link/choices.hpp"
#include "fsw/link/event_rows.hpp"
#include "fsw/link/events.hpp"
#include "fsw/link/link_report.hpp"
#include "fsw/link/row.hpp"

namespace lasso::link_report_rows {

using V = Verification;
using L = LinkTelemetry;

// clang-format off
inline constexpr TypedRow<V> kDone[] = {
  make_row<&V::packet_id>(1, "packet_id", "1", kAny, "first two bytes of the command"),
  make_row<&V::sequence_control>(2, "sequence_control", "1", kAny, "the two bytes behind them: sequence flags and count"),
};
inline constexpr TypedRow<V> kRefused[] = {
  make_row<&V::packet_id>(1, "packet_id", "1", kAny, "first two bytes of the command, 0 where they are not there"),
  make_row<&V::sequence_control>(2, "sequence_control", "1", kAny, "the two bytes behind them: sequence flags and count"),
  make_row<&V::fault>(3, "fault", kPacketFault, "why it is refused"),
};
inline constexpr TypedRow<V> kFailed[] = {
  make_row<&V::packet_id>(1, "packet_id", "1", kAny, "first two bytes of the command"),
  make_row<&V::sequence_control>(2, "sequence_control", "1", kAny, "the two bytes behind them: sequence flags and count"),
  make_row<&V::mode_refusal>(4, "mode_refusal", kModeRefusal, "why a mode cannot be commanded"),
  make_row<&V::start_refusal>(5, "start_refusal", kStartRefusal, "why a pose to start from is refused"),
  make_row<&V::service_refusal>(6, "service_refusal", kServiceRefusal, "why any other command cannot be carried out"),
};
inline constexpr TypedRow<L> kLink[] = {
  make_row<&L::accepted_commands>(1, "accepted_commands", "1", kAny, "commands that were accepted"),
  make_row<&L::refused_commands>(2, "refused_commands", "1", kAny, "commands that were refused"),
  make_row<&L::last_fault>(3, "last_fault", kPacketFault, "why the last of them was"),
  make_row<&L::skipped_bytes>(4, "skipped_bytes", "1", kAny, "bytes from the ground that belonged to no packet"),
  make_row<&L::queue_peak>(5, "queue_peak", "1", kAny, "most bytes of telemetry that waited at a time"),
  make_row<&L::armed>(6, "armed", kYesNo, "a hazardous command may be fired"),
  make_row<&L::laser_enabled>(7, "laser_enabled", kYesNo, "a command has enabled the laser, and none has inhibited it since"),
  make_row<&L::time_offset_us>(8, "time_offset_us", "us", kAny, "spacecraft time (of the headers) minus the component's (of the items)"),
};
inline constexpr TypedRow<DisabledEvents> kDisabled[] = {
  make_row<&DisabledEvents::mask>(1, "mask", "1", kAny, "bit i % 8 of byte i / 8: event i is disabled"),
};
inline constexpr TypedRow<StoredEventTelemetry> kStoredEvent[] = {
  make_row<&StoredEventTelemetry::sequence>(1, "sequence", "1", kAny, "counts the events that were kept, over all starts"),
  make_row<&StoredEventTelemetry::start>(2, "start", "1", kAny, "counts the starts: the one that it belongs to"),
  make_row<&StoredEventTelemetry::t_us>(3, "t_us", "us", kAny, "when, by the component's time of that start"),
  make_row<&StoredEventTelemetry::event>(4, "event", event_rows::Names::kEvent, "the event"),
  make_row<&StoredEventTelemetry::severity>(5, "severity", "1", Range{1, 4}, "1 informative, 2 low, 3 medium, 4 high"),
  make_row<&StoredEventTelemetry::size>(6, "size", "1", Range{0, static_cast<double>(kMaxEventBytes)}, "that count of data"),
  make_row<&StoredEventTelemetry::items>(7, "items", "1", kAny, "the bytes of the event's items, then zeros"),
};
inline constexpr TypedRow<ParameterTelemetry> kParameter[] = {
  make_row<&ParameterTelemetry::parameter>(1, "parameter", "1", kAny, "its id"),
  make_row<&ParameterTelemetry::value>(2, "value", "as it says", kAny, "in the parameter's unit; from the next boundary on"),
  make_row<&ParameterTelemetry::image_value>(3, "image_value", "as it says", kAny, "the mission image's value"),
  make_row<&ParameterTelemetry::changed>(4, "changed", kYesNo, "it was changed by command"),
};
// clang-format on

}  // namespace lasso::link_report_rows
