// Bytes that claim to be a scan: CSV, PLY, PCD, plain text or a depth image, by the first byte modulo 5. The reader refuses them with one
// line, or gives samples that are finite and of unit direction.
#include <cmath>
#include <string>

#include "ft/fuzz/exact.hpp"
#include "hal_sim/scan_text.hpp"

namespace lasso::fuzz {
namespace {

bool is_sound(const RangeSample& sample) {
  double squared = 0;
  for (const float u : sample.direction) squared += static_cast<double>(u) * static_cast<double>(u);
  return std::abs(squared - 1) < 1e-2 && std::isfinite(sample.range_m) && (sample.range_m > 0) == (sample.state == RayState::kHit);
}

sim::RawScan read_as(std::uint8_t kind, std::string_view text) {
  constexpr sim::DepthCamera kCamera{500, 500, 320, 240, 1e-3, false};
  using Reader = sim::RawScan (*)(const std::string&, std::string_view);
  constexpr Reader kReaders[] = {sim::read_csv, sim::read_ply, sim::read_pcd, sim::read_xyz};
  return kind % 5 == 4 ? sim::read_depth_image("scan.png", text, kCamera) : kReaders[kind % 5]("scan.txt", text);
}

void read(std::uint8_t kind, ConstBytes input) {
  ExactCopy text(input);
  try {
    const RangeImage image = sim::to_image(read_as(kind, {reinterpret_cast<const char*>(text.bytes().data()), input.size()}), {});
    expect(!image.samples.empty(), "a scan that is read has samples");
    for (const RangeSample& sample : image.samples) expect(is_sound(sample), "samples are finite, of unit direction, hits have a range");
  } catch (const sim::ScanFileError& error) {
    expect(std::string(error.what()).find('\n') == std::string::npos, "a refusal is one line");
  }
}

}  // namespace
}  // namespace lasso::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 0) lasso::fuzz::read(data[0], {data + 1, size - 1});
  return 0;
}
