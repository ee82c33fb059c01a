// A trace: how one run began, and its whole conversation with the sensor, call by call with every argument and answer. Played back, it
// gives the flight component on any processor the input of that run, and refuses a component that asks for anything else.
//
// Big-endian. Header (kTraceHeaderBytes): "3DLT", u32 version, u32 frames, i64 time of boundary 0 [us], then the start of the track:
// f64 quaternion x y z w, position [m] x y z, rates [rad/s] x y z and [m/s] x y z, i64 time [us]. Calls follow until the end of the file:
//   u8 1 start:  plan, i64 t_start_us                 answer: u8 status
//   u8 2 poll:   i64 now_us, u32 samples asked for    answer: u8 status, u32 count, u8 complete, samples
//   u8 3 abort
// Floating point is written as its bits, so that equal bytes mean equal bits.
#pragma once

#include <cstdint>
#include <vector>

#include "fsw/core/byte_codec.hpp"
#include "fsw/geometry/se3.hpp"
#include "fsw/sense/sensor.hpp"

namespace lasso::golden {

constexpr std::uint32_t kTraceVersion = 2;
constexpr std::size_t kTraceHeaderBytes = 132;

struct TraceHeader {
  std::uint32_t frames = 0;  // that the component ran
  TimeUs boundary_0_us = 0;
  Pose T_sensor_target;  // where tracking started
  Twist rates;
  TimeUs t_us = 0;  // of that start
};

void put(ByteWriter& out, const TraceHeader& header);
// kBadMagic, kBadVersion or kTruncated: `header` is then not to be used.
Status get(ByteReader& in, TraceHeader& header);

// What the component asked: kind and arguments.
void put_start(ByteWriter& out, const ScanPlan& plan, TimeUs t_start_us);
void put_poll(ByteWriter& out, TimeUs now_us, std::size_t samples);
void put_abort(ByteWriter& out);

// What the sensor answered.
void put_answer(ByteWriter& out, const SensorPoll& poll, Span<const RangeSample> samples);
// False when the bytes end early or hold more samples than `out` takes.
bool get_answer(ByteReader& in, SensorPoll& poll, Span<RangeSample> out);

// Enough for any call or answer.
constexpr std::size_t kMaxCallBytes = 128 + 32 * kMaxSamplesPerPoll + 8 * kMaxAimedRays;

}  // namespace lasso::golden
