// Where a measuring head and the processor beside it meet when both are in one housing: memory that both see, instead of a line
// (docs/in-sensor.md). Each word has one writer. Numbers are those of docs/icd/lcs.md, highest byte first, whoever's processor it is; times
// are of the one clock that both have.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "cfg/capacities.hpp"
#include "hal_lcs/frame.hpp"
#include "hal_lcs/sample_codec.hpp"

namespace lasso::lcs {

// What was written before a store is there for who has loaded its value.
class SharedWord {
 public:
  std::uint32_t load() const { return highest_first(word_.load(std::memory_order_acquire)); }
  void store(std::uint32_t value) { word_.store(highest_first(value), std::memory_order_release); }

 private:
  // Either way.
  static std::uint32_t highest_first(std::uint32_t value) {
    const std::uint8_t bytes[4] = {static_cast<std::uint8_t>(value >> 24), static_cast<std::uint8_t>(value >> 16),
                                   static_cast<std::uint8_t>(value >> 8), static_cast<std::uint8_t>(value)};
    std::uint32_t word = 0;
    std::memcpy(&word, bytes, sizeof word);
    return word;
  }
  std::atomic<std::uint32_t> word_{0};
};

constexpr std::uint32_t kLaserMayShine = 0x5AA5C33C;  // any other word keeps it dark
constexpr std::size_t kRecordBytes = 4 + kSampleBytes;

struct HeadMemory {
  // --- the processor's
  SharedWord laser;     // kLaserMayShine, or dark, which ends a scan
  SharedWord beats;     // counts calls of the driver: where it stands still for kUnheardUs the head is dark by itself
  SharedWord commands;  // given; the one below is whole when it is counted
  std::uint8_t command[kMaxFrame] =
      {};                         // the frame of a StartCommand, whose delay does not count, or of kAbort; sequence: its number's low byte
  std::uint8_t first_us[8] = {};  // of a start: when the first sample is to be taken
  std::uint8_t aimed[kMaxAimedRays][8] = {};  // of a start: its aimed rays, f32 x, f32 y

  // --- the head's
  SharedWord done;                                    // the last command that it has answered
  SharedWord result;                                  // of it: Result
  SharedWord samples;                                 // records of its scan that are there, from ray 0 on
  std::uint8_t status[kMaxFrame] = {};                // the frame of a CameraStatus; `scanning` ends after the last record is there
  std::uint8_t records[kMaxRays][kRecordBytes] = {};  // by ray: u32 low word of its time in us, then the sample of 0 us after it
};

}  // namespace lasso::lcs
