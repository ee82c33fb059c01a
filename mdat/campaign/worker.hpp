// A process that flies cases, one at a time, for the process that forked it. What crashes there ends one case, not the campaign.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace lasso::mdat {

// Flies a case, and returns its record's fields after the case's number ("ok,1,2,3"). What it throws is why the case failed.
using Fly = std::function<std::string(std::uint32_t case_number)>;
// Called once in each worker's process: compiles or loads the mission.
using MakeFly = std::function<Fly()>;

class Worker {
 public:
  // Forks. The caller must not have started threads before. `in_child` is called in the child first (it gives back what it must not keep).
  // Throws RunError where no process can be had.
  Worker(const MakeFly& make_fly, const std::function<void()>& in_child);
  // Ends the process at once.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  // Readable when there is a message, or its end.
  int socket() const { return socket_; }
  void give(std::uint32_t case_number);

  enum class Kind : char { kReady = 'r', kFields = 'c', kBadInput = 'i', kError = 'e', kDead = 'd' };
  struct Message {
    Kind kind;
    std::string text;  // kFields: the case's; kBadInput, kError: why make_fly failed
  };
  Message receive();

  // Of a dead one, after kDead: the signal that ended it; 0 if it left by itself.
  int signal() const { return signal_; }
  void end();

 private:
  pid_t process_ = -1;
  int socket_ = -1, signal_ = 0;
};

}  // namespace lasso::mdat
