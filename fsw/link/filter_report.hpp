// What the packet pose leaves out (structure `filter`): the covariance of the tracking filter as a whole, and what the errors that a scan's
// rays have in common do to its pose.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/span.hpp"
#include "fsw/core/time.hpp"
#include "fsw/link/housekeeping.hpp"
#include "fsw/link/packet.hpp"

namespace lasso {

constexpr std::size_t kFilterStates = 12;
constexpr std::size_t kCommonTerms = std::size_t{6} * 4;
constexpr std::size_t kFilterCovarianceTerms = kFilterStates * (kFilterStates + 1) / 2;

struct FilterTelemetry {
  std::uint32_t scan_id = 0;
  TimeUs t_us = 0;           // at which the filter's pose and rates are stated
  std::uint8_t started = 0;  // the rest says nothing of a filter that is not
  std::uint32_t accepted = 0, rejected = 0;
  float covariance[kFilterCovarianceTerms] = {};
  float common[kCommonTerms] = {};
};

constexpr std::size_t kMaxFilterBytes = 480;

// A whole packet; `header` says counts and time. The size, 0 when `out` is too small.
std::size_t encode_filter(const FilterTelemetry& filter, const PacketHeader& header, Bytes out);

}  // namespace lasso
