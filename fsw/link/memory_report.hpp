// Memory over the link (service 6), and mission images in flight, as plain values: what commands ask, and what the component answers.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/span.hpp"
#include "fsw/link/packet.hpp"

namespace lasso {

constexpr std::uint8_t kServiceMemory = 6;
constexpr std::uint8_t kSubserviceLoad = 2;
constexpr std::uint8_t kSubserviceDump = 5;
constexpr std::uint8_t kSubserviceDumped = 6;
constexpr std::uint8_t kSubserviceCheck = 9;
constexpr std::uint8_t kSubserviceChecked = 10;
constexpr std::size_t kMemoryBlockBytes = 128;

// All of the memory that commands can name.
enum class MemoryArea : std::uint8_t {
  kOtherImage = 0,   // being loaded: the only one that can be written to
  kActiveImage = 1,  // as it lies in memory
  kCode = 2,
};

struct ImageCommand {  // begin_image; activate_image without the length
  std::uint32_t bytes = 0;
  std::uint32_t crc = 0;
};
struct LoadCommand {
  std::uint8_t area = 0;  // MemoryArea
  std::uint32_t offset = 0;
  std::uint8_t bytes = 0;  // of data
  std::uint8_t data[kMemoryBlockBytes] = {};
};
struct MemoryCommand {
  std::uint8_t area = 0;
  std::uint32_t offset = 0;
  std::uint32_t bytes = 0;
};
struct MemorySum {
  std::uint8_t area = 0;
  std::uint32_t offset = 0;
  std::uint32_t bytes = 0;
  std::uint32_t crc = 0;
};

constexpr std::size_t kMissingRuns = 8;
struct ImageTelemetry {
  std::uint32_t active_crc = 0;
  std::uint8_t active_buffer = 0;
  std::uint8_t confirmed = 0;
  std::uint8_t active_stored = 0;
  std::uint8_t other_state = 0;   // ImageState
  std::uint32_t other_bytes = 0;  // of the image that is there, or being loaded
  std::uint32_t other_crc = 0;    // as announced
  std::uint8_t other_stored = 0;
  std::uint32_t blocks = 0;
  std::uint32_t loaded = 0;                        // of them
  std::uint32_t missing_first[kMissingRuns] = {};  // the first runs of blocks that have not come
  std::uint32_t missing_blocks[kMissingRuns] = {};
  std::uint8_t status = 0;  // Status of the other image
  std::uint32_t table = 0, record = 0;
  std::uint32_t activations = 0, roll_backs = 0;
  std::uint32_t scrub_passes = 0, scrub_pass_us = 0;
  std::uint32_t findings = 0, repairs = 0;
};
constexpr std::size_t kMaxImagePacketBytes = 256;

// A whole packet; `header` says counts and time. The size, 0 when `out` is too small.
std::size_t encode_image(const ImageTelemetry& image, PacketHeader header, Bytes out);

}  // namespace lasso
