#include "ft/pil/line.hpp"

#include <array>
#include <thread>

#include "mdat/common/errors.hpp"

namespace lasso::pil {

void Line::listen(const std::string& folder, const std::string& name) {
  name_ = name;
  const std::string wrong = server_.listen("unix:" + folder + "/" + name + ".sock", false);
  if (!wrong.empty()) throw mdat::RunError(wrong);
}

void Line::await() {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  line_.close();
  while (!server_.accept(line_)) {
    if (std::chrono::steady_clock::now() > end) throw mdat::RunError("nobody has opened the " + name_ + " line: has the emulator started?");
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

void Line::move() {
  std::array<std::uint8_t, 4096> buffer;
  const std::size_t count = line_.read(Bytes(buffer.data(), buffer.size()));
  bytes_.insert(bytes_.end(), buffer.begin(), buffer.begin() + count);
  const std::size_t sent = line_.write({unsent_.data(), unsent_.size()});
  unsent_.erase(unsent_.begin(), unsent_.begin() + static_cast<std::ptrdiff_t>(sent));
  if (!line_.is_open()) throw mdat::RunError("the " + name_ + " line has been closed from the other end: the emulator has gone");
}

Packet Line::take(std::size_t count) {
  Packet taken(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(count));
  bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(count));
  taken_ += static_cast<std::uint32_t>(count);
  return taken;
}

void Line::give(const Packet& packet) {
  given_ += static_cast<std::uint32_t>(packet.size());
  unsent_.insert(unsent_.end(), packet.begin(), packet.end());
}

void Line::go_back(std::uint32_t taken, std::uint32_t given) {
  bytes_.clear();
  unsent_.clear();
  taken_ = taken;
  given_ = given;
}

Packet words(std::initializer_list<std::uint32_t> words) {
  Packet packet;
  for (const std::uint32_t word : words)
    for (int shift = 24; shift >= 0; shift -= 8) packet.push_back(static_cast<std::uint8_t>(word >> shift));
  return packet;
}

Report report_of(const Packet& bytes) {
  Report report;
  for (std::size_t i = 0; i < bytes.size(); ++i) report.words[i / 4] = report.words[i / 4] << 8 | bytes[i];
  if (report[bare::kRigMagic] != bare::kRigReport)
    throw mdat::RunError("the rig's line brings something else than reports: is the image of this version?");
  return report;
}

}  // namespace lasso::pil
