// Bytes of the laser camera's line, given to the frame decoder in pieces, and what its frames say to the decoders of messages. Every byte
// is accounted for, a frame is what its own encoding gives, and a message that is accepted says the payload again. The first byte: bit 0
// leaves the bytes as they are, else they are the types, lengths and payloads of frames, whose sync, sequence and checksum are made
// right; the others say how large the pieces are.
#include <algorithm>
#include <cstring>

#include "ft/fuzz/exact.hpp"
#include "hal_lcs/messages.hpp"
#include "hal_lcs/table.hpp"

namespace lasso::fuzz {
namespace {

constexpr std::size_t kMostBytes = 4096;

struct Stream {
  std::uint8_t bytes[kMostBytes];
  std::size_t size = 0;

  void append(ConstBytes more) {
    const std::size_t count = std::min(more.size(), kMostBytes - size);
    if (count > 0) std::memcpy(bytes + size, more.data(), count);
    size += count;
  }
};

void make_frames(ConstBytes input, Stream& stream) {
  std::uint8_t sequence = 0;
  for (std::size_t at = 0; at + 2 <= input.size();) {
    const std::size_t length = std::min<std::size_t>(input[at + 1] % (lcs::kMaxPayload + 1), input.size() - at - 2);
    stream.append(lcs::encode_frame(input[at], sequence++, input.subspan(at + 2, length)).span());
    at += 2 + length;
  }
}

bool same(const lcs::FrameBytes& again, const lcs::Frame& frame) {
  const lcs::FrameBytes bytes = lcs::encode_frame(frame.type, frame.sequence, frame.bytes());
  return again.size == bytes.size && std::memcmp(again.bytes, bytes.bytes, bytes.size) == 0;
}

// A phase of all steps is below one turn, and the laser's state and a whole scan have bits that nobody has defined: those are read, no
// more.
template <class Message>
bool accepted(const lcs::Frame& frame, Message& message) {
  return decode(frame, message) == Status::kOk;
}

void check_messages(const lcs::Frame& frame) {
  lcs::LaserCommand laser{};
  lcs::AimCommand aim;
  lcs::StartCommand start;
  lcs::Answer answer;
  lcs::CameraStatus status;
  lcs::Samples samples;
  lcs::ScanEnd end;
  lcs::TablePart part;
  const auto type = static_cast<lcs::Type>(frame.type);
  if (accepted(frame, laser) && type == lcs::Type::kLaser)
    expect(same(lcs::encode(frame.sequence, laser), frame), "a laser command says itself");
  if (accepted(frame, aim)) expect(aim.count > 0 && aim.count <= lcs::kAimedPerFrame, "aimed rays fit");
  if (accepted(frame, start)) expect(start.plan.phase_turns >= 0 && start.plan.phase_turns < 1, "a phase is below one turn");
  if (accepted(frame, answer) && type == lcs::Type::kAnswer)
    expect(same(lcs::encode(frame.sequence, answer), frame), "an answer says itself");
  if (accepted(frame, status)) expect(status.temperature_degC >= -328 && status.temperature_degC <= 328, "a temperature is one");
  if (accepted(frame, end) && type == lcs::Type::kScanEnd)
    expect(same(lcs::encode(frame.sequence, end), frame), "a scan's end says itself");
  if (accepted(frame, part) && type == lcs::Type::kTable) {
    TriangulationCalibration table;
    expect(same(lcs::encode(frame.sequence, part), frame), "a part of a table says itself");
    expect((take(part, table) == Status::kOk) == (part.all == lcs::kTableNumbers), "a table of its kind is taken");
  }
  if (!accepted(frame, samples)) return;
  expect(samples.count > 0 && samples.count <= lcs::kSamplesPerFrame, "samples fit");
  for (std::size_t i = 0; i < samples.count; ++i) {
    const lcs::RawSample& raw = samples.samples[i];
    expect(raw.angle_x_rad >= -1 && raw.angle_x_rad < 1 && raw.angle_y_rad >= -1 && raw.angle_y_rad < 1 && raw.peak >= -1 && raw.peak < 1,
           "angles and peaks are within the wire's");
    expect(raw.flight_us >= 0 && raw.flight_us <= lcs::kMaxFlightUs, "flights are within the wire's");
  }
}

void run(ConstBytes input, std::uint8_t options) {
  static Stream stream;  // its content is new with each run
  stream.size = 0;
  if ((options & 1) != 0) stream.append(input);
  if ((options & 1) == 0) make_frames(input, stream);
  lcs::FrameDecoder decoder;
  lcs::Frame frame;
  const std::size_t piece = std::size_t{1} + (options >> 1);
  std::size_t in_frames = 0;
  for (std::size_t at = 0; at < stream.size;) {
    const std::size_t size = std::min(piece, stream.size - at);
    const lcs::FrameDecoder::Step step = decoder.step(ConstBytes(stream.bytes + at, size), frame);
    expect(step.taken <= size && (step.taken > 0 || step.found), "it goes on");
    at += step.taken;
    if (!step.found) continue;
    expect(frame.length <= lcs::kMaxPayload, "a payload fits");
    in_frames += frame.length + lcs::kFrameOverhead;
    check_messages(frame);
  }
  while (decoder.step({}, frame).found) in_frames += frame.length + lcs::kFrameOverhead;
  const std::size_t told = in_frames + decoder.counters().skipped;
  expect(told <= stream.size && stream.size - told < lcs::kMaxFrame,
         "each byte belongs to a frame, is skipped, or waits for the rest of one");
}

}  // namespace
}  // namespace lasso::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 0) lasso::fuzz::run({data + 1, size - 1}, data[0]);
  return 0;
}
