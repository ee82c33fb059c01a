// mdat as a process of its own, which somebody may command meanwhile, or kill as a loss of power does.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "ft/mdat/command.hpp"

namespace lasso::ft {

class LiveRun {
 public:
  // Runs `mdat ARGUMENTS` in the work folder. What it prints is in NAME.out and NAME.err there.
  LiveRun(const WorkFolder& work, std::string name, std::vector<std::string> arguments);
  ~LiveRun();  // kills it
  LiveRun(const LiveRun&) = delete;
  LiveRun& operator=(const LiveRun&) = delete;

  // Until it has printed this; false: it has ended, or does not within a minute.
  bool says(const std::string& text);
  std::string out() const;
  // Ends it at once, whatever it is doing.
  void kill();
  // Waits for its end.
  Answer wait();

 private:
  const WorkFolder& work_;
  std::string name_;
  pid_t pid_ = -1;
};

// A port of the loopback address that is free now.
std::string free_port();

}  // namespace lasso::ft
