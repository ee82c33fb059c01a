// How long a commanded reset waits for the telemetry that reports it.
#pragma once

#include <cstdint>

namespace lasso::bare {

class ResetWait {
 public:
  static constexpr std::uint32_t kMostFrames = 10;  // a ground line that is stopped, or overfull, keeps no reset from happening

  // At the end of each frame: whether the board restarts now.
  bool over(bool due, bool all_sent) {
    if (!due) return false;
    return all_sent || ++frames_ > kMostFrames;
  }

 private:
  std::uint32_t frames_ = 0;
};

}  // namespace lasso::bare
