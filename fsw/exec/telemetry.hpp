// What the component reports to the ground: events, structures of telemetry where they are due, and the log of events that survives a
// restart. Used by one thread.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/span.hpp"
#include "fsw/core/time.hpp"
#include "fsw/exec/stored_log.hpp"
#include "fsw/link/downlink.hpp"
#include "fsw/link/event_log.hpp"
#include "fsw/link/housekeeping.hpp"

namespace lasso {

class Telemetry {
 public:
  // Of the component `apid`.
  explicit Telemetry(std::uint16_t apid) : downlink_(apid) {}

  // See EventLog::raise().
  template <EventId kId, class... Values>
  void raise(Values... values) {
    events_.raise<kId>(values...);
  }

  // A structure (service 3), by the encoder of its packet, which has at most kMaxBytes.
  template <std::size_t kMaxBytes, auto kEncode, class Report>
  void send_structure(const Report& report, TimeUs now_us) {
    std::uint8_t packet[kMaxBytes];
    downlink_.send({packet, kEncode(report, downlink_.next_header(kHousekeepingReport, now_us), Bytes(packet))});
  }

  // A boundary's last work: the events since the one before are sent and noted for the stored log, and the structures' periods go on. Loop
  // bound: kMaxEventsPerFrame.
  void pass_boundary();

  EventLog& events() { return events_; }
  Downlink& downlink() { return downlink_; }
  Housekeeping& housekeeping() { return housekeeping_; }
  StoredLog& stored_log() { return stored_log_; }

 private:
  Downlink downlink_;
  EventLog events_;
  Housekeeping housekeeping_;
  StoredLog stored_log_;
};

}  // namespace lasso
