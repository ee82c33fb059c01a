// Arm and fire: a hazardous command is carried out only if the command `arm` has named it before, at most kArmFrames frames ago. Any other
// hazardous command in between ends that. The time that is left is kept in three copies, voted, and repaired at each boundary: one flipped
// bit arms nothing, and nothing for longer. Used by one thread.
#pragma once

#include <cstdint>

#include "fsw/core/voted.hpp"

namespace lasso {

constexpr std::uint32_t kArmFrames = 50;  // 10 s at 5 frames a second

// What a command is told from others by. The number is 0 where there is none.
struct CommandName {
  std::uint8_t service = 0;
  std::uint8_t subservice = 0;
  std::uint16_t number = 0;
};
constexpr bool operator==(const CommandName& a, const CommandName& b) {
  return a.service == b.service && a.subservice == b.subservice && a.number == b.number;
}

// What has to go before a command.
enum class Hazard : std::uint8_t {
  kNone = 0,     // nothing
  kOnce = 1,     // an arm of its own
  kRenewed = 2,  // an arm for a row of such commands, at most kArmFrames from one to the next
};

class Arming {
 public:
  void arm(const CommandName& name);
  void disarm() { frames_left_.set(0); }
  // A hazardous command has come. True: it was armed, and may be carried out.
  bool fire(const CommandName& name, Hazard hazard);
  // A frame ends. True: what was armed has just expired.
  bool pass_boundary();

  bool armed() const { return frames_left() > 0; }
  const CommandName& name() const { return name_; }  // of what was armed last

 private:
  std::uint32_t frames_left() const;  // 0: nothing is armed, or no two copies agree

  CommandName name_;
  Voted<std::uint32_t> frames_left_{0};
};

}  // namespace lasso
