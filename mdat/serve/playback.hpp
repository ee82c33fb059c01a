// What viewers of a live run may do with it: pause it, pace it, step through it. The run's results do not depend on it. It never jumps:
// what lies between two times is flown, and told.
#pragma once

#include <atomic>
#include <string>

#include "mdat/serve/live_protocol.hpp"
#include "mdat/serve/pacing.hpp"

namespace lasso::mdat::serve {

// Safe for several threads. Times of messages are nanoseconds, those of the run's boundaries whole microseconds.
class Playback {
 public:
  // `pacing` is asked by the run at each boundary, and outlives this.
  Playback(Pacing& pacing, PlaybackRange range) : pacing_(pacing), range_(range) {}

  PlaybackRange range() const { return range_; }
  // Does what is asked; a speed is above 0 and up to kMostPace, and the run cannot go back. What was not done, and why; empty: all was.
  // `now_ns`: the time of the last message.
  std::string take(const PlaybackRequest& request, std::uint64_t now_ns);
  PlaybackState state(std::uint64_t now_ns) const;
  // Nobody is left who could resume it: it goes on.
  void release() { pacing_.resume(); }
  void end() { ended_ = true; }

 private:
  Pacing& pacing_;
  const PlaybackRange range_;
  std::atomic<bool> ended_{false};
};

}  // namespace lasso::mdat::serve
