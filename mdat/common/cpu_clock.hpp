// Processor time of the calling thread, or of all threads of the process.
#pragma once

#include <ctime>

namespace lasso::mdat {

inline double cpu_us(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

inline double thread_cpu_us() { return cpu_us(CLOCK_THREAD_CPUTIME_ID); }
inline double process_cpu_us() { return cpu_us(CLOCK_PROCESS_CPUTIME_ID); }

}  // namespace lasso::mdat
