// Real-time scheduling of a thread on Linux: what runs by a clock of its own goes before the machine's other work, so that other work
// makes no sample late.
#pragma once

#include <cstdint>

namespace lasso::posix {

// The greater goes first: a line's bytes, then the slots, then the estimation.
enum class UrgencyLevel : std::uint8_t { kEstimation = 1, kSlots = 2, kLine = 3 };

// While it lives, the thread that made it has the policy SCHED_FIFO at this priority, and then its former policy again. Threads that
// are started meanwhile do not inherit it. Linux grants it to root, to CAP_SYS_NICE, and within RLIMIT_RTPRIO; else nothing changes.
class Urgency {
 public:
  explicit Urgency(UrgencyLevel level);
  ~Urgency();  // by the thread that made it
  Urgency(const Urgency&) = delete;
  Urgency& operator=(const Urgency&) = delete;

  bool granted() const { return granted_; }

 private:
  int policy_ = 0, priority_ = 0;  // the former ones
  bool granted_ = false;
};

}  // namespace lasso::posix
