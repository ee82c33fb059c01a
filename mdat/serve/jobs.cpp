#include "mdat/serve/jobs.hpp"

#include <exception>
#include <utility>

#include "mdat/serve/http.hpp"

namespace lasso::mdat::serve {

Jobs::~Jobs() {
  if (thread_.joinable()) thread_.join();
}

void Jobs::set(const std::string& id, const std::function<void(JobState&)>& change) {
  const std::lock_guard lock(mutex_);
  change(states_[id]);
}

bool Jobs::find(const std::string& id, JobState& state) const {
  const std::lock_guard lock(mutex_);
  const auto found = states_.find(id);
  if (found != states_.end()) state = found->second;
  return found != states_.end();
}

std::string Jobs::begin(const std::string& name, Work work) {
  const std::lock_guard lock(mutex_);
  const bool busy = thread_.joinable() && !states_[id_].over();
  if (busy && name == name_) return id_;
  if (busy) throw Refusal{409, "another job is under way: " + name_, "wait for its end"};
  if (thread_.joinable()) thread_.join();  // it is over, and its thread nearly so
  name_ = name;
  id_ = "job" + std::to_string(states_.size() + 1);
  states_[id_].text = name;
  thread_ = std::thread([this, id = id_, work = std::move(work)] {
    const Tell tell = [&](double done, const std::string& text) {
      set(id, [&](JobState& state) {
        state.done = done;
        state.text = text;
      });
    };
    try {
      const std::string result = work(tell);
      set(id, [&](JobState& state) {
        state.done = 1;
        state.result = result;
      });
    } catch (const std::exception& error) {
      set(id, [&](JobState& state) { state.error = error.what(); });
    }
  });
  return id_;
}

}  // namespace lasso::mdat::serve
