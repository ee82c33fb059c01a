// One flight of the emulated board without a flip, and flights from a state of it with one.
#pragma once

#include <memory>
#include <string>

#include "fsw/link/pose_telemetry.hpp"
#include "ft/pil/flips.hpp"
#include "ft/pil/world.hpp"

namespace lasso::pil {

constexpr std::uint32_t kScrubFrames = 50;  // the scrub's period by its requirement, 10 s: in which a flip has to be reported
constexpr std::uint32_t kGoldenFrames = kFirstFrame + kFlipFrames + kScrubFrames + 1;

// What became of a flip (docs/pil.md).
struct Trial {
  std::string where;              // address or register
  std::uint32_t address = 0;      // 0: of a register
  std::uint32_t bit = 0;          // of the byte, of the register
  std::uint32_t instruction = 0;  // at which it was flipped; 0: between two slots
  std::string outcome;
  std::uint32_t told_after = 0;  // frames; 0: nothing was reported
  std::uint32_t wrong = 0, invalid = 0, frames = 0;
  std::uint32_t first_wrong = 0;  // frame after the flip, from 1, of the first valid pose that was wrong
};

class SeuFlight {
 public:
  SeuFlight(const WorldSetup& setup, const std::string& folder, const Places& places, std::function<void()> start_emulator);

  // Throws mdat::RunError where the board fails without a flip, or does not do the same again.
  void fly_golden();
  Trial fly(const Flip& flip);
  std::size_t unsteady_bytes() const;

 private:
  // What was said at the boundary before a slot, and what was answered.
  struct Moment {
    Said said;
    Packet camera, ground;
  };
  enum class Step : std::uint8_t { kDone, kBegun, kSilent };
  // A flight from a flip on.
  struct Course {
    std::uint32_t boundary = 0;
    std::unique_ptr<World> world;  // once the board has sent the camera something else
    Packet to_camera;
    Packet telemetry;                        // of this frame
    std::uint32_t same = 0;                  // frames in a row that end as without the flip
    std::uint32_t valid = 0;                 // frames in a row with valid poses, tracking
    bool other = false;                      // telemetry has differed
    bool flipped = false;                    // by now
    std::uint32_t restarts = 0;              // of the board; boundaries count anew from each
    std::uint32_t frames_before = 0;         // the last of them
    std::uint32_t reached = 0;               // instructions
    std::vector<std::uint32_t> breakpoints;  // that are set
  };

  void record();
  void ignore(const Range& range);
  void find_unsteady();
  void check_board();
  void ready_board();

  void answer(Course& course);
  void diverge(Course& course);
  Step step(Course& course, const Flip& flip, Trial& trial);
  void start_anew(Course& course, const Said& said, const Trial& trial);
  void inject(Course& course, const Flip& flip, Trial& trial);
  void look_out(Course& course, const Flip& flip);
  void reach(Course& course, const Flip& flip, Trial& trial);
  void flip_now(Course& course, const Flip& flip, Trial& trial);
  void flip_live(Course& course, const Flip& flip, Trial& trial);
  void flip_stack(const Flip& flip, const std::string& registers, Trial& trial);
  void end_frame(Course& course, Trial& trial);
  bool steady_again(std::uint32_t boundary, const Trial& trial) const;
  bool decided(const Course& course, const Trial& trial) const;
  std::string outcome_of(const Course& course, const Trial& trial);
  void fly_on(Course& course, const Flip& flip, Trial& trial);

  const WorldSetup& setup_;
  Places places_;
  std::unique_ptr<sim::Trajectory> truth_;
  SeuBoard board_;
  std::vector<Moment> moments_;
  std::map<std::uint32_t, Snapshot> snapshots_;  // by boundary
  std::map<std::uint32_t, Packet> memories_;     // at the ends of frames, by boundary
  std::vector<bool> unsteady_;                   // bytes of memory that are not the same in each flight: times of the processor
  int patience_s_ = 0;                           // of the host, for a slot; known when the flight without a flip is recorded
  bool doubtful_ = false;                        // whether the board can be put back
};

}  // namespace lasso::pil
