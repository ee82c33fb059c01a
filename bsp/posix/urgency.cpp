#include "bsp/posix/urgency.hpp"

#include <pthread.h>
#include <sched.h>

namespace lasso::posix {
namespace {

bool schedule(int policy, int priority) {
  sched_param parameters{};
  parameters.sched_priority = priority;
  return pthread_setschedparam(pthread_self(), policy, &parameters) == 0;
}

}  // namespace

Urgency::Urgency(UrgencyLevel level) {
  sched_param former{};
  if (pthread_getschedparam(pthread_self(), &policy_, &former) != 0) return;
  priority_ = former.sched_priority;
  granted_ = schedule(SCHED_FIFO | SCHED_RESET_ON_FORK, static_cast<int>(level));
}

// Without CAP_SYS_NICE a thread keeps the flag.
Urgency::~Urgency() {
  if (granted_ && !schedule(policy_, priority_)) static_cast<void>(schedule(policy_ | SCHED_RESET_ON_FORK, priority_));
}

}  // namespace lasso::posix
