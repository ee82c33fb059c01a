// What sensors gave, scan by scan, as it was asked for: in memory, and as the bytes of a file.
//
// The bytes are big-endian: "3DLR", u32 version, then scan by scan until the end: u8 sensor; the plan: u32 scan, u8 pattern, u16 points,
// cycles a, cycles b, f64 phase, centre x, y, half extent x, y, i64 duration; u16 aimed rays, each f32 x, y; i64 start; u8 end (Status);
// u16 samples, each f32 direction x, y, z, f32 range, i64 time, u8 state.
#pragma once

#include <cstdint>
#include <vector>

#include "fsw/core/span.hpp"
#include "fsw/core/status.hpp"
#include "fsw/sense/sensor.hpp"

namespace lasso::sim {

constexpr std::uint32_t kRecordingVersion = 2;
constexpr DurationUs kRecordingToleranceUs = 100'000;  // a line's commands and a head's clock move samples by less

struct SensorScan {
  std::uint8_t sensor = 0;  // its number
  ScanPlan plan;            // without its aimed rays
  std::vector<AimedRay> aimed;
  TimeUs t_start_us = 0;
  std::vector<RangeSample> samples;
  Status end = Status::kNoData;  // kOk: whole; kNoData: it was aborted; else the reason for which it was lost
};
using SensorRecording = std::vector<SensorScan>;

std::vector<std::uint8_t> to_bytes(const SensorRecording& recording);

// Throws std::invalid_argument that says at which byte, and in which scan, what is wrong: another kind or version of file, an end in the
// middle of a scan, a plan, an end or a state that none is, more rays than the component takes, a number that is not finite, a start beyond
// 2^61 us, samples whose times go back or are more than kRecordingToleranceUs outside of their scan.
SensorRecording recording_of(ConstBytes bytes);

}  // namespace lasso::sim
