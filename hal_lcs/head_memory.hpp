// Where a measuring head and the processor beside it meet when both are in one housing: memory that both see, instead of a line
// (docs/in-sensor.md). Each word has one writer. Numbers are those of docs/icd/lcs.md, highest byte first, whoever's processor it is; times
// are of the one clock that both have.
//
// What the head writes says which command it is of: `answer` and `samples` in their high halves, `status` by its sequence. So the driver
// takes nothing of an earlier scan for its own, in whatever order they are written. The order that it asks for besides: a record before
// the count of `samples` that has it, and that count before a status that no longer says `scanning`.
//
// Nobody initialises it, and it outlives restarts of either end. A driver that starts writes dark, and gives an inhibit under a number
// that neither the last command nor the last answer has. A head that starts is dark until `beats` have moved since, and until a start; it
// leaves `answer` and `samples` as they are, and carries out a command when its number is another than that of `answer`; a frame that is
// damaged, or has another sequence, it refuses. When it has read all of a start it looks at `commands` once more: where that has moved on,
// first_us and aimed may be of the next start, and it refuses this one.
//
// What is no frame has no checksum. A bit that flips in first_us, aimed or records shows where a sample is against the plan or the pose;
// one in commands or answer costs a scan, or has the last command carried out again; one in laser puts it out until the next call.
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

// A frame that may be read while it is written, which its checksum tells. The fences are for the words about it: what was stored before the
// frame is there for who has loaded it. An acquiring load of such a word after the frame would not do, as it orders only what follows it:
// the processor might load the word before the frame, and so an older one. Each byte is loaded once: what was judged is what is taken.
class SharedFrame {
 public:
  void store(const FrameBytes& frame) {
    std::atomic_thread_fence(std::memory_order_release);
    for (std::size_t i = 0; i < frame.size; ++i) bytes_[i].value.store(frame.bytes[i], std::memory_order_relaxed);
  }
  // Whether there is a whole one.
  bool load(Frame& frame) const {
    std::uint8_t bytes[kMaxFrame];
    for (std::size_t i = 0; i < kMaxFrame; ++i) bytes[i] = bytes_[i].value.load(std::memory_order_relaxed);
    std::atomic_thread_fence(std::memory_order_acquire);
    FrameDecoder decoder;
    return decoder.step(ConstBytes(bytes), frame).found;
  }

 private:
  struct Byte {
    std::atomic<std::uint8_t> value{0};
  };
  Byte bytes_[kMaxFrame];
};

// A word that says which command it is of: the number in its high half, the value in its low one.
constexpr std::uint32_t numbered(std::uint16_t command, std::uint16_t value) { return (std::uint32_t{command} << 16) | value; }
constexpr std::uint16_t command_of(std::uint32_t numbered) { return static_cast<std::uint16_t>(numbered >> 16); }
constexpr std::uint16_t value_of(std::uint32_t numbered) { return static_cast<std::uint16_t>(numbered & 0xFFFFU); }
static_assert(kMaxRays <= 0xFFFF, "the samples of a scan are counted in half a word");

constexpr std::uint8_t sequence_of(std::uint16_t command) { return static_cast<std::uint8_t>(command & 0xFFU); }

constexpr std::uint32_t kLaserMayShine = 0x5AA5C33C;  // any other word keeps it dark
constexpr std::size_t kRecordBytes = 4 + kSampleBytes;

struct HeadMemory {
  // --- the processor's
  SharedWord laser;     // kLaserMayShine, or dark, which ends a scan
  SharedWord beats;     // counts calls of the driver: the head is dark where they have not moved for kUnheardUs
  SharedWord commands;  // its low half: the number of the last one, modulo 2^16; the one below is whole by then
  // A StartCommand, whose delay does not count, kAbort, or LaserCommand::kInhibit, which keeps the head dark until the next start, whatever
  // `laser` says; sequence_of(its number).
  SharedFrame command;
  std::uint8_t first_us[8] = {};              // of a start: when the first sample is to be taken
  std::uint8_t aimed[kMaxAimedRays][8] = {};  // of a start: its aimed rays, f32 x, f32 y

  // --- the head's
  SharedWord answer;                                  // numbered: the last command that it has answered, and its Result
  SharedWord samples;                                 // numbered: records of that start's scan that are there, from ray 0 on
  SharedFrame status;                                 // a CameraStatus; sequence_of(the last command that it has answered)
  std::uint8_t records[kMaxRays][kRecordBytes] = {};  // by ray: u32 low word of its time in us, then the sample of 0 us after it
};

static_assert(sizeof(HeadMemory) == std::size_t{20} + 2 * kMaxFrame + 8 + std::size_t{8} * kMaxAimedRays + kRecordBytes * kMaxRays,
              "nothing is between them");

}  // namespace lasso::lcs
