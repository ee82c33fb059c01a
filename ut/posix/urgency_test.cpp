#include "bsp/posix/urgency.hpp"

#include <gtest/gtest.h>
#include <sched.h>

#include <thread>

#include "ut/support/verifies.hpp"

namespace lasso::posix {
namespace {

struct Scheduling {
  int policy = 0, priority = 0;
};

// As Linux says of the calling thread.
Scheduling scheduling() {
  sched_param parameters{};
  EXPECT_EQ(sched_getparam(0, &parameters), 0);
  return {sched_getscheduler(0) & ~SCHED_RESET_ON_FORK, parameters.sched_priority};
}

// Where Linux grants it the thread goes first, by its level; where not, it goes on as before. Neither its threads nor its later self do.
TEST(Urgency, IsThatOfOneThreadWhileItLasts) {
  VERIFIES("LASSO-SIM-031~1");
  const Scheduling before = scheduling();
  for (const UrgencyLevel level : {UrgencyLevel::kLine, UrgencyLevel::kEstimation}) {
    const Urgency urgency(level);
    const Scheduling urgent = scheduling();
    EXPECT_EQ(urgent.policy, urgency.granted() ? SCHED_FIFO : before.policy);
    EXPECT_EQ(urgent.priority, urgency.granted() ? static_cast<int>(level) : before.priority);
    std::thread([&] { EXPECT_EQ(scheduling().policy, SCHED_OTHER); }).join();
  }
  EXPECT_EQ(scheduling().policy, before.policy);
  EXPECT_EQ(scheduling().priority, before.priority);
}

// Whoever is in it may start one of another level.
TEST(Urgency, Nests) {
  VERIFIES("LASSO-SIM-031~1");
  const Urgency outer(UrgencyLevel::kSlots);
  {
    const Urgency inner(UrgencyLevel::kLine);
    EXPECT_EQ(inner.granted(), outer.granted());
  }
  EXPECT_EQ(scheduling().priority, outer.granted() ? static_cast<int>(UrgencyLevel::kSlots) : 0);
}

}  // namespace
}  // namespace lasso::posix
