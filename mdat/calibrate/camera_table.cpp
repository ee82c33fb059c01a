#include "mdat/calibrate/camera_table.hpp"

#include <bitset>
#include <chrono>
#include <thread>

#include "bsp/posix/serial_line.hpp"
#include "hal_lcs/table.hpp"
#include "mdat/common/errors.hpp"

namespace lasso::mdat {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kStep(5), kAskAgain(500), kPatience(2000);
constexpr unsigned kBitsPerS = 4000000;

// What the camera has said so far.
class Table {
 public:
  void hear(ConstBytes bytes) {
    lcs::Frame frame;
    for (lcs::FrameDecoder::Step step = decoder_.step(bytes, frame); step.found; step = decoder_.step(bytes, frame)) {
      bytes = bytes.subspan(step.taken, bytes.size() - step.taken);
      take(frame);
    }
  }
  bool refused() const { return refused_; }
  bool whole() const { return calibration_.serial != 0 && there_.all(); }
  const lcs::Calibration& calibration() const { return calibration_; }

 private:
  void take(const lcs::Frame& frame) {
    lcs::CameraStatus status;
    lcs::Answer answer;
    lcs::TablePart part;
    const auto type = static_cast<lcs::Type>(frame.type);
    if (type == lcs::Type::kStatus && decode(frame, status) == Status::kOk) calibration_.serial = status.serial;
    if (type == lcs::Type::kAnswer && decode(frame, answer) == Status::kOk)
      refused_ = answer.to == lcs::Type::kAskTable && answer.result != lcs::Result::kDone;
    if (type != lcs::Type::kTable || decode(frame, part) != Status::kOk) return;
    refused_ = lcs::take(part, calibration_) != Status::kOk;
    for (std::size_t i = 0; i < part.count && !refused_; ++i) there_.set(part.first + i);
  }

  lcs::FrameDecoder decoder_;
  lcs::Calibration calibration_;
  std::bitset<lcs::kTableNumbers> there_;
  bool refused_ = false;
};

void ask(posix::SerialLine& line, std::uint8_t& sequence) {
  for (const lcs::Type question : {lcs::Type::kAskStatus, lcs::Type::kAskTable}) {
    static_cast<void>(line.write(lcs::encode(sequence++, question).span()));  // what is lost is asked again
  }
}

// Until the table is whole, refused, or the camera's time is over.
Table heard(posix::SerialLine& line) {
  Table table;
  std::uint8_t bytes[256], sequence = 0;
  const Clock::time_point begin = Clock::now();
  Clock::time_point asked = begin - kAskAgain;
  while (line.is_open() && !table.whole() && !table.refused() && Clock::now() - begin < kPatience) {
    if (Clock::now() - asked >= kAskAgain) {
      ask(line, sequence);
      asked = Clock::now();
    }
    std::this_thread::sleep_for(kStep);
    for (std::size_t size = line.read(Bytes(bytes)); size > 0; size = line.read(Bytes(bytes))) table.hear({bytes, size});
  }
  return table;
}

}  // namespace

lcs::Calibration read_camera_table(const std::string& address, bool remote) {
  posix::SerialLine line;
  const std::string wrong = line.open(address, kBitsPerS, remote);
  if (!wrong.empty()) throw InputError(wrong);
  const Table table = heard(line);
  if (table.refused()) throw InputError(address + ": the head has no table of a laser camera: expected a laser camera or a TriDAR");
  if (!table.whole()) throw InputError(address + ": no whole calibration table within 2 s: is a camera there, with power, at 4 Mbit/s?");
  const Status status = validate(table.calibration());
  if (status != Status::kOk) throw InputError(address + ": the camera's table is no calibration: " + to_string(status));
  return table.calibration();
}

}  // namespace lasso::mdat
