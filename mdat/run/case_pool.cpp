#include "mdat/run/case_pool.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <mutex>
#include <thread>

namespace lasso::mdat {
namespace {

// Results in the order of the cases.
class Pool {
 public:
  Pool(const std::vector<CaseSetup>& cases, unsigned jobs) : cases_(cases), results_(cases.size()) {
    for (unsigned i = 0; i < std::max(1U, jobs); ++i) threads_.emplace_back([this] { work(); });
  }

  std::vector<CaseResult> wait(ProgressBar& bar) {
    while (running() && !failed_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      bar.show(done_);
    }
    threads_.clear();  // joins
    if (error_) std::rethrow_exception(error_);
    bar.end_at(done_);
    return std::move(results_);
  }

 private:
  bool running() const { return finished_ < cases_.size(); }

  void work() {
    for (std::size_t i = next_++; i < cases_.size() && !failed_; i = next_++) {
      try {
        results_[i] = run_case(cases_[i], done_);
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (!error_) error_ = std::current_exception();
        failed_ = true;
      }
      ++finished_;
    }
  }

  const std::vector<CaseSetup>& cases_;
  std::vector<CaseResult> results_;
  std::atomic<std::size_t> next_{0}, finished_{0}, done_{0};
  std::atomic<bool> failed_{false};
  std::mutex mutex_;
  std::exception_ptr error_;
  std::vector<std::jthread> threads_;
};

}  // namespace

std::vector<CaseResult> run_cases(const std::vector<CaseSetup>& cases, unsigned jobs, ProgressBar& bar) {
  return Pool(cases, jobs).wait(bar);
}

}  // namespace lasso::mdat
