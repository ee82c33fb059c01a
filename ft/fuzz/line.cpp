// Bytes that claim to be the laser camera's, while the driver scans. Whatever comes, it hands over no more than it is asked for, each ray
// of the plan once at most, in order of time, hits that are points, and it ends. The first byte: bit 0 leaves the bytes as they are, else
// they are the types, lengths and payloads of frames, whose sync, sequence and checksum are made right; the others say how much a call may
// take.
#include <algorithm>
#include <cmath>
#include <vector>

#include "ft/fuzz/exact.hpp"
#include "hal_lcs/driver.hpp"

namespace lasso::fuzz {
namespace {

constexpr std::uint16_t kPoints = 64;
constexpr std::uint32_t kScanId = 0x155;
constexpr int kMaxPolls = 64;

ScanPlan plan_of() {
  ScanPlan plan;
  plan.scan_id = kScanId;
  plan.points = kPoints;
  return plan;
}

std::vector<std::uint8_t> framed(ConstBytes input) {
  std::vector<std::uint8_t> stream;
  std::uint8_t sequence = 0;
  for (std::size_t at = 0; at + 2 <= input.size();) {
    const std::size_t length = std::min<std::size_t>(input[at + 1] % (lcs::kMaxPayload + 1), input.size() - at - 2);
    const lcs::FrameBytes frame = lcs::encode_frame(input[at], sequence++, input.subspan(at + 2, length));
    stream.insert(stream.end(), frame.bytes, frame.bytes + frame.size);
    at += 2 + length;
  }
  return stream;
}

void check_sample(const RangeSample& sample, TimeUs& last_us) {
  expect(sample.t_us >= last_us, "samples are in order of time");
  last_us = sample.t_us;
  if (sample.state != RayState::kHit) return expect(sample.range_m == 0, "what is no hit has no range");
  const float length = std::hypot(sample.direction[0], sample.direction[1], sample.direction[2]);
  expect(std::abs(length - 1) < 1e-6F && sample.range_m > 0 && sample.range_m <= 1000, "a hit is a point");
}

void run(ConstBytes input, std::uint8_t options) {
  lcs::Line line;
  lcs::Calibration calibration;
  calibration.serial = 1;
  lcs::EchoCalibration echoes;  // a TriDAR, whose samples may be of any kind
  echoes.serial = 1;
  lcs::Driver driver(line, lcs::Optics(calibration, echoes));
  driver.permit_laser(true);
  const ScanPlan plan = plan_of();
  expect(driver.start(plan, 0) == Status::kOk, "a scan starts");
  std::vector<std::uint8_t> stream(input.begin(), input.end());
  if ((options & 1) == 0) stream = framed(input);
  stream.resize(std::min(stream.size(), lcs::kLineBytes));
  line.from_camera.write(ConstBytes(stream.data(), stream.size()));
  std::vector<RangeSample> out(std::size_t{1} + (options >> 1));
  TimeUs last_us = 0;
  std::size_t count = 0;
  bool complete = false;
  for (int i = 0; i < kMaxPolls && !complete; ++i) {
    const SensorPoll poll = driver.poll(i * 10'000, Span<RangeSample>(out.data(), out.size()));
    if (poll.status != Status::kOk) break;
    expect(poll.count <= out.size(), "no more than asked for");
    for (std::size_t k = 0; k < poll.count; ++k) check_sample(out[k], last_us);
    count += poll.count;
    complete = poll.complete;
  }
  expect(count <= kPoints && (!complete || count == kPoints), "each ray once at most, and all of them in a complete scan");
  driver.abort();
  expect(driver.poll(0, Span<RangeSample>(out.data(), out.size())).status == Status::kNoData, "an aborted scan has ended");
}

}  // namespace
}  // namespace lasso::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 0) lasso::fuzz::run({data + 1, std::min(size - 1, lasso::lcs::kLineBytes)}, data[0]);
  return 0;
}
