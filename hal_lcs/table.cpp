#include "hal_lcs/table.hpp"

#include "fsw/core/byte_codec.hpp"
#include "fsw/core/invariant.hpp"

namespace lasso::lcs {
namespace {

constexpr std::size_t kPartHead = 2;
constexpr std::size_t kNumberBytes = 8;
static_assert((kMaxPayload - kPartHead) / kNumberBytes == kNumbersPerPart, "no frame has more");

double& number(TriangulationCalibration& calibration, std::size_t index) {
  if (index < kCalibrationRealCount) return calibration.*Span<const CalibrationReal>(kCalibrationReals)[index].member;
  return Span<double>(calibration.residual)[index - kCalibrationRealCount];
}

}  // namespace

FrameBytes encode(std::uint8_t sequence, const TablePart& message) {
  std::uint8_t bytes[kMaxPayload] = {};
  ByteWriter out{Bytes(bytes)};
  out.u8(message.first);
  out.u8(message.all);
  for (std::size_t i = 0; i < message.count; ++i) out.f64(Span<const double>(message.numbers)[i]);
  invariant(out.ok(), "lcs table");
  return encode_frame(static_cast<std::uint8_t>(Type::kTable), sequence, out.written());
}

Status decode(const Frame& frame, TablePart& message) {
  const std::size_t numbers = frame.length < kPartHead ? 0 : (frame.length - kPartHead) / kNumberBytes;
  if (numbers == 0 || frame.length != kPartHead + numbers * kNumberBytes) return Status::kBadLength;
  ByteReader in(frame.bytes());
  message.first = in.u8();
  message.all = in.u8();
  message.count = numbers;
  for (std::size_t i = 0; i < numbers; ++i) Span<double>(message.numbers)[i] = in.f64();
  return message.first + numbers <= message.all ? Status::kOk : Status::kBadValue;
}

TablePart part_of(const TriangulationCalibration& calibration, std::size_t first) {
  TriangulationCalibration copy = calibration;
  TablePart part;
  part.first = static_cast<std::uint8_t>(first);
  for (; part.count < kNumbersPerPart && first + part.count < kTableNumbers; ++part.count) {
    part.numbers[part.count] = number(copy, first + part.count);
  }
  return part;
}

Status take(const TablePart& part, TriangulationCalibration& calibration) {
  if (part.all != kTableNumbers || part.first + part.count > kTableNumbers) return Status::kBadValue;
  for (std::size_t i = 0; i < part.count; ++i) number(calibration, part.first + i) = Span<const double>(part.numbers)[i];
  return Status::kOk;
}

}  // namespace lasso::lcs
