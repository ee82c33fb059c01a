#include <poll.h>

#include <array>
#include <chrono>
#include <thread>

#include "bsp/posix/serial_line.hpp"
#include "fsw/exec/executive.hpp"
#include "ft/pil/boards.hpp"
#include "mdat/common/errors.hpp"

namespace lasso::pil {
namespace {

using ppc603e::RigWord;
using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kPatience(30);  // for any sign of life: no result depends on it

// One of the board's lines, from the first byte of a start on.
class Line {
 public:
  void listen(const std::string& folder, const std::string& name) {
    name_ = name;
    const std::string wrong = server_.listen("unix:" + folder + "/" + name + ".sock", false);
    if (!wrong.empty()) throw mdat::RunError(wrong);
  }

  void await() {
    const Clock::time_point end = Clock::now() + kPatience;
    while (!server_.accept(line_)) {
      if (Clock::now() > end) throw mdat::RunError("nobody has opened the " + name_ + " line: has the emulator started?");
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }

  // Whatever has come, or can go, by now.
  void move() {
    std::array<std::uint8_t, 4096> buffer;
    const std::size_t count = line_.read(Bytes(buffer.data(), buffer.size()));
    bytes_.insert(bytes_.end(), buffer.begin(), buffer.begin() + count);
    const std::size_t sent = line_.write({unsent_.data(), unsent_.size()});
    unsent_.erase(unsent_.begin(), unsent_.begin() + static_cast<std::ptrdiff_t>(sent));
    if (!line_.is_open()) throw mdat::RunError("the " + name_ + " line has been closed from the other end: the emulator has gone");
  }
  pollfd awaited() const { return {line_.descriptor(), static_cast<short>(unsent_.empty() ? POLLIN : POLLIN | POLLOUT), 0}; }

  bool has(std::size_t count) const { return bytes_.size() >= count; }
  // All up to the count that the board says.
  bool has_all(std::uint32_t sent) const { return has(sent - taken_); }
  Packet take(std::size_t count) {
    Packet taken(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(count));
    bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(count));
    taken_ += static_cast<std::uint32_t>(count);
    return taken;
  }
  Packet take_until(std::uint32_t sent) { return take(sent - taken_); }
  void give(const Packet& packet) {
    given_ += static_cast<std::uint32_t>(packet.size());
    unsent_.insert(unsent_.end(), packet.begin(), packet.end());
  }

  std::uint32_t given() const { return given_; }
  void count_anew() { given_ = taken_ = 0; }

 private:
  std::string name_;
  posix::LineServer server_;
  posix::SerialLine line_;
  Packet bytes_, unsent_;
  std::uint32_t taken_ = 0, given_ = 0;
};

void append_word(Packet& packet, std::uint32_t word) {
  for (int shift = 24; shift >= 0; shift -= 8) packet.push_back(static_cast<std::uint8_t>(word >> shift));
}

class Target {
 public:
  explicit Target(const WorldSetup& setup) : setup_(setup) {}

  void open(const std::string& folder, const std::function<void()>& ready) {
    camera_.listen(folder, "camera");
    ground_.listen(folder, "ground");
    rig_.listen(folder, "rig");
    ready();
    camera_.await();
    ground_.await();
    rig_.await();
  }

  Report read_report() {
    move_until([&] { return rig_.has(4 * ppc603e::kRigWords); });
    const Packet bytes = rig_.take(4 * ppc603e::kRigWords);
    Report report;
    for (std::size_t i = 0; i < bytes.size(); ++i) report.words[i / 4] = report.words[i / 4] << 8 | bytes[i];
    if (report[ppc603e::kRigMagic] != ppc603e::kRigReport)
      throw mdat::RunError("the rig's line brings something else than reports: is the image of this version?");
    return report;
  }

  // Takes a report with what the board has sent before it. True: a start.
  bool take(const Report& report, TargetFlight& flight) {
    const bool begun = report[ppc603e::kRigKind] == static_cast<std::uint32_t>(ppc603e::RigKind::kBegun);
    if (begun) begin_anew();
    const std::uint32_t camera = report[ppc603e::kRigCameraSent], ground = report[ppc603e::kRigGroundSent];
    move_until([&] { return camera_.has_all(camera) && ground_.has_all(ground); });
    to_camera_ = camera_.take_until(camera);
    if (begun) flight.slots.clear();
    if (begun) flight.telemetry.emplace_back();
    const Packet telemetry = ground_.take_until(ground);
    flight.telemetry.back().insert(flight.telemetry.back().end(), telemetry.begin(), telemetry.end());
    (begun ? flight.starts : flight.slots).push_back(report);
    return begun;
  }

  void answer() {
    world_->move_to(slot_++, {to_camera_.data(), to_camera_.size()});
    camera_.give(world_->from_camera());
    ground_.give(world_->from_ground());
    Packet totals;
    append_word(totals, camera_.given());
    append_word(totals, ground_.given());
    rig_.give(totals);
  }

  void stop() {
    Packet end;
    append_word(end, ppc603e::kStopBytes);
    append_word(end, 0);
    rig_.give(end);
    rig_.move();
  }

 private:
  // All lines at once: the board may have to get rid of bytes on one before it says something on another.
  template <class Done>
  void move_until(const Done& done) {
    for (;;) {
      for (Line* line : {&camera_, &ground_, &rig_}) line->move();
      if (done()) return;
      std::array<pollfd, 3> states{camera_.awaited(), ground_.awaited(), rig_.awaited()};
      const int some = poll(states.data(), states.size(), static_cast<int>(std::chrono::milliseconds(kPatience).count()));
      if (some <= 0) throw mdat::RunError("nothing has moved on the board's lines for 30 s: it hangs, or is not there");
    }
  }

  void begin_anew() {
    world_.emplace(setup_);
    slot_ = 0;
    camera_.count_anew();
    ground_.count_anew();
  }

  const WorldSetup& setup_;
  std::optional<World> world_;
  std::uint32_t slot_ = 0;
  Packet to_camera_;
  Line camera_, ground_, rig_;
};

}  // namespace

TargetFlight fly_on_target(const WorldSetup& setup, const std::string& folder, std::uint32_t frames, std::uint32_t starts,
                           const std::function<void()>& ready, const Told& told) {
  Target target(setup);
  TargetFlight flight;
  target.open(folder, ready);
  while (flight.starts.size() < starts || flight.slots.size() < std::size_t{frames} * kSlotsPerFrame) {
    if (!flight.starts.empty()) target.answer();
    target.take(target.read_report(), flight);
    told(static_cast<std::uint32_t>(flight.slots.size() / kSlotsPerFrame));
    if (flight.starts.size() > starts) throw mdat::RunError("the board has started anew, for a reason that its console says");
  }
  target.stop();
  return flight;
}

}  // namespace lasso::pil
