// The pose between two frames that the mission names (structure `named_pose`): a packet for each pair in the image, and none where there is
// none.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/span.hpp"
#include "fsw/core/time.hpp"
#include "fsw/link/filter_report.hpp"
#include "fsw/link/housekeeping.hpp"
#include "fsw/link/packet.hpp"
#include "fsw/link/pose_telemetry.hpp"

namespace lasso {

struct NamedPoseTelemetry {
  std::uint32_t scan_id = 0;
  TimeUs t_measurement_us = 0;
  std::uint8_t pair = 0;   // from 1, in the order of the image's table
  std::uint8_t pairs = 0;  // how many the image has
  std::uint8_t valid = 0;
  double q_in_of[4] = {0, 0, 0, 1};
  double p_in_of_m[3] = {};
  float covariance[kPoseCovarianceTerms] = {};
  std::uint8_t started = 0;  // the rest says nothing of a filter that is not
  TimeUs t_filter_us = 0;
  double filter_q_in_of[4] = {0, 0, 0, 1};
  double filter_p_in_of_m[3] = {};
  double filter_omega_radps[3] = {};
  double filter_v_mps[3] = {};
  float filter_covariance[kFilterCovarianceTerms] = {};
};

constexpr std::size_t kMaxNamedPoseBytes = 640;

// A whole packet; `header` says counts and time. The size, 0 when `out` is too small.
std::size_t encode_named_pose(const NamedPoseTelemetry& pose, const PacketHeader& header, Bytes out);

}  // namespace lasso
