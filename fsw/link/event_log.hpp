// Where events are raised: `log.raise<EventId::kScanLost>(sensor, scan_id)`, with as many values as the event's row has items, checked
// while it is compiled. What is raised waits for the frame's end: so many and no more, the rest is counted. An event that is disabled is
// not reported, but stays a record for the log that survives a restart; each is throttled as its row says. Used by one thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "cfg/capacities.hpp"
#include "fsw/core/fixed_vector.hpp"
#include "fsw/core/span.hpp"
#include "fsw/core/time.hpp"
#include "fsw/link/event_rows.hpp"
#include "fsw/link/events.hpp"

namespace lasso {

// One of them holds, as the item's type says.
struct EventValue {
  std::int64_t whole = 0;
  double real = 0;
};

// As the type says; what does not fit is cut as static_cast cuts.
void write_value(WireType type, const EventValue& value, ByteWriter& out);

class EventLog {
 public:
  // The time of what is raised from now on.
  void set_time(TimeUs now_us) { now_us_ = now_us; }

  // Values are numbers or enumerators.
  template <EventId kId, class... Values>
  void raise(Values... values) {
    static_assert(fits<Values...>(event_rows::row_of(kId).items), "the items of the event's row");
    const EventValue all[] = {value_of(values)..., EventValue{}};
    record(kId, Span<const EventValue>(all, sizeof...(Values)));
  }

  // False: there is no such event.
  bool set_enabled(std::uint16_t event, bool enabled);
  DisabledEvents disabled() const;

  // What was raised since the last boundary and is to be reported, or kept, in that order.
  Span<const EventRecord> records() const { return records_.span(); }
  // A frame ends, its records have been reported: raises what was suppressed, if its time is over, and dropped. Loop bound: kEvents.
  void pass_boundary();

  std::uint32_t dropped() const { return dropped_; }

 private:
  struct State {
    bool disabled = false;
    std::uint16_t reported = 0;     // of the present window
    std::uint16_t frames_left = 0;  // of it; 0: none
    std::uint32_t suppressed = 0;   // in it
  };

  template <class... Values>
  static constexpr bool fits(Span<const ItemRow> items) {
    const bool real[] = {std::is_floating_point_v<Values>..., false};
    if (items.size() != sizeof...(Values)) return false;
    for (std::size_t i = 0; i < sizeof...(Values); ++i) {
      if (real[i] != is_real(items.begin()[i].type)) return false;
    }
    return true;
  }
  template <class Value>
  static constexpr EventValue value_of(Value value) {
    if constexpr (std::is_floating_point_v<Value>) {
      return {0, static_cast<double>(value)};
    } else {
      return {static_cast<std::int64_t>(value), 0};
    }
  }
  void record(EventId id, Span<const EventValue> values);
  static bool admit(EventId id, State& state);

  TimeUs now_us_ = 0;
  FixedVector<EventRecord, kMaxEventsPerFrame> records_;
  State states_[kEvents];
  std::uint32_t dropped_ = 0;
  std::uint32_t dropped_told_ = 0;
};

}  // namespace lasso
