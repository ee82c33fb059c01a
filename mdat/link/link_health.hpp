// How well telemetry comes: packets, those that are missing by their sequence counts, and how many come a second.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>

#include "fsw/core/span.hpp"

namespace lasso::mdat {

constexpr std::chrono::seconds kRateWindow(5);

class LinkHealth {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // Whole packets, one behind the other, that came at `now`. A count that goes back by any number is a restart, and no gap.
  void take(ConstBytes packets, Time now);

  std::uint64_t packets() const { return packets_; }
  std::uint64_t missing() const { return missing_; }
  // Of the last kRateWindow before `now`, or since the first packet, where that is less; 0 before it.
  double rate_per_s(Time now) const;
  // Since the last packet; negative: there was none.
  double age_s(Time now) const;

 private:
  struct Batch {
    Time at;
    std::uint64_t packets;
  };
  std::uint64_t packets_ = 0, missing_ = 0;
  std::map<std::uint16_t, std::uint16_t> counts_;  // the last one of each APID
  std::deque<Batch> recent_;
  Time first_{};
};

}  // namespace lasso::mdat
