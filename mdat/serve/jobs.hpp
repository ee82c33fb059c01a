// What takes longer than an answer may: one job at a time, in a thread of its own.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace lasso::mdat::serve {

struct JobState {
  double done = 0;  // share, 0 to 1
  std::string text;
  std::string result;  // what it made: the id of a recording; empty until it is there
  std::string error;   // empty: none
  bool over() const { return !result.empty() || !error.empty(); }
};

// Safe for several threads.
class Jobs {
 public:
  using Tell = std::function<void(double done, const std::string& text)>;
  using Work = std::function<std::string(const Tell&)>;  // returns the result; what it throws is the error

  Jobs() = default;
  ~Jobs();  // waits for what is under way
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;

  // Begins it, and returns its id; of the same name, while it is under way, the one that is.
  std::string begin(const std::string& name, Work work);
  // False: there is no such job.
  bool find(const std::string& id, JobState& state) const;

 private:
  void set(const std::string& id, const std::function<void(JobState&)>& change);

  mutable std::mutex mutex_;
  std::map<std::string, JobState> states_;
  std::string name_, id_;  // of the last one
  std::thread thread_;
};

}  // namespace lasso::mdat::serve
