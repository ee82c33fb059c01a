#include "ft/pil/store_story.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <utility>

#include "fsw/exec/executive.hpp"
#include "fsw/mode/modes.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/link/command_encoder.hpp"
#include "mdat/link/decode.hpp"
#include "mdat/link/upload.hpp"

namespace lasso::pil {
namespace {

constexpr std::uint32_t kSlot = 3;            // of a frame, in which the ground sends
constexpr std::size_t kBlock = 128;           // bytes of load_memory
constexpr std::size_t kBlocksPerFrame = 6;    // of the 8 commands that a frame takes
constexpr std::uint32_t kDamageAt = 0x20000;  // in the image
constexpr std::uint8_t kFlip = 0x10;          //
constexpr std::uint32_t kDamageFrame = 4;     // of the second start
constexpr std::uint32_t kScrubFrames = 46;    // a pass of 8 s, and what its answer takes
constexpr const char* kParameter = "tracking.coast_frames";
constexpr const char* kStored = "8";  // the first events of the log, which are of the first start

std::string number(std::uint64_t value) { return std::to_string(value); }

}  // namespace

StoreStory::StoreStory(std::vector<std::uint8_t> image, std::uint32_t buffer, std::uint32_t memory, std::string folder)
    : image_(std::move(image)), place_(buffer + kDamageAt), memory_(memory), folder_(std::move(folder)) {}

void StoreStory::send(const std::string& command, const Values& values) {
  const Packet packet = mdat::encode_command(mdat::command_row(command), {values.begin(), values.end()}, count_++);
  packets_.insert(packets_.end(), packet.begin(), packet.end());
}

void StoreStory::send_armed(const std::string& command, const Values& values) {
  const Packet arm = mdat::arm_for(mdat::command_row(command), count_++);
  packets_.insert(packets_.end(), arm.begin(), arm.end());
  if (command != "load_memory") send(command, values);
}

void StoreStory::begin_image() {
  loaded_ = 0;
  send("begin_image", {{"bytes", number(image_.size())}, {"crc", number(mdat::image_crc(image_))}});
  send_armed("load_memory");  // renewed by each block
}

void StoreStory::load_some() {
  for (std::size_t i = 0; i < kBlocksPerFrame && loaded_ < image_.size(); ++i, loaded_ += kBlock) {
    const std::size_t bytes = std::min(kBlock, image_.size() - loaded_);
    std::string data;
    for (std::size_t k = 0; k < kBlock; ++k) data += (k > 0 ? "," : "") + number(k < bytes ? image_[loaded_ + k] : 0U);
    send("load_memory", {{"area", "other_image"}, {"offset", number(loaded_)}, {"bytes", number(bytes)}, {"data", data}});
  }
}

Packet StoreStory::commands(std::uint32_t start, std::uint32_t slot, std::uint16_t& count) {
  if (slot % kSlotsPerFrame != kSlot) return {};
  const std::uint32_t frame = slot / kSlotsPerFrame;
  count_ = count;
  if (start == 0) first_start(frame);
  if (start == 1) second_start(frame);
  if (start == 2) third_start(frame);
  count = count_;
  return std::exchange(packets_, {});
}

void StoreStory::first_start(std::uint32_t frame) {
  if (frame == 1) send("set_parameter", {{"parameter", kParameter}, {"value", "17"}});
  if (frame == 1) send("save_parameters");
  if (frame == 2) begin_image();
  if (frame == 3 || frame == 4) load_some();
  if (frame == 5) send("report_structure", {{"structure", "image"}});
  if (frame == 5) send_armed("reset");
}

void StoreStory::second_start(std::uint32_t frame) {
  if (frame == 1) send("report_stored_events", {{"last", kStored}, {"count", kStored}});
  if (frame == 2) send("restore_parameters");
  if (frame == 2) send("report_parameter", {{"parameter", kParameter}});
  if (frame == 3) begin_image();
  if (frame == kDamageFrame) damage();
  if (frame <= 3 || end_frame_ > 0) {
    if (end_frame_ > 0 && frame == end_frame_) send_armed("activate_image", {{"crc", number(mdat::image_crc(image_))}});
    if (end_frame_ > 0 && frame == end_frame_ + 3) send_armed("reset");
    return;
  }
  if (loaded_ < image_.size()) return load_some();
  send("check_image");
  // A slot does 2048 words or 4096 bytes of checking, storing, converting, sealing: by then it is ready.
  const auto work = static_cast<std::uint32_t>(image_.size() / 4096 * 4 / kSlotsPerFrame);
  end_frame_ = std::max(frame + 3 + work, kDamageFrame + kScrubFrames);
}

void StoreStory::third_start(std::uint32_t frame) {
  if (frame == 1) send("report_structure", {{"structure", "image"}});
  if (frame == 2) send_armed("roll_back_image");
}

std::uint8_t StoreStory::byte_of_memory() const {
  std::ifstream memory(folder_ + "/ram.bin", std::ios::binary);
  char byte = 0;
  if (!memory.seekg(place_ - memory_) || !memory.get(byte)) throw mdat::RunError(folder_ + "/ram.bin: the board's memory cannot be read");
  return static_cast<std::uint8_t>(byte);
}

void StoreStory::damage() {
  right_ = byte_of_memory();
  gdb_.connect(folder_ + "/gdb.sock");
  gdb_.write(place_, right_ ^ kFlip);
  gdb_.go_on();
  if (byte_of_memory() == right_) throw mdat::RunError("the emulator's debug port has not damaged the image");
}

bool StoreStory::repaired() { return byte_of_memory() == right_; }

std::string told_of_store(const Packet& telemetry) {
  const mdat::DecodedStream stream = mdat::decode_stream({telemetry.data(), telemetry.size()}, PacketType::kTelemetry);
  std::map<std::string, std::uint64_t> first, last;
  std::string events;
  std::size_t safe = 0;
  for (const mdat::DecodedPacket& packet : stream.packets) {
    const std::string name = packet.name();
    for (const mdat::DecodedItem& item : packet.items) {
      const auto value = static_cast<std::uint64_t>(mdat::value_of(item.values.at(0)));
      last[name + "." + item.row->name] = value;
      first.try_emplace(name + "." + item.row->name, value);
    }
    if (name == "pose" && last["pose.mode"] == static_cast<std::uint64_t>(TrackingMode::kSafe)) ++safe;
    if (name == "stored_event") events += (events.empty() ? "" : ",") + number(last["stored_event.event"]);
  }
  std::string text = "store: first=" + number(first["image.active_crc"]) + " safe=" + number(safe) +
                     " log_start=" + number(first["stored_event.start"]) + " log=" + events;
  for (const char* item : {"image.active_crc", "image.active_stored", "image.loaded", "image.findings", "image.repairs", "image.roll_backs",
                           "parameter.value", "parameter.changed"})
    text += std::string(" ") + item + "=" + number(last[item]);
  return text;
}

}  // namespace lasso::pil
