// Spreads independent work over the processor's cores. Results must not depend on which thread does what.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace lasso::mdat {

// Calls work(i) once for each i < n, from several threads, in no particular order. `work` must not throw.
template <class Work>
void parallel_for(std::size_t n, const Work& work) {
  constexpr std::size_t kChunk = 64;
  std::atomic<std::size_t> next{0};
  const auto run = [&] {
    for (std::size_t begin = next.fetch_add(kChunk); begin < n; begin = next.fetch_add(kChunk)) {
      for (std::size_t i = begin; i < std::min(n, begin + kChunk); ++i) work(i);
    }
  };
  std::vector<std::jthread> threads;
  for (unsigned i = 1; i < std::max(1u, std::thread::hardware_concurrency()); ++i) threads.emplace_back(run);
  run();
}

}  // namespace lasso::mdat
