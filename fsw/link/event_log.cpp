#include "fsw/link/event_log.hpp"

namespace lasso {
namespace {

// What flight code keeps of the rows.
struct FlightRow {
  Severity severity = Severity::kNone;
  Throttle throttle = kEach;
  WireType types[kMaxEventItems] = {};
};
struct FlightRows {
  FlightRow of[kEvents] = {};
};
constexpr FlightRows flight_rows() {
  FlightRows rows;
  for (const EventRow& row : event_rows::kRows) {
    FlightRow& kept = rows.of[static_cast<std::size_t>(row.id)];
    kept.severity = row.severity;
    kept.throttle = row.throttle;
    for (std::size_t i = 0; i < row.items.size(); ++i) kept.types[i] = row.items.begin()[i].type;
  }
  return rows;
}
constexpr FlightRows kRows = flight_rows();

constexpr bool items_fit() {
  for (const EventRow& row : event_rows::kRows) {
    std::size_t bytes = 0;
    for (const ItemRow& item : row.items) bytes += item.size();
    if (bytes > kMaxEventBytes) return false;
    if (row.items.size() > kMaxEventItems) return false;
  }
  return true;
}
static_assert(items_fit(), "items of an event that no record holds");

const FlightRow& flight_row(EventId id) { return Span<const FlightRow>(kRows.of)[static_cast<std::size_t>(id)]; }

}  // namespace

void write_value(WireType type, const EventValue& value, ByteWriter& out) {
  switch (type) {
    case WireType::kU8:
      return out.u8(static_cast<std::uint8_t>(value.whole));
    case WireType::kU16:
      return out.u16(static_cast<std::uint16_t>(value.whole));
    case WireType::kU32:
      return out.u32(static_cast<std::uint32_t>(value.whole));
    case WireType::kI64:
      return out.i64(value.whole);
    case WireType::kF32:
      return out.f32(static_cast<float>(value.real));
    default:
      return out.f64(value.real);
  }
}

void EventLog::record(EventId id, Span<const EventValue> values) {
  State& state = Span<State>(states_)[static_cast<std::size_t>(id)];
  if (!admit(id, state)) return;
  const FlightRow& row = flight_row(id);
  EventRecord event;
  event.id = id;
  event.severity = row.severity;
  event.reported = !state.disabled;
  event.t_us = now_us_;
  ByteWriter writer{Bytes(event.items)};
  for (std::size_t i = 0; i < values.size(); ++i) write_value(Span<const WireType>(row.types)[i], values[i], writer);
  event.size = static_cast<std::uint8_t>(writer.size());
  if (!records_.push_back(event)) ++dropped_;
}

bool EventLog::admit(EventId id, State& state) {
  const Throttle throttle = flight_row(id).throttle;
  if (throttle.most == 0) return true;
  if (state.frames_left == 0 || state.frames_left > throttle.frames) {  // more are a flipped bit
    state.frames_left = throttle.frames;
    state.reported = 0;
  }
  if (state.reported >= throttle.most) {
    ++state.suppressed;
    return false;
  }
  ++state.reported;
  return true;
}

bool EventLog::set_enabled(std::uint16_t event, bool enabled) {
  if (event == 0 || event >= kEvents) return false;
  states_[event].disabled = !enabled;
  return true;
}

DisabledEvents EventLog::disabled() const {
  DisabledEvents disabled;
  for (std::size_t i = 0; i < kEvents; ++i) {
    if (states_[i].disabled) disabled.mask[i / 8] = static_cast<std::uint8_t>(disabled.mask[i / 8] | 1U << i % 8);
  }
  return disabled;
}

// A flipped bit can make a window end early, or begin anew: what was suppressed in it is told after two windows at the latest.
void EventLog::pass_boundary() {
  records_.clear();
  for (std::size_t i = 0; i < kEvents; ++i) {
    State& state = states_[i];
    const std::uint16_t longest = kRows.of[i].throttle.frames;
    if (state.frames_left > longest) state.frames_left = longest;
    if (state.frames_left > 0) --state.frames_left;
    if (state.frames_left > 0 || state.suppressed == 0) continue;
    if (!state.disabled) raise<EventId::kEventsSuppressed>(i, state.suppressed);
    state.suppressed = 0;
  }
  if (dropped_ != dropped_told_) raise<EventId::kEventsDropped>(dropped_);
  dropped_told_ = dropped_;
}

}  // namespace lasso
