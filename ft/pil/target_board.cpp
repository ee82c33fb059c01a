#include <poll.h>

#include <algorithm>
#include <array>

#include "fsw/core/invariant.hpp"
#include "fsw/exec/executive.hpp"
#include "ft/pil/board_ram.hpp"
#include "ft/pil/boards.hpp"
#include "ft/pil/line.hpp"
#include "mdat/common/errors.hpp"

namespace lasso::pil {
namespace {

using bare::RigWord;

class Target {
 public:
  Target(const WorldSetup& setup, const TargetRun& run) : setup_(setup), run_(run) {}

  void open(const std::function<void()>& ready) {
    camera_.listen(run_.folder, "camera");
    ground_.listen(run_.folder, "ground");
    rig_.listen(run_.folder, "rig");
    ready();
    camera_.await();
    ground_.await();
    rig_.await();
  }

  Report read_report() {
    move_until("the report", [&] { return rig_.has(4 * bare::kRigWords); });
    return report_of(rig_.take(4 * bare::kRigWords));
  }

  // Takes a report with what the board has sent before it. True: a start.
  bool take(const Report& report, TargetFlight& flight) {
    const bool begun = report[bare::kRigKind] == static_cast<std::uint32_t>(bare::RigKind::kBegun);
    if (begun) begin_anew();
    const std::uint32_t camera = report[bare::kRigCameraSent], ground = report[bare::kRigGroundSent];
    move_until("bytes that are counted by the report", [&] { return camera_.has_all(camera) && ground_.has_all(ground); });
    to_camera_ = camera_.take_until(camera);
    if (begun) flight.slots.clear();
    if (begun) flight.telemetry.emplace_back();
    const Packet telemetry = ground_.take_until(ground);
    flight.telemetry.back().insert(flight.telemetry.back().end(), telemetry.begin(), telemetry.end());
    (begun ? flight.starts : flight.slots).push_back(report);
    return begun;
  }

  void answer(std::uint32_t start, const Ground& ground) {
    world_->move_to(slot_, {to_camera_.data(), to_camera_.size()});
    camera_.give(world_->from_camera());
    ground_.give(world_->from_ground());
    if (ground) ground_.give(ground(start, slot_, world_->next_command()));
    ++slot_;
    rig_.give(words({camera_.given(), ground_.given()}));
  }

  void stop() {
    rig_.give(words({bare::kStopBytes, 0}));
    rig_.move();
  }

 private:
  // All lines at once: the board may have to get rid of bytes on one before it says something on another.
  template <class Done>
  void move_until(const char* awaited, const Done& done) {
    for (;;) {
      for (Line* line : {&camera_, &ground_, &rig_}) line->move();
      if (done()) return;
      std::array<pollfd, 3> states{camera_.awaited(), ground_.awaited(), rig_.awaited()};
      const int some = poll(states.data(), states.size(), static_cast<int>(left().count()));
      if (left().count() == 0)
        give_up(awaited, "the flight has not ended within its time", "fewer frames, or a longer limit, if the board flies on");
      if (some <= 0)
        give_up(awaited, "nothing has moved on the board's lines for " + std::to_string(run_.patience.quiet.count()) + " s",
                "the board hangs, or is not there");
    }
  }

  // For which the lines may be quiet, within what is left of the whole.
  std::chrono::milliseconds left() const {
    using std::chrono::milliseconds;
    const auto whole = run_.patience.end - std::chrono::steady_clock::now();
    return std::clamp(std::chrono::duration_cast<milliseconds>(whole), milliseconds(0), milliseconds(run_.patience.quiet));
  }

  [[noreturn]] void give_up(const char* awaited, const std::string& why, const char* advice) const {
    const std::uint32_t slot = slot_ - 1;  // whose answer is the last
    const std::string where =
        slot_ == 0 ? " of its start"
                   : " of slot " + std::to_string(slot % kSlotsPerFrame) + " in frame " + std::to_string(slot / kSlotsPerFrame);
    throw mdat::RunError(why + "; awaited was " + awaited + where + ": " + advice);
  }

  // The emulator makes the memory after its lines; a board that reports has it.
  void map_head() {
    if (!run_.head || head_ != nullptr) return;
    invariant(*run_.head + sizeof(lcs::HeadMemory) <= kRamBytes, "the head's memory is none of the board's");
    head_ = reinterpret_cast<lcs::HeadMemory*>(ram_.map(run_.folder) + *run_.head);
  }

  void begin_anew() {
    map_head();
    world_.emplace(setup_, head_);
    slot_ = 0;
    camera_.count_anew();
    ground_.count_anew();
  }

  const WorldSetup& setup_;
  const TargetRun& run_;
  std::optional<World> world_;
  std::uint32_t slot_ = 0;
  Packet to_camera_;
  BoardRam ram_;
  lcs::HeadMemory* head_ = nullptr;
  Line camera_, ground_, rig_;
};

}  // namespace

TargetFlight fly_on_target(const WorldSetup& setup, const TargetRun& run, const std::function<void()>& ready, const Told& told,
                           const Ground& ground) {
  Target target(setup, run);
  TargetFlight flight;
  target.open(ready);
  while (flight.starts.size() < run.starts || flight.slots.size() < std::size_t{run.frames} * kSlotsPerFrame) {
    if (!flight.starts.empty()) target.answer(static_cast<std::uint32_t>(flight.starts.size() - 1), ground);
    target.take(target.read_report(), flight);
    told(static_cast<std::uint32_t>(flight.slots.size() / kSlotsPerFrame));
    if (flight.starts.size() > run.starts) throw mdat::RunError("the board has started anew, for a reason that its console says");
  }
  target.stop();
  return flight;
}

}  // namespace lasso::pil
