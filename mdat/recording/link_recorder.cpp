#include "mdat/recording/link_recorder.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;

// By which times of packets go back though the clock goes on: an event has the time at which it happened.
constexpr TimeUs kUnordered_us = 2'000'000, kUnorderedAtBegin_us = 500'000;
constexpr std::size_t kMostHeld = 100;

bool is_named(const DecodedPacket& packet, std::string_view name) { return packet.row != nullptr && name == packet.row->name; }

// FILE.mcap, FILE-2.mcap, ...; of the further ones the first that is free.
fs::path file_of(const fs::path& first, std::size_t number) {
  if (first.empty() || number == 1) return first;
  fs::path file;
  for (std::size_t i = number; file.empty() || fs::exists(file); ++i)
    file = first.parent_path() / (first.stem().string() + "-" + std::to_string(i) + first.extension().string());
  return file;
}

}  // namespace

LinkRecorder::LinkRecorder(LinkRecorderOptions options) : options_(std::move(options)) { begin(); }

void LinkRecorder::begin() {
  if (recorder_) recorder_->close({});
  recorder_.reset();
  files_.push_back(file_of(options_.file, files_.size() + 1));
  recorder_ = std::make_unique<FrameRecorder>(files_.back(), options_.target, options_.head, options_.tap);
  latest_us_ = 0;
}

void LinkRecorder::take(const DecodedPacket& packet) {
  PacketHeader header;
  ConstBytes data;
  const std::uint16_t apid = apid_of(packet.bytes);
  if (parse_packet(packet.bytes, header, data, apid) != PacketFault::kNone) return;
  PoseTelemetry told;
  std::optional<PoseTelemetry> pose;
  if (decode_pose(packet.bytes, header, told, apid) == PacketFault::kNone) pose = told;
  if (pose) offset_us_ = header.t_us - pose->t_publication_us;
  if (!offset_us_ && header.time_status == kTimeStatusCorrelated && held_.size() < kMostHeld) {
    held_.emplace_back(packet.bytes.data(), packet.bytes.data() + packet.bytes.size());
    return;
  }
  write_held();
  write(packet, header.t_us, pose);
}

// With spacecraft time in the headers, only a packet `pose` says what the component's own time is.
void LinkRecorder::write_held() {
  for (const std::vector<std::uint8_t>& bytes : std::exchange(held_, {})) {
    const DecodedPacket packet = decode_packet({bytes.data(), bytes.size()}, PacketType::kTelemetry);
    PacketHeader header;
    ConstBytes data;
    if (parse_packet(packet.bytes, header, data, apid_of(packet.bytes)) == PacketFault::kNone) write(packet, header.t_us, std::nullopt);
  }
}

void LinkRecorder::write(const DecodedPacket& packet, TimeUs header_us, const std::optional<PoseTelemetry>& pose) {
  const TimeUs t_us = std::max<TimeUs>(0, header_us - offset_us_.value_or(0));
  const TimeUs unordered_us = is_named(packet, "begun") ? kUnorderedAtBegin_us : kUnordered_us;
  if (t_us < latest_us_ - unordered_us) begin();
  latest_us_ = std::max(latest_us_, t_us);
  recorder_->on_packets(latest_us_, packet.bytes);
  if (!pose) return;
  recorder_->on_report(*pose);
  ++frames_;
  valid_frames_ += pose->valid;
  last_ = pose;
}

void LinkRecorder::close() { recorder_->close({}); }

}  // namespace lasso::mdat
